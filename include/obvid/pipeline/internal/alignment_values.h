// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"
#include "obvid/pipeline/alignment_job.h"

namespace obvid {

/// What is typed of an alignment, in words; empty: as if nothing had been said.
struct AlignmentValues {
  bool closed = false, open = false;
  std::string noise;           ///< a length, rounding or auto
  std::string profile_noise;   ///< likewise
  std::string profile_curves;  ///< parabolas or arcs
  std::string joints;          ///< G1 or G2
  std::string transitions;     ///< clothoid, bloss, sine, cosine, helmert, cubic or none
};

/// Errors: E203 what is none of these; `where` names the option.
[[nodiscard]] Result<void> set_alignment(const AlignmentValues& typed, AlignmentJob& job);

}  // namespace obvid
