// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"
#include "store.h"
#include "summary.h"

namespace obvid::batch {

/// Puts the shards together: table, seconds, index, picture; the table last. Where something fails
/// nothing of a name is half there. Then the shards are removed. Memory does not grow with the
/// number of shards. Errors: E304 shards are missing (`hint` names them); E301; E102.
[[nodiscard]] Result<Summary> merge(const Names& names, Store& store);

/// The summary of a result that is there already and of just this batch; nothing otherwise.
[[nodiscard]] bool is_complete(const Names& names, const Manifest& manifest);
/// Of a result that is there. Error: E301.
[[nodiscard]] Result<Summary> summary_of(const Names& names);

}  // namespace obvid::batch
