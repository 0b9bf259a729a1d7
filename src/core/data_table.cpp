// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/data_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obvid {

std::string DataCell::text() const {
  if (const auto* text = std::get_if<std::string>(&value_)) return *text;
  const auto* figure = std::get_if<double>(&value_);
  return figure != nullptr && !std::isnan(*figure) ? fmt::format("{}", *figure) : "";
}

std::string DataCell::text(int digits) const {
  const auto* figure = std::get_if<double>(&value_);
  if (figure == nullptr || std::isnan(*figure)) return text();
  return fmt::format("{:.{}g}", *figure, digits);
}

DataCell finite_cell(double figure) {
  return std::isfinite(figure) ? DataCell(figure) : DataCell();
}

std::vector<std::string> heads_of(const char* line) {
  std::vector<std::string> out = {""};
  for (; *line != '\0'; ++line) {
    if (*line == ',') {
      out.emplace_back();
    } else {
      out.back() += *line;
    }
  }
  return out;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csv_cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string csv_text(const DataTable& table) {
  std::string out;
  const auto add = [&](std::size_t k, const std::string& cell) {
    if (k > 0) out += ',';
    out += csv_cell(cell);
  };
  for (std::size_t k = 0; k < table.heads.size(); ++k) add(k, table.heads[k]);
  out += '\n';
  for (const DataRow& row : table.rows) {
    const std::size_t cells = std::max(row.size(), table.heads.size());
    for (std::size_t k = 0; k < cells; ++k) add(k, k < row.size() ? row[k].text() : "");
    out += '\n';
  }
  return out;
}

}  // namespace obvid
