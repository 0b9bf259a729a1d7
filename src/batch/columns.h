// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace obvid::batch {

/// What is known of many items, column by column.
struct Column {
  enum class Type { kText, kSmall, kCount, kNumber };  ///< UTF-8; 8 bits; 32 bits; double
  std::string name;
  Type type = Type::kNumber;
  std::string meaning{};
  std::vector<std::string> texts{};
  std::vector<double> numbers{};  ///< of the other types; counts are exact

  [[nodiscard]] std::size_t size() const {
    return type == Type::kText ? texts.size() : numbers.size();
  }
};

/// A count or a verdict that nobody knows; numbers are then NaN.
inline constexpr double kUnknownCount = -1.0;

struct Columns {
  std::vector<Column> all;

  [[nodiscard]] std::size_t rows() const { return all.empty() ? 0 : all.front().size(); }
  /// Nothing where there is no such column.
  [[nodiscard]] const Column* named(const std::string& name) const;
  /// The same columns without rows.
  [[nodiscard]] Columns empty() const;
  /// Rows of the same columns behind these.
  void append(const Columns& more);
  /// Takes out the first rows.
  [[nodiscard]] Columns take_front(std::size_t rows);
  /// Bytes of the longest text of each column, at least 1; 0 of numbers.
  [[nodiscard]] std::vector<std::size_t> widths() const;
};

}  // namespace obvid::batch
