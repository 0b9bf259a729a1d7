// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.h"

namespace obvid {

/// `fit --suggest`: tolerances and the vertices that each of them needs, as table, JSON or chart.
/// Returns the exit code.
int suggest(const FitOptions& options);

}  // namespace obvid
