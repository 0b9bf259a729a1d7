// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"
#include "work.h"

namespace obvid::batch {

/// The part of the work that this process was given, and by what; `from` is empty when it has all.
struct Share {
  Part part;
  std::string from;
};

/// "3/8", or, where the text is empty, what the environment says: a task of a Slurm array
/// (SLURM_ARRAY_TASK_ID of _MIN, _MAX, _STEP), a rank of Open MPI (OMPI_COMM_WORLD_RANK of _SIZE).
/// Error: E203.
[[nodiscard]] Result<Share> share_of(const std::string& text);

}  // namespace obvid::batch
