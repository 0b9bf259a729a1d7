// SPDX-License-Identifier: Apache-2.0
#include "text_number.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace obvid::text {
namespace {

// Longest number in a foreign notation that is copied for conversion, in characters. No program
// prints more digits with a D exponent or a decimal comma.
constexpr std::size_t kCopyLength = 128;

std::string_view without_quotes(std::string_view field) {
  const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return quoted ? field.substr(1, field.size() - 2) : field;
}

std::string_view without_plus(std::string_view field) {
  const bool plus = field.size() >= 2 && field[0] == '+' && field[1] != '-' && field[1] != '+';
  return plus ? field.substr(1) : field;
}

ParsedNumber convert(std::string_view field) {
  ParsedNumber number;
  const char* end = field.data() + field.size();
  const auto [stop, code] = fast_float::from_chars(field.data(), end, number.value);
  if (field.empty() || stop != end || code == std::errc::invalid_argument) return number;
  number.kind = std::isfinite(number.value) ? NumberKind::kNumber : NumberKind::kNotFinite;
  return number;
}

// The field in the notation that the converter knows; empty when it is no such number.
std::string_view rewrite(std::string_view field, std::array<char, kCopyLength>& copy) {
  if (field.size() > copy.size()) return {};
  for (std::size_t i = 0; i < field.size(); ++i) {
    const char c = field[i];
    const bool after_digit = i > 0 && (field[i - 1] == '.' || field[i - 1] == ',' ||
                                       (field[i - 1] >= '0' && field[i - 1] <= '9'));
    copy[i] = c == ',' ? '.' : (after_digit && (c == 'd' || c == 'D')) ? 'e' : c;
  }
  return {copy.data(), field.size()};
}

}  // namespace

ParsedNumber parse_number(std::string_view field, bool comma_allowed) {
  field = without_plus(without_quotes(field));
  const bool point = field.find('.') != std::string_view::npos;
  ParsedNumber number = convert(field);
  if (number.kind == NumberKind::kNotNumber) {
    const auto commas = std::count(field.begin(), field.end(), ',');
    if (commas > 1 || (commas == 1 && (!comma_allowed || point))) return number;
    std::array<char, kCopyLength> copy;
    number = convert(rewrite(field, copy));
    number.decimal_comma = commas == 1;
  }
  number.decimal_point = point;
  return number;
}

}  // namespace obvid::text
