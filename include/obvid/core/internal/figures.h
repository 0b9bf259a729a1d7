// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace obvid {

/// Number for people: `digits` significant digits, plain between 1e-4 and 1e7, else with an
/// exponent; "-" for NaN, "inf" for infinity.
[[nodiscard]] std::string significant(double value, int digits = 5);

/// The same of a bound above 0: never below it.
[[nodiscard]] std::string significant_above(double bound, int digits);

/// A tolerance, as it was typed where that has up to six digits; else six, never below it.
[[nodiscard]] std::string tolerance_text(double tolerance);

/// The same of a limit above 0 from above: always below it.
[[nodiscard]] std::string significant_below(double limit, int digits);

/// Digits of a bound that is told beside the figures that it holds for.
inline constexpr int kDigitsOfBounds = 3;

/// "1 vertex", "2 vertices".
[[nodiscard]] std::string counted(std::size_t count, const char* one, const char* many);

/// What follows the first `named` of a list: " and 3 more", nothing where they are all.
[[nodiscard]] std::string and_more(std::size_t all, std::size_t named);

/// "a.svg, b.json"
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace obvid
