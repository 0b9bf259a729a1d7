// SPDX-License-Identifier: Apache-2.0
#include "text_digits.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace obvid::text {
namespace {

// Exponents beyond this are no finite number other than 0.
constexpr int kLargestExponent = 100000;

// Zeros at the end of all numbers are padding only if what stands before them are rounded numbers:
// so many of them, at least half of all, end with one of the last two digits before the padding, so
// many different digits occur there, and the largest number has so many digits. Nominal sizes (250,
// 12.5) have fewer digits, and a few points prove nothing.
constexpr std::size_t kTellingNumbers = 10;
constexpr int kTellingDigits = 5;
constexpr int kTellingLength = 4;

constexpr int kAllZeros = 1000;

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

int exponent_of(const char* p, const char* end) {
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  int value = 0;
  for (; p != end && is_digit(*p); ++p) value = std::min(10 * value + (*p - '0'), kLargestExponent);
  return negative ? -value : value;
}

// Digits between the decimal sign and `end`, read from the end.
void set_padding(const char* mark, const char* end, PrintedDigits& result) {
  const auto run_of = [&](const char* last, char digit) {
    const char* p = last;
    while (p - 1 != mark && p[-1] == digit) --p;
    return p;
  };
  const char* last = run_of(end, '0');
  int carry = 0;
  if (last == end && end - mark > 2 && (end[-1] == '1' || end[-1] == '9')) {
    // One more or less in the last digit: zeros or nines before it.
    const char* near = run_of(end - 1, end[-1] == '1' ? '0' : '9');
    if (near != end - 1 && near - 1 != mark) {
      last = near;
      carry = end[-1] == '9' ? 1 : 0;
    }
  }
  result.padding = static_cast<int>(end - last);
  if (last - 1 != mark) result.last = last[-1] - '0' + carry;
}

// Half of ten to the power `unit`, converted from decimal: powers of ten are no doubles.
double half_of(int unit) {
  const std::string half = "5e" + std::to_string(unit - 1);
  double value = 0.0;
  fast_float::from_chars(half.data(), half.data() + half.size(), value);
  return std::isfinite(value) ? value : 0.0;  // zeros may have any exponent
}

}  // namespace

PrintedDigits digits_of(std::string_view field) {
  PrintedDigits result;
  const char* p = field.data();
  const char* const end = p + field.size();
  while (p != end && (*p == '"' || *p == '+' || *p == '-')) ++p;
  const char* first = nullptr;  // digit that is not 0
  const char* mark = nullptr;   // decimal point or comma
  for (; p != end; ++p) {
    if (is_digit(*p)) {
      if (first == nullptr && *p != '0') first = p;
    } else if (mark == nullptr && (*p == '.' || *p == ',')) {
      mark = p;
    } else {
      break;
    }
  }
  result.zero = first == nullptr;
  if (first != nullptr) {
    const bool mark_inside = mark != nullptr && mark > first;
    result.significant = static_cast<int>(p - first) - (mark_inside ? 1 : 0);
  }
  if (mark != nullptr) {
    result.unit = -static_cast<int>(p - mark - 1);
    set_padding(mark, p, result);
  } else if (first != nullptr) {
    result.last = p[-1] - '0';
  }
  result.exponent = p != end && (*p == 'e' || *p == 'E' || *p == 'd' || *p == 'D');
  if (result.exponent) result.unit += exponent_of(p + 1, end);
  return result;
}

void ColumnDigits::add(const PrintedDigits& number) {
  number.exponent ? add_exponent(number) : add_fixed(number);
}

void ColumnDigits::add_fixed(const PrintedDigits& number) {
  fixed_unit_ = fixed_ == 0 ? number.unit : std::min(fixed_unit_, number.unit);
  ++fixed_;
  if (number.zero) return;
  const int above = number.unit + number.significant;
  largest_ = fixed_nonzero_ == 0 ? above : std::max(largest_, above);
  const int used = number.unit + number.padding;
  if (fixed_nonzero_ == 0 || used < used_unit_) {
    const bool next = fixed_nonzero_ > 0 && used + 1 == used_unit_;
    used_ = {0, next ? used_[0] : 0};
    used_digits_ = {0, next ? used_digits_[0] : 0};
    used_unit_ = used;
  }
  ++fixed_nonzero_;
  if (used > used_unit_ + 1 || number.last == 0) return;
  const auto place = static_cast<std::size_t>(used - used_unit_);
  ++used_[place];
  used_digits_[place] |= 1U << static_cast<unsigned>(number.last);
}

void ColumnDigits::add_exponent(const PrintedDigits& number) {
  // The exponent of a zero means nothing, unless there is nothing else.
  const bool first = exponents_ == 0 || (!number.zero && exponents_nonzero_ == 0);
  ++exponents_;
  if (number.zero && !first) return;
  if (!number.zero) ++exponents_nonzero_;
  if (first || number.significant > significant_) {
    significant_ = number.significant;
    exponent_unit_ = number.unit;
  } else if (number.significant == significant_) {
    exponent_unit_ = std::max(exponent_unit_, number.unit);
  }
}

bool ColumnDigits::has_exponents() const {
  if (fixed_ == 0 || exponents_ == 0) return fixed_ == 0;
  if (fixed_nonzero_ == exponents_nonzero_) return exponent_unit_ < fixed_unit_;
  return exponents_nonzero_ > fixed_nonzero_;
}

int ColumnDigits::unit() const { return has_exponents() ? exponent_unit_ : fixed_unit_; }

int ColumnDigits::padding() const {
  if (has_exponents()) return 0;
  return fixed_nonzero_ == 0 ? kAllZeros : used_unit_ - fixed_unit_;
}

bool ColumnDigits::shows_rounding() const {
  const std::size_t used = used_[0] + used_[1];
  return used >= kTellingNumbers && 2 * used >= fixed_nonzero_ &&
         std::popcount(used_digits_[0] | used_digits_[1]) >= kTellingDigits;
}

std::vector<double> half_units(std::span<const ColumnDigits> columns) {
  // All columns come from one format, so padding is common to them. Round abscissae alone are
  // exact numbers, not rounded ones.
  int common = kAllZeros;
  int above = 0;
  bool first = true;
  for (const ColumnDigits& column : columns) {
    common = std::min(common, column.padding());
    above = first ? column.above() : std::max(above, column.above());
    first = false;
  }
  const bool tells = std::any_of(columns.begin(), columns.end(), [&](const ColumnDigits& column) {
    return column.padding() == common && column.shows_rounding() &&
           above - (column.unit() + common) >= kTellingLength;
  });
  std::vector<double> out;
  for (const ColumnDigits& column : columns) {
    out.push_back(column.empty() ? 0.0 : half_of(column.unit() + (tells ? common : 0)));
  }
  return out;
}

HalfUnits half_units(const ColumnDigits& x, const ColumnDigits& y) {
  const std::vector<double> both = half_units(std::array{x, y});
  return {both[0], both[1]};
}

}  // namespace obvid::text
