// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace obvid {

/// Table for the eye: columns right-aligned, numbers by their decimal points.
class Table {
 public:
  enum class Align { kLeft, kDecimal };

  /// `head` may have several lines, parted by '\n'; the lowest stands on the column.
  void column(std::string head, Align align = Align::kDecimal);
  /// One that is left out where all of its cells are empty or "-".
  void column_if_told(std::string head, Align align = Align::kDecimal);
  void row(std::vector<std::string> cells);
  /// A line of dots where rows were left out.
  void gap();
  [[nodiscard]] std::string text() const;

 private:
  struct Column {
    std::vector<std::string> head;
    Align align = Align::kDecimal;
    bool if_told = false;
  };
  [[nodiscard]] bool is_told(std::size_t column) const;
  /// Widest head and cells of a column, and the widest parts before and from the decimal point.
  struct Width {
    std::size_t before = 0;
    std::size_t after = 0;
    std::size_t total = 0;
  };
  [[nodiscard]] Width width_of(std::size_t column) const;
  [[nodiscard]] std::string all_columns() const;
  [[nodiscard]] std::string head_text(const std::vector<Width>& widths) const;
  [[nodiscard]] static std::string padded(const std::string& cell, const Width& width, Align align);

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;  // an empty row is a gap
};

/// Which rows of a long list are shown: all of a short one, else the first and last few and those
/// of greatest `value` (NaN counts as least). Ascending.
[[nodiscard]] std::vector<std::size_t> rows_worth_showing(const std::vector<double>& value);

/// Adds these rows, `add(i)` row i, with a gap wherever some are left out. How many there are.
template <class Add>
std::size_t add_rows_worth_showing(const std::vector<double>& value, Table& table, const Add& add) {
  const std::vector<std::size_t> shown = rows_worth_showing(value);
  std::size_t next = 0;
  for (const std::size_t i : shown) {
    if (i > next) table.gap();
    next = i + 1;
    add(i);
  }
  return shown.size();
}

/// "shown: the first 6, the last 6 and the 6 widest of 200 segments", or "" when all are shown.
[[nodiscard]] std::string shown_note(std::size_t shown, std::size_t all, const char* greatest,
                                     const char* what);

}  // namespace obvid
