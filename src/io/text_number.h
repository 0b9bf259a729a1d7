// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace obvid::text {

enum class NumberKind { kNumber, kNotFinite, kNotNumber };

/// One field of a text file read as a number.
struct ParsedNumber {
  NumberKind kind = NumberKind::kNotNumber;
  double value = 0.0;
  bool decimal_comma = false;
  bool decimal_point = false;
};

/// Reads the whole field as one decimal number: exponents e, E, d, D; a leading plus; a decimal
/// comma when `comma_allowed`; a pair of double quotes around it. Locale plays no part.
[[nodiscard]] ParsedNumber parse_number(std::string_view field, bool comma_allowed);

}  // namespace obvid::text
