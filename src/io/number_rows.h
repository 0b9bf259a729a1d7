// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/units.h"
#include "read_points_header.h"
#include "text_digits.h"
#include "text_lines.h"

namespace obvid {

/// A line of numbers.
struct NumberRow {
  std::size_t line = 0;    ///< from 1
  bool after_gap = false;  ///< blank lines or a title stand before it
  std::vector<double> values;
};

/// A text of numbers in rows.
struct NumberRows {
  std::vector<std::string> header;  ///< names of columns: a line of words before the first row
  std::vector<ColumnName> columns;  ///< the same, understood
  std::vector<NumberRow> rows;
  /// Lines of words between rows (titles of blocks), each before the row with this index.
  struct Title {
    std::size_t row = 0;
    std::string text;
  };
  std::vector<Title> titles;
  std::vector<text::ColumnDigits> digits;  ///< of the numbers, by their place in their rows

  /// Half a unit of the last digit printed in these columns; 0 for those that are not there.
  [[nodiscard]] std::vector<double> rounding(std::span<const int> wanted) const;
};

/// Rows of numbers of any length, separated as `read_points` allows; comments and blank lines are
/// passed over. Words alone make a header or a title; numbers and words in one line are an error.
/// Errors: E302, E303, E304 nothing there, E306, E310.
[[nodiscard]] Result<NumberRows> number_rows(std::string_view text, std::string_view name);

/// Fields of a line, however many.
void split_all(std::string_view line, text::Separator separator,
               std::vector<std::string_view>& fields);

/// Column of this name ("x" for "X [mm]", "x_m"); -1 when there is none.
[[nodiscard]] int column_named(const NumberRows& rows, std::string_view name);

/// Unit that the names of the columns x, y and z state; assumed when they state none. Error E310
/// when they differ.
[[nodiscard]] Result<Units> units_of_columns(const NumberRows& rows, std::string_view name);

/// A matrix of numbers: rows of equal length, too long for points x y z with a number.
[[nodiscard]] bool is_matrix(const NumberRows& rows);

/// Error at a line of a file.
[[nodiscard]] Error error_at(ErrorCode code, std::string what, std::string_view name,
                             std::size_t line, std::string hint = {});

/// Name without folders.
[[nodiscard]] std::string file_name(const std::string& path);

}  // namespace obvid
