// SPDX-License-Identifier: Apache-2.0
#include "read_points_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "text_lines.h"

namespace obvid {
namespace {

using std::string_view;

// How far a point may move, said outright or as the 95 % interval of a measurement; the first of
// these that a file has.
constexpr std::array<string_view, 9> kToleranceNames{
    "tol", "tolerance", "u95", "ci95", "uncertainty", "unc", "+-", "+/-", "\xC2\xB1"};

// Lower case, without quotes, brackets, unit and the words that programs put around x and y:
// "X [mm]", "x_m", "[X-Coordinate]", "x/c" all give "x".
std::string plain_name(string_view cell) {
  std::string name;
  for (const char c : text::trim(cell)) {
    if (c != '"' && c != '\'')
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (!name.empty() && (name[0] == '[' || name[0] == '(')) name.erase(0, 1);
  name.erase(std::min(name.find_first_of(" [(])"), name.size()));
  static constexpr std::array<string_view, 8> kEndings{"-coordinate", "_coordinate", "/c",  "_mm",
                                                       "_cm",         "_m",          "_in", "_ft"};
  for (const string_view ending : kEndings) {
    const bool ends = name.size() > ending.size() &&
                      string_view(name).substr(name.size() - ending.size()) == ending;
    if (ends) name.erase(name.size() - ending.size());
  }
  return name;
}

// "[Curve Length]  [X-Coordinate]": names in brackets that may hold blanks.
std::vector<std::string> bracket_names(string_view line) {
  std::vector<std::string> names;
  for (std::size_t open = line.find('['); open != string_view::npos; open = line.find('[')) {
    const std::size_t close = line.find(']', open);
    if (close == string_view::npos) break;
    names.push_back(plain_name(line.substr(open, close - open + 1)));
    line.remove_prefix(close + 1);
  }
  return names;
}

bool is_unit(string_view cell) { return !cell.empty() && (cell[0] == '[' || cell[0] == '('); }

std::vector<std::string> column_names(string_view line, text::Separator separator) {
  if (separator == text::Separator::kWhite && is_unit(text::trim(line))) return bracket_names(line);
  text::Fields fields;
  text::split(line, separator, fields);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < fields.count; ++i) {
    // "x [mm]" between blanks: the unit belongs to the name before.
    if (separator == text::Separator::kWhite && i > 0 && is_unit(fields.cell[i])) continue;
    names.push_back(plain_name(fields.cell[i]));
  }
  return names;
}

text::Separator header_separator(string_view line) {
  if (line.find(';') != string_view::npos) return text::Separator::kSemicolon;
  if (line.find('\t') != string_view::npos) return text::Separator::kTab;
  if (line.find(',') != string_view::npos) return text::Separator::kComma;
  return text::Separator::kWhite;
}

}  // namespace

std::optional<Columns> read_header(string_view line) {
  const text::Separator separator = header_separator(text::trim(line));
  const std::vector<std::string> names = column_names(text::trim(line), separator);
  const auto find = [&](string_view name) -> std::optional<std::size_t> {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) return std::nullopt;
    return static_cast<std::size_t>(at - names.begin());
  };
  const auto x = find("x");
  const auto y = find("y");
  if (!x || !y) return std::nullopt;
  Columns columns;
  columns.x = *x;
  columns.y = *y;
  columns.z = find("z");
  columns.heading_deg = find("heading_deg");
  columns.radius = find("radius");
  columns.kappa = find("kappa");
  for (const string_view name : kToleranceNames) {
    if (!columns.tolerance) columns.tolerance = find(name);
  }
  columns.corner = find("corner");
  columns.tab_separated = separator == text::Separator::kTab;
  return columns;
}

}  // namespace obvid
