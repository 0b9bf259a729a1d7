// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/page_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "obvid/core/internal/shown_text.h"
#include "obvid/core/version.h"
#include "obvid/picture/internal/styles.h"

namespace obvid {
namespace {

constexpr std::size_t kMostRows = 1000;
constexpr int kPageDigits = 10;

std::string figure_row(const std::string& label, const std::string& value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped_xml(label),
                     escaped_xml(value));
}

std::string list_of(const char* id, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string out = fmt::format("<ul id=\"{}\">\n", id);
  for (const std::string& one : sentences) out += "<li>" + escaped_xml(one) + "</li>\n";
  return out + "</ul>\n";
}

std::string cell_text(const DataCell& cell) {
  const std::string text = cell.text(kPageDigits);
  return text.empty() ? "-" : escaped_xml(text);
}

/// Columns that have a cell which says something.
std::vector<std::size_t> told_columns(const DataTable& table) {
  std::vector<std::size_t> out;
  for (std::size_t c = 0; c < table.heads.size(); ++c) {
    const bool told = std::any_of(table.rows.begin(), table.rows.end(), [c](const DataRow& row) {
      return c < row.size() && !row[c].text(kPageDigits).empty();
    });
    if (told) out.push_back(c);
  }
  return out;
}

}  // namespace

std::string figures_of_page(const ReportPage::Figures& figures) {
  std::string rows;
  for (const auto& [label, value] : figures) rows += figure_row(label, value);
  return "<table id=\"figures\"><caption>Figures</caption>\n<tbody>\n" + rows +
         "</tbody></table>\n";
}

std::string table_of_page(std::string_view id, std::string_view caption, const DataTable& table) {
  if (table.rows.empty()) return {};
  const std::size_t shown = std::min(table.rows.size(), kMostRows);
  std::string out = fmt::format("<table id=\"{}\" class=\"numbers\"><caption>{}", id,
                                escaped_xml(std::string(caption)));
  if (shown < table.rows.size()) {
    out += fmt::format(", the first {} of {}", shown, table.rows.size());
  }
  const std::vector<std::size_t> columns = told_columns(table);
  out += "</caption>\n<thead><tr>";
  for (const std::size_t c : columns) out += fmt::format("<th>{}</th>", cell_text(table.heads[c]));
  out += "</tr>\n</thead>\n<tbody>\n";
  for (std::size_t k = 0; k < shown; ++k) {
    out += "<tr>";
    const DataRow& row = table.rows[k];
    for (const std::size_t c : columns) {
      out += fmt::format("<td>{}</td>", cell_text(c < row.size() ? row[c] : DataCell{}));
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table>\n";
}

std::string page_text(const ReportPage& page) {
  const std::string name = escaped_xml(page.title);
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  out += fmt::format("<title>{}</title>\n{}</head>\n<body>\n<h1>{}</h1>\n", name,
                     picture::style_element(picture::report_page_style()), name);
  constexpr std::array kClasses = {"", " class=\"kept\"", " class=\"broken\""};
  out += fmt::format("<p id=\"verdict\"{}>{}</p>\n", kClasses[static_cast<std::size_t>(page.kind)],
                     escaped_xml(page.verdict));
  out += list_of("warnings", page.warnings);
  for (const std::string& picture : page.pictures) out += picture;
  out += figures_of_page(page.figures);
  for (const std::string& table : page.tables) out += table;
  out += list_of("notes", page.notes);
  return out + fmt::format("<footer>Obvid {}</footer>\n</body>\n</html>\n", kVersion);
}

}  // namespace obvid
