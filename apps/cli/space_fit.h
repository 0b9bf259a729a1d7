// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "options.h"

namespace obvid {

/// `obvid fit` of points x, y, z that leave the plane of x and y: the exit code; nothing for all
/// other input.
[[nodiscard]] std::optional<int> run_in_space(const FitOptions& options);

}  // namespace obvid
