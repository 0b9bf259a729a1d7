// SPDX-License-Identifier: Apache-2.0
#include "read_points_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "obvid/core/units.h"
#include "text_lines.h"

namespace obvid {
namespace {

using std::string_view;

// How far a point may move, said outright or as the 95 % interval of a measurement; the first of
// these that a file has.
constexpr std::array<string_view, 9> kToleranceNames{
    "tol", "tolerance", "u95", "ci95", "uncertainty", "unc", "+-", "+/-", "\xC2\xB1"};

/// What surveys call x and y. The two stand in either order: points are listed as P, N, E, Z, D in
/// some countries and as nr, E, N, H in others.
struct PlaceNames {
  string_view x, y;
  bool degrees = false;
};
constexpr std::array<PlaceNames, 12> kPlaceNames{{{"easting", "northing"},
                                                  {"eastings", "northings"},
                                                  {"east", "north"},
                                                  {"e", "n"},
                                                  {"rechtswert", "hochwert"},
                                                  {"rechts", "hoch"},
                                                  {"ostwert", "nordwert"},
                                                  {"ost", "nord"},
                                                  {"longitude", "latitude", true},
                                                  {"lon", "lat", true},
                                                  {"long", "lat", true},
                                                  {"lng", "lat", true}}};

// Heights beside them; the first of these that a file has. The umlaut as UTF-8, small and large,
// and as Latin-1.
constexpr std::array<string_view, 12> kHeightNames{
    "z",   "elevation",   "elev",        "elev.",   "height", "hoehe",
    "ele", "h\xC3\xB6he", "h\xC3\x96he", "h\xF6he", "h",      "altitude"};

// What a list of measured points has beside its places: not worth a warning.
constexpr std::array<string_view, 24> kRemarkNames{
    "point",       "points", "pt",    "pnt",         "p",      "nr",   "nr.",   "no",
    "no.",         "number", "num",   "id",          "name",   "code", "punkt", "pkt",
    "punktnummer", "desc",   "desc.", "description", "remark", "d",    "art",   "punktnr"};

std::optional<std::size_t> place_of(const std::vector<ColumnName>& names, string_view name) {
  const auto at = std::find_if(names.begin(), names.end(),
                               [&](const ColumnName& one) { return one.name == name; });
  if (at == names.end()) return std::nullopt;
  return static_cast<std::size_t>(at - names.begin());
}

/// The pair of names that these columns have for x and y; null when they have none, or x and y.
const PlaceNames* survey_names(const std::vector<ColumnName>& names) {
  if (place_of(names, "x") && place_of(names, "y")) return nullptr;
  const auto* const at = std::find_if(
      kPlaceNames.begin(), kPlaceNames.end(),
      [&](const PlaceNames& one) { return place_of(names, one.x) && place_of(names, one.y); });
  return at == kPlaceNames.end() ? nullptr : at;
}

std::optional<std::size_t> survey_height(const std::vector<ColumnName>& names) {
  for (const string_view name : kHeightNames) {
    if (const auto at = place_of(names, name)) return at;
  }
  return std::nullopt;
}

/// Names of columns without a meaning.
std::vector<std::string> unused_names(const std::vector<ColumnName>& names, const Columns& used) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::optional<std::size_t> here = i;
    const bool means = i == used.x || i == used.y || used.z == here || used.heading_deg == here ||
                       used.radius == here || used.kappa == here || used.tolerance == here ||
                       used.corner == here || used.heading_min == here ||
                       used.heading_max == here || used.radius_min == here ||
                       used.radius_max == here || used.kappa_min == here || used.kappa_max == here;
    const bool remark = used.of_survey && std::find(kRemarkNames.begin(), kRemarkNames.end(),
                                                    names[i].name) != kRemarkNames.end();
    if (!means && !remark && !names[i].name.empty()) out.push_back(names[i].name);
  }
  return out;
}

std::string lower(string_view text) {
  std::string out;
  for (const char c : text) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

// "mm" of "mm]" and of "mm)", "m" of "1/m"; empty when it is none.
std::string unit_in(string_view text) {
  text = text::trim(text.substr(0, text.find_first_of(")]")));
  if (text.starts_with("1/")) text.remove_prefix(2);
  return canonical_unit(text).value_or("");
}

// What brackets behind a name say.
void set_unit(string_view text, ColumnName& out) {
  out.unit = unit_in(text);
  if (!out.unit.empty()) return;
  const string_view said = text::trim(text.substr(0, text.find_first_of(")]")));
  if (said != "-" && said != "1") out.no_unit = said;  // these say that there is none
}

// Name and unit of a column. Lower case, without quotes, brackets and the words that programs put
// around x and y: "X [mm]", "x_mm", "x(mm)", "X / mm", "[X-Coordinate]", "x/c" are all x.
ColumnName column_name(string_view cell) {
  std::string name;
  for (const char c : text::trim(cell)) {
    if (c != '"' && c != '\'') name += c;
  }
  if (!name.empty() && (name[0] == '[' || name[0] == '(')) name.erase(0, 1);
  ColumnName out;
  if (const std::size_t open = name.find_first_of("[("); open != std::string::npos) {
    set_unit(string_view(name).substr(open + 1), out);
    name.erase(open);
  }
  if (const std::size_t slash = name.find('/'); slash != std::string::npos && slash > 0) {
    const string_view rest = text::trim(string_view(name).substr(slash + 1));
    const std::string unit = lower(rest) == "c" ? "chord" : unit_in(rest);
    if (out.unit.empty()) out.unit = unit;
    if (!unit.empty()) name.erase(slash);
  }
  name.erase(std::min(name.find_first_of(" \t)]"), name.size()));
  name = lower(name);
  for (const string_view ending : {"-coordinate", "_coordinate"}) {
    if (name.ends_with(ending)) name.erase(name.size() - ending.size());
  }
  if (const std::size_t bar = name.rfind('_'); bar != std::string::npos && bar > 0) {
    if (std::string unit = unit_in(string_view(name).substr(bar + 1)); !unit.empty()) {
      out.unit = std::move(unit);
      name.erase(bar);
    }
  }
  out.name = std::move(name);
  return out;
}

// "[Curve Length]  [X-Coordinate]": names in brackets that may hold blanks.
std::vector<ColumnName> bracket_names(string_view line) {
  std::vector<ColumnName> names;
  for (std::size_t open = line.find('['); open != string_view::npos; open = line.find('[')) {
    const std::size_t close = line.find(']', open);
    if (close == string_view::npos) break;
    names.push_back(column_name(line.substr(open, close - open + 1)));
    line.remove_prefix(close + 1);
  }
  return names;
}

bool is_unit(string_view cell) { return !cell.empty() && (cell[0] == '[' || cell[0] == '('); }

// Between blanks the unit of "x [mm]" and of "x / mm" belongs to the name before.
std::vector<ColumnName> names_between_blanks(const text::Fields& fields) {
  std::vector<ColumnName> names;
  for (std::size_t i = 0; i < fields.count; ++i) {
    const string_view cell = fields.cell[i];
    if (is_unit(cell) && !names.empty()) {
      set_unit(cell.substr(1), names.back());
    } else if (cell == "/" && !names.empty() && i + 1 < fields.count) {
      names.back().unit = unit_in(fields.cell[++i]);
    } else {
      names.push_back(column_name(cell));
    }
  }
  return names;
}

text::Separator header_separator(string_view line) {
  if (line.find(';') != string_view::npos) return text::Separator::kSemicolon;
  if (line.find('\t') != string_view::npos) return text::Separator::kTab;
  if (line.find(',') != string_view::npos) return text::Separator::kComma;
  return text::Separator::kWhite;
}

/// What lengths of a column become in those of the coordinates; 1 where nothing is said.
double scale_of(const std::vector<ColumnName>& names, std::optional<std::size_t> column,
                const std::string& unit) {
  if (!column || names[*column].unit.empty() || unit.empty()) return 1.0;
  return unit_ratio(names[*column].unit, unit).value_or(1.0);
}

/// Samples that `samples_csv` wrote: their headings and curvatures say what the curve did there,
/// not what a user fixes.
bool are_our_samples(const std::vector<ColumnName>& names) {
  static constexpr std::array<string_view, 7> kOurs{
      "s", "x", "y", "heading_deg", "curvature", "normal_x", "normal_y"};
  return std::equal(names.begin(), names.end(), kOurs.begin(), kOurs.end(),
                    [](const ColumnName& name, string_view ours) {
                      return name.name == ours ||
                             (ours == "curvature" && name.name == "curvature_1_per");
                    });
}

}  // namespace

std::vector<ColumnName> column_names(string_view line) {
  line = text::trim(line);
  const text::Separator separator = header_separator(line);
  if (separator == text::Separator::kWhite && is_unit(line)) return bracket_names(line);
  text::Fields fields;
  text::split(line, separator, fields);
  if (separator == text::Separator::kWhite) return names_between_blanks(fields);
  std::vector<ColumnName> names;
  for (std::size_t i = 0; i < fields.count; ++i) names.push_back(column_name(fields.cell[i]));
  return names;
}

bool name_places(std::vector<ColumnName>& names) {
  const PlaceNames* const survey = survey_names(names);
  if (survey == nullptr) return false;
  const auto x = place_of(names, survey->x), y = place_of(names, survey->y);
  const auto z = survey_height(names);
  for (ColumnName& other : names) {
    if (other.name == "x" || other.name == "y") other.name.clear();
  }
  names[*x].name = "x";
  names[*y].name = "y";
  if (z) names[*z].name = "z";
  return true;
}

string_view known_columns() {
  return "x, y, z (easting, northing, elevation and what else surveys call them), heading_deg, "
         "radius, kappa, corner, heading_min, heading_max, radius_min, "
         "radius_max, kappa_min, kappa_max, and tol, tolerance, u95, ci95, "
         "uncertainty, unc, +-, +/- or \xC2\xB1";
}

void Columns::choose(std::size_t chosen_x, std::size_t chosen_y) {
  for (auto* meaning : {&z, &heading_deg, &radius, &kappa, &tolerance, &corner, &heading_min,
                        &heading_max, &radius_min, &radius_max, &kappa_min, &kappa_max}) {
    if (*meaning == chosen_x || *meaning == chosen_y) meaning->reset();
  }
  x = chosen_x;
  y = chosen_y;
  unit_x = x < units.size() ? units[x] : "";
  unit_y = y < units.size() ? units[y] : "";
  no_unit.clear();
  unused.clear();  // the user looked at the columns
  our_samples = false;
}

std::optional<Columns> read_header(string_view line) {
  std::vector<ColumnName> names = column_names(line);
  Columns columns;
  if (const PlaceNames* const survey = survey_names(names)) {
    columns.of_survey = true;
    columns.degrees = survey->degrees;
    if (const auto z = survey_height(names)) columns.z_name = names[*z].name;
    name_places(names);
  }
  const auto find = [&](string_view name) { return place_of(names, name); };
  const auto x = find("x");
  const auto y = find("y");
  if (!x || !y) return std::nullopt;
  columns.count = names.size();
  columns.x = *x;
  columns.y = *y;
  columns.unit_x = names[*x].unit;
  columns.unit_y = names[*y].unit;
  columns.no_unit = names[*x].no_unit.empty() ? names[*y].no_unit : names[*x].no_unit;
  for (const ColumnName& name : names) columns.units.push_back(name.unit);
  columns.z = find("z");
  columns.corner = find("corner");
  columns.tab_separated = header_separator(text::trim(line)) == text::Separator::kTab;
  columns.our_samples = are_our_samples(names);
  columns.heading_deg = find("heading_deg");
  columns.radius = find("radius");
  columns.kappa = find("kappa");
  columns.heading_min = find("heading_min");
  columns.heading_max = find("heading_max");
  columns.radius_min = find("radius_min");
  columns.radius_max = find("radius_max");
  columns.kappa_min = find("kappa_min");
  columns.kappa_max = find("kappa_max");
  for (const string_view name : kToleranceNames) {
    if (!columns.tolerance) columns.tolerance = find(name);
  }
  if (!columns.our_samples) columns.unused = unused_names(names, columns);
  columns.radius_scale = scale_of(names, columns.radius, columns.unit_x);
  columns.radius_min_scale = scale_of(names, columns.radius_min, columns.unit_x);
  columns.radius_max_scale = scale_of(names, columns.radius_max, columns.unit_x);
  columns.kappa_scale = 1.0 / scale_of(names, columns.kappa, columns.unit_x);
  columns.kappa_min_scale = 1.0 / scale_of(names, columns.kappa_min, columns.unit_x);
  columns.kappa_max_scale = 1.0 / scale_of(names, columns.kappa_max, columns.unit_x);
  columns.tolerance_scale = scale_of(names, columns.tolerance, columns.unit_x);
  columns.z_scale = scale_of(names, columns.z, columns.unit_x);
  return columns;
}

}  // namespace obvid
