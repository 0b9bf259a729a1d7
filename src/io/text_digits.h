// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace obvid::text {

/// How a number was printed.
struct PrintedDigits {
  bool exponent = false;  ///< with a power of ten behind it
  bool zero = true;
  int significant = 0;  ///< digits from the first that is not 0 to the last one printed
  int unit = 0;         ///< power of ten of the last digit
  int padding = 0;      ///< zeros at the end, behind the decimal sign; two and more also where
                        ///< they miss by one, as 0.9856099 for 0.98561 in single precision
  int last = 0;         ///< last digit before the padding, 0 when there is none
};

/// Looks at a field that `parse_number` has read as a number.
[[nodiscard]] PrintedDigits digits_of(std::string_view field);

/// What the numbers of one column say about its last digit (docs/methods/io.md).
class ColumnDigits {
 public:
  void add(const PrintedDigits& number);
  [[nodiscard]] bool empty() const { return fixed_ + exponents_ == 0; }
  /// Power of ten of the last digit printed.
  [[nodiscard]] int unit() const;
  /// Zeros that end every number of the column; a large number when all are zeros, 0 with
  /// exponents.
  [[nodiscard]] int padding() const;
  /// Power of ten above the largest number without exponent.
  [[nodiscard]] int above() const { return largest_; }
  /// Whether the digits before the padding are those of rounded numbers.
  [[nodiscard]] bool shows_rounding() const;

 private:
  [[nodiscard]] bool has_exponents() const;
  void add_fixed(const PrintedDigits& number);
  void add_exponent(const PrintedDigits& number);

  std::size_t fixed_ = 0, fixed_nonzero_ = 0;
  int fixed_unit_ = 0;                     ///< least
  int used_unit_ = 0;                      ///< least without padding
  std::array<std::size_t, 2> used_{};      ///< numbers that end there, and one digit before
  std::array<unsigned, 2> used_digits_{};  ///< a bit for each digit that they end with
  int largest_ = 0;                        ///< power of ten above the largest number
  std::size_t exponents_ = 0, exponents_nonzero_ = 0;
  int significant_ = 0;    ///< most digits of a mantissa
  int exponent_unit_ = 0;  ///< largest among the numbers with that many
};

/// Half units of the last digits of two columns that one program printed; 0 for an empty one.
struct HalfUnits {
  double x = 0.0;
  double y = 0.0;
};
[[nodiscard]] HalfUnits half_units(const ColumnDigits& x, const ColumnDigits& y);
/// The same of any number of columns.
[[nodiscard]] std::vector<double> half_units(std::span<const ColumnDigits> columns);

}  // namespace obvid::text
