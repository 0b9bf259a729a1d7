// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"

namespace obvid {

/// A table of numbers, row by row; the last rows may be shorter than the first.
struct ColumnTable {
  std::vector<std::string> names;  ///< lower case, without units; empty when there is no header
  std::vector<std::vector<double>> rows;
  std::vector<std::size_t> lines;        ///< of each row in the file, from 1
  std::optional<std::size_t> heights{};  ///< column z, or what surveys call it beside x and y

  /// Place of a column by one of its names.
  [[nodiscard]] std::optional<std::size_t> column(
      std::initializer_list<std::string_view> any) const;
};

/// Reads a file, or standard input for "-", in the forms of rows that docs/formats.md names.
/// Errors: E301, E302, E303, E311 nothing there, E306.
[[nodiscard]] Result<ColumnTable> read_columns(const std::string& path);
[[nodiscard]] Result<ColumnTable> parse_columns(std::string_view text, std::string_view name);

}  // namespace obvid
