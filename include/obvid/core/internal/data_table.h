// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace obvid {

/// What stands in a table for programs: a text, a figure with all its digits, or nothing.
class DataCell {
 public:
  DataCell() = default;
  DataCell(std::string text) : value_(std::move(text)) {}
  DataCell(const char* text) : value_(std::string(text)) {}
  DataCell(double figure) : value_(figure) {}
  DataCell(const std::optional<double>& figure) {
    if (figure) value_ = *figure;
  }
  DataCell(std::size_t count) : value_(std::to_string(count)) {}
  DataCell(int count) : value_(std::to_string(count)) {}

  /// All digits; infinite ones are "inf" with their sign; nothing where there is none, or NaN.
  [[nodiscard]] std::string text() const;
  /// The same, figures with `digits` significant ones.
  [[nodiscard]] std::string text(int digits) const;

 private:
  std::variant<std::monostate, std::string, double> value_;
};

/// Nothing where the figure is not finite.
[[nodiscard]] DataCell finite_cell(double figure);

using DataRow = std::vector<DataCell>;

/// Rows have as many cells as there are heads, or fewer: what is missing at their end is empty.
struct DataTable {
  std::vector<std::string> heads;
  std::vector<DataRow> rows{};
};

/// Heads as they stand in a line of CSV: "s,x,y".
[[nodiscard]] std::vector<std::string> heads_of(const char* line);

/// A cell of CSV: in quotation marks where it has to be (RFC 4180).
[[nodiscard]] std::string csv_cell(const std::string& text);
/// Empty where it is no finite number.
[[nodiscard]] std::string csv_cell(double value);

/// Heads, then a line for each row.
[[nodiscard]] std::string csv_text(const DataTable& table);

}  // namespace obvid
