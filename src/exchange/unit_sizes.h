// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace obvid::exchange {

/// Millimetres of a unit of length; nothing for a name that is not known.
[[nodiscard]] constexpr std::optional<double> millimetres_of(std::string_view unit) {
  constexpr std::pair<std::string_view, double> kUnits[] = {{"um", 1e-3}, {"mm", 1.0}, {"cm", 10.0},
                                                            {"m", 1e3},   {"km", 1e6}, {"in", 25.4},
                                                            {"ft", 304.8}};
  for (const auto& [name, value] : kUnits) {
    if (unit == name) return value;
  }
  return std::nullopt;
}

}  // namespace obvid::exchange
