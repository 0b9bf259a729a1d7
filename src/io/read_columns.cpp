// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/internal/read_columns.h"

#include <utility>

#include "number_rows.h"
#include "obvid/core/files.h"

namespace obvid {

std::optional<std::size_t> ColumnTable::column(std::initializer_list<std::string_view> any) const {
  for (const std::string_view wanted : any) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == wanted) return i;
    }
  }
  return std::nullopt;
}

namespace {

/// Spreadsheets end a row whose last cells are empty with their separators: the last row of a table
/// of cells is one.
std::string_view without_empty_end(std::string_view text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n,;");
  return end == std::string_view::npos ? text : text.substr(0, end + 1);
}

}  // namespace

Result<ColumnTable> parse_columns(std::string_view text, std::string_view name) {
  auto rows = number_rows(without_empty_end(text), name);
  OBVID_TRY(rows);
  ColumnTable out;
  if (const int z = column_named(*rows, "z"); z >= 0) out.heights = static_cast<std::size_t>(z);
  for (ColumnName& one : rows->columns) out.names.push_back(std::move(one.name));
  for (NumberRow& row : rows->rows) {
    out.rows.push_back(std::move(row.values));
    out.lines.push_back(row.line);
  }
  return out;
}

Result<ColumnTable> read_columns(const std::string& path) {
  const Result<std::string> text = read_file(path);
  OBVID_TRY(text);
  return parse_columns(*text, path == "-" ? "standard input" : path);
}

}  // namespace obvid
