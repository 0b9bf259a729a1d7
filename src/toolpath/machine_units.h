// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace obvid::toolpath {

/// Millimetres of a unit; 0: not known.
[[nodiscard]] double millimetres(const std::string& units);
/// Machine units (millimetres, or inches for inches) in a unit; 0: not known.
[[nodiscard]] double machine_scale(const std::string& units);

}  // namespace obvid::toolpath
