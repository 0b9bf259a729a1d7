// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/page_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "obvid/core/internal/shown_text.h"
#include "obvid/core/version.h"
#include "obvid/pipeline/internal/job_values.h"

namespace obvid {
namespace {

constexpr std::size_t kMostRows = 1000;
constexpr std::size_t kPageDigits = 10;

constexpr const char* kPageStyle = R"(<style>
:root { color-scheme: light dark; --ink: #1c2733; --faint: #5b6773; --paper: #fff; --line: #d5dbe1; --good: #1a7f37; --bad: #c62828; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6eaee; --faint: #9aa6b2; --paper: #14191f; --line: #39434f; --good: #57d27a; --bad: #ff7b72; } }
body { margin: 2em auto; max-width: 1000px; padding: 0 1em; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; }
svg { display: block; width: 100%; height: auto; margin: 1em 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; font-size: 1.15em; padding: 1em 0 .3em; }
th, td { text-align: left; padding: .2em 1.5em .2em 0; border-bottom: 1px solid var(--line); vertical-align: top; font-weight: normal; }
th { color: var(--faint); }
.numbers th, .numbers td { text-align: right; }
#verdict { font-weight: 600; }
#verdict.kept { color: var(--good); }
#verdict.broken { color: var(--bad); }
footer { color: var(--faint); margin-top: 2em; }
@media print { body { margin: 0; } thead { display: table-header-group; } tr, svg { break-inside: avoid; } }
</style>)";

std::string figure_row(const std::string& label, const std::string& value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped_xml(label),
                     escaped_xml(value));
}

/// Cells of a line; those in quotation marks may hold commas, and quotation marks twice.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> out = {""};
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"') {
      out.back() += line[++k];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

std::string cell_text(const std::string& cell) {
  if (cell.empty()) return "-";
  // what is short, or has no fraction, is as it was meant: names such as 9.10 and 20240131
  const bool figure = cell.size() > kPageDigits && cell.find_first_of(".eE") != std::string::npos;
  const auto number = figure ? obvid::typed_number(cell) : std::nullopt;
  if (!number || !std::isfinite(*number)) return escaped_xml(cell);
  return fmt::format("{:.{}g}", *number, kPageDigits);
}

std::string row_text(std::string_view line, const char* tag) {
  std::string out = "<tr>";
  for (const std::string& cell : cells_of(line)) {
    out += fmt::format("<{}>{}</{}>", tag, cell_text(cell), tag);
  }
  return out + "</tr>\n";
}

}  // namespace

std::string figures_of_page(const ReportPage::Figures& figures) {
  std::string rows;
  for (const auto& [label, value] : figures) rows += figure_row(label, value);
  return "<table id=\"figures\"><caption>Figures</caption>\n<tbody>\n" + rows +
         "</tbody></table>\n";
}

std::string table_of_csv(std::string_view id, std::string_view caption, std::string_view csv) {
  std::vector<std::string_view> lines;
  while (!csv.empty()) {
    const auto end = std::min(csv.find('\n'), csv.size());
    if (end > 0) lines.push_back(csv.substr(0, end));
    csv.remove_prefix(std::min(end + 1, csv.size()));
  }
  if (lines.size() < 2) return {};
  const std::size_t shown = std::min(lines.size() - 1, kMostRows);
  std::string out = fmt::format("<table id=\"{}\" class=\"numbers\"><caption>{}", id,
                                escaped_xml(std::string(caption)));
  if (shown < lines.size() - 1) out += fmt::format(", the first {} of {}", shown, lines.size() - 1);
  out += "</caption>\n<thead>" + row_text(lines.front(), "th") + "</thead>\n<tbody>\n";
  for (std::size_t k = 1; k <= shown; ++k) out += row_text(lines[k], "td");
  return out + "</tbody></table>\n";
}

std::string page_text(const ReportPage& page) {
  const std::string name = escaped_xml(page.title);
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  out +=
      fmt::format("<title>{}</title>\n{}\n</head>\n<body>\n<h1>{}</h1>\n", name, kPageStyle, name);
  constexpr std::array kClasses = {"", " class=\"kept\"", " class=\"broken\""};
  out += fmt::format("<p id=\"verdict\"{}>{}</p>\n", kClasses[static_cast<std::size_t>(page.kind)],
                     escaped_xml(page.verdict));
  for (const std::string& picture : page.pictures) out += picture;
  out += figures_of_page(page.figures);
  for (const std::string& table : page.tables) out += table;
  return out + fmt::format("<footer>Obvid {}</footer>\n</body>\n</html>\n", kVersion);
}

}  // namespace obvid
