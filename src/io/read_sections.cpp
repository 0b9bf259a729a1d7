// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/read_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "matrix_names.h"
#include "number_rows.h"
#include "obvid/core/files.h"
#include "obvid/io/internal/read_grid.h"
#include "obvid/io/read_points.h"
#include "offset_table.h"
#include "read_blade_table.h"
#include "read_streamsurfaces.h"

namespace obvid {
namespace {

using std::string_view;

/// Title that stands before a row, or a running number.
std::string section_title(const NumberRows& rows, std::size_t row, std::size_t number) {
  const auto title = std::lower_bound(
      rows.titles.begin(), rows.titles.end(), row,
      [](const NumberRows::Title& one, std::size_t place) { return one.row < place; });
  if (row > 0 && title != rows.titles.end() && title->row == row) return title->text;
  return fmt::format("section {}", number);
}

/// Z R THETA 1 THETA 2: both sides of a blade from edge to edge, on surfaces of revolution.
bool is_rotor(const NumberRows& rows) {
  return std::any_of(rows.titles.begin(), rows.titles.end(), [](const NumberRows::Title& title) {
    return title.text.find("THETA 1") != std::string::npos;
  });
}

Vec3 cylindrical(double z, double r, double theta) {
  return {z, r * std::sin(theta), r * std::cos(theta)};
}

/// Whether both sides begin in one point, apart from the rounding of the angles.
bool starts_at_one_edge(const std::vector<const NumberRow*>& block) {
  constexpr double kPart = 0.01;  // of the first step
  const auto& v = block.front()->values;
  const Vec3 a = cylindrical(v[1], v[2], v[3]), b = cylindrical(v[1], v[2], v[4]);
  if (block.size() < 2) return a == b;
  const auto& w = block[1]->values;
  return norm(a - b) <= kPart * norm(cylindrical(w[1], w[2], w[3]) - a);
}

/// Of places given by z, radius and angle.
Vec3 cylindrical_rounding(const NumberRows& rows) {
  const std::vector<double> half = rows.rounding(std::array{1, 2, 3, 4});
  double radius = 0.0;
  for (const NumberRow& row : rows.rows) radius = std::max(radius, std::abs(row.values[2]));
  const double across = half[1] + radius * std::max(half[2], half[3]);
  return {half[0], across, across};
}

Result<ParsedSections> rotor_sections(const NumberRows& rows, string_view name) {
  std::vector<std::vector<const NumberRow*>> blocks;
  for (const NumberRow& row : rows.rows) {
    constexpr std::size_t kRotorColumns = 5;
    if (row.values.size() != kRotorColumns) {
      return fail(error_at(ErrorCode::kTooFewColumns, "J Z R THETA 1 THETA 2 are expected", name,
                           row.line));
    }
    if (blocks.empty() || row.after_gap || row.values[0] == 1.0) blocks.emplace_back();
    blocks.back().push_back(&row);
  }
  ParsedSections out;
  for (const auto& block : blocks) {
    SpaceSeries section{fmt::format("surface {}", out.sections.size() + 1), {}};
    // one side from the last point to the first, the other one back
    for (auto row = block.rbegin(); row != block.rend(); ++row) {
      const auto& v = (*row)->values;
      section.points.push_back(cylindrical(v[1], v[2], v[3]));
    }
    for (auto row = block.begin(); row != block.end(); ++row) {
      const auto& v = (*row)->values;
      if (row == block.begin() && starts_at_one_edge(block)) continue;
      section.points.push_back(cylindrical(v[1], v[2], v[4]));
    }
    section.rounding = cylindrical_rounding(rows);
    out.sections.push_back(std::move(section));
  }
  return out;
}

/// Index of the columns x, y, z: as named, else the first ones. z < 0: there is none.
struct Columns {
  int x = 0, y = 1, z = 2, section = -1;
};

Result<Columns> columns_of(const NumberRows& rows, string_view name) {
  Columns columns;
  columns.section = column_named(rows, "section");
  const int x = column_named(rows, "x"), y = column_named(rows, "y"), z = column_named(rows, "z");
  if (x >= 0 && y >= 0) {
    const std::size_t understood = 2 + (z >= 0 ? 1 : 0) + (columns.section >= 0 ? 1 : 0);
    if (z < 0 && rows.columns.size() > understood) {
      return error(ErrorCode::kTooFewColumns, "columns x and y are there, but none is called z")
          .where(std::string(name))
          .hint("call the third coordinate z, or take the column out");
    }
    return Columns{x, y, z, columns.section};
  }
  if (columns.section == 0) columns = {1, 2, 3, 0};
  if (rows.rows.front().values.size() <= static_cast<std::size_t>(columns.z)) columns.z = -1;
  return columns;
}

Result<ParsedSections> from_rows(const NumberRows& rows, string_view name) {
  const auto found = columns_of(rows, name);
  OBVID_TRY(found);
  const Columns columns = *found;
  const auto widest =
      static_cast<std::size_t>(std::max({columns.x, columns.y, columns.z, columns.section}) + 1);
  const auto units = units_of_columns(rows, name);
  OBVID_TRY(units);
  ParsedSections out;
  out.flat = columns.z < 0;
  const std::vector<double> half = rows.rounding(std::array{columns.x, columns.y, columns.z});
  double before = 0.0;
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const NumberRow& row = rows.rows[i];
    if (row.values.size() < widest) {
      return fail(error_at(ErrorCode::kTooFewColumns,
                           fmt::format("{} numbers where {} are needed", row.values.size(), widest),
                           name, row.line));
    }
    const auto at = [&](int k) { return row.values[static_cast<std::size_t>(k)]; };
    const bool fresh =
        columns.section >= 0 ? i == 0 || at(columns.section) != before : i == 0 || row.after_gap;
    if (columns.section >= 0) before = at(columns.section);
    if (fresh) {
      const std::size_t number = out.sections.size() + 1;
      const std::string title = columns.section >= 0 ? fmt::format("section {:g}", before)
                                                     : section_title(rows, i, number);
      out.sections.push_back({title, {}, {}, *units, {half[0], half[1], half[2]}});
    }
    out.sections.back().points.push_back(
        {at(columns.x), at(columns.y), out.flat ? 0.0 : at(columns.z)});
  }
  return out;
}

/// One section in any form of `read_points`.
Result<ParsedSections> flat_section(string_view text, string_view name) {
  const auto series = parse_points(text, name);
  OBVID_TRY(series);
  SpaceSeries section{series->name, {}};
  section.units = series->units;
  for (const Vec2 p : series->points) section.points.push_back({p.x, p.y, 0.0});
  section.rounding = {series->rounding.x, series->rounding.y, 0.0};
  return ParsedSections{{std::move(section)}, true};
}

/// A list of points with two columns and no blank lines inside: what `read_points` is for.
bool is_plain_list(const Result<NumberRows>& rows) {
  if (!rows) return true;
  if (column_named(*rows, "section") >= 0) return false;
  const bool two = std::all_of(rows->rows.begin(), rows->rows.end(),
                               [](const NumberRow& row) { return row.values.size() == 2; });
  const bool parted = std::any_of(rows->rows.begin() + 1, rows->rows.end(),
                                  [](const NumberRow& row) { return row.after_gap; });
  return two && !parted;
}

void lift(std::vector<SpaceSeries>& sections, double spacing) {
  for (std::size_t k = 0; k < sections.size(); ++k) {
    for (Vec3& p : sections[k].points) p.z = spacing * static_cast<double>(k);
  }
}

std::vector<SpaceSeries> rows_of(const PointGrid& grid) {
  std::vector<SpaceSeries> sections;
  for (std::size_t j = 0; j < grid.count_v; ++j) {
    const auto from = grid.points.begin() + static_cast<std::ptrdiff_t>(j * grid.count_u);
    sections.push_back({fmt::format("row {}", j + 1),
                        {from, from + static_cast<std::ptrdiff_t>(grid.count_u)},
                        {},
                        grid.units,
                        grid.rounding});
  }
  return sections;
}

/// Goes on with the rows of the next panel, which begin where these end: at a corner.
Result<void> join(std::vector<SpaceSeries>& sections, const PointGrid& panel,
                  const std::string& name) {
  constexpr double kMeeting = 1e-6;  // of the size: what is left of printed coordinates
  if (panel.count_v != sections.size()) {
    return error(ErrorCode::kBadCount, fmt::format("the panel has {} rows, the ones before have {}",
                                                   panel.count_v, sections.size()))
        .where(name)
        .hint("panels of one body need the same stations");
  }
  double size = 0.0;
  for (const Vec3& p : panel.points) size = std::max(size, norm(p - panel.points.front()));
  std::vector<SpaceSeries> rows = rows_of(panel);
  for (std::size_t j = 0; j < rows.size(); ++j) {
    std::vector<Vec3>& line = sections[j].points;
    const double gap = norm(rows[j].points.front() - line.back());
    if (gap > kMeeting * size) {
      return error(ErrorCode::kBadCount,
                   fmt::format("row {} begins {:.3g} from where the panel before ends", j + 1, gap))
          .where(name)
          .hint("give panels in order, each beginning where the one before ends")
          .point(j)
          .value(gap);
    }
    sections[j].corners.push_back(line.size() - 1);
    Vec3& known = sections[j].rounding;  // of all panels
    known = {std::max(known.x, panel.rounding.x), std::max(known.y, panel.rounding.y),
             std::max(known.z, panel.rounding.z)};
    line.insert(line.end(), rows[j].points.begin() + 1, rows[j].points.end());
  }
  return {};
}

/// Rows of one grid, or of panels that meet at corners, each in three files.
Result<std::vector<SpaceSeries>> rows_of_grids(const std::vector<std::string>& paths) {
  std::vector<SpaceSeries> sections;
  std::vector<MatrixName> seen;
  for (const std::string& path : paths) {
    const auto name = matrix_with_siblings(path);
    const auto known = std::find_if(seen.begin(), seen.end(), [&](const MatrixName& other) {
      return name && other.same_grid(*name);
    });
    if (!name || known != seen.end()) continue;
    seen.push_back(*name);
    const auto grid = read_grid({path});
    OBVID_TRY(grid);
    if (seen.size() == 1) {
      sections = rows_of(*grid);
    } else
      OBVID_TRY(join(sections, *grid, path));
  }
  return sections;
}

/// Refuses matrices whose rows would be taken for points x y z and more: a row is longer than any
/// point with its normal, or three files at least have matrices of one shape.
Result<void> check_no_matrices(const std::vector<std::string>& paths) {
  constexpr std::size_t kPointAndNormal = 6, kCoordinates = 3;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> shapes;
  for (const std::string& path : paths) {
    if (path == "-") return {};  // standard input is read once
    const auto text = read_file(path);
    if (!text || is_blade_table(*text) || is_airfoil_of_blade(*text)) continue;
    if (is_offset_text(*text) || is_on_streamsurfaces(*text)) continue;
    const auto rows = number_rows(*text, path);
    const bool named = rows && column_named(*rows, "x") >= 0;
    if (!rows || named || is_rotor(*rows) || !is_matrix(*rows)) continue;
    const std::size_t width = rows->rows.front().values.size(), height = rows->rows.size();
    const std::size_t alike = ++shapes[{height, width}];
    if (width <= kPointAndNormal && alike < kCoordinates) continue;
    return error(ErrorCode::kBadCount,
                 fmt::format("{} rows of {} numbers are a matrix, not points of sections", height,
                             width))
        .where(path)
        .hint(
            "three matrices of coordinates need names that differ in one letter, as in "
            "hull_x.dat, hull_y.dat, hull_z.dat")
        .value(static_cast<double>(width));
  }
  return {};
}

/// Files of one airfoil each and the table that places them.
Result<std::vector<SpaceSeries>> blade_sections(const std::string& table_path,
                                                const std::string& table_text,
                                                const std::vector<std::string>& airfoils) {
  const auto table = parse_blade_table(table_text, table_path);
  OBVID_TRY(table);
  std::vector<SpaceSeries> sections;
  std::size_t used = 0;
  for (const BladeStation& station : *table)
    used = std::max(used, static_cast<std::size_t>(std::max(station.airfoil, 0)));
  if (used < airfoils.size()) {
    return error(ErrorCode::kBadCount,
                 fmt::format("{} airfoil files were given, the table asks for {}", airfoils.size(),
                             used))
        .where(table_path)
        .hint("give exactly the files of the table, in the order of their numbers")
        .value(static_cast<double>(airfoils.size()));
  }
  for (const BladeStation& station : *table) {
    if (station.airfoil < 1 || static_cast<std::size_t>(station.airfoil) > airfoils.size()) {
      return error(ErrorCode::kBadCount,
                   fmt::format("station {} asks for airfoil {}, {} files were given",
                               sections.size() + 1, station.airfoil, airfoils.size()))
          .where(table_path)
          .hint("give all airfoil files in the order of their numbers")
          .value(static_cast<double>(station.airfoil));
    }
    const std::string& path = airfoils[static_cast<std::size_t>(station.airfoil) - 1];
    const auto text = read_file(path);
    OBVID_TRY(text);
    const auto airfoil = parse_airfoil_of_blade(*text, path);
    OBVID_TRY(airfoil);
    sections.push_back(
        placed(*airfoil, station, fmt::format("{} at {:.4g}", file_name(path), station.span)));
  }
  return sections;
}

}  // namespace

Result<ParsedSections> parse_sections(string_view text, string_view name,
                                      const SectionOptions& options, const RunContext& run) {
  Result<ParsedSections> out;
  if (is_airfoil_of_blade(text)) {
    const auto airfoil = parse_airfoil_of_blade(text, name);
    OBVID_TRY(airfoil);
    SpaceSeries section{std::string(name), {}};
    for (const Vec2 p : airfoil->points) section.points.push_back({p.x, p.y, 0.0});
    section.rounding = {airfoil->rounding.x, airfoil->rounding.y, 0.0};
    out = ParsedSections{{std::move(section)}, true};
  } else if (is_on_streamsurfaces(text)) {
    auto sections = parse_streamsurfaces(text, name, run);
    OBVID_TRY(sections);
    return ParsedSections{std::move(*sections)};
  } else if (is_offset_text(text)) {
    auto table = parse_offset_table(text, name);
    OBVID_TRY(table);
    return ParsedSections{std::move(table->sections), false, std::move(table->assumed)};
  } else {
    const auto rows = number_rows(text, name);
    if (is_plain_list(rows)) {
      out = flat_section(text, name);
    } else {
      out = is_rotor(*rows) ? rotor_sections(*rows, name) : from_rows(*rows, name);
    }
  }
  if (out && out->flat) lift(out->sections, options.spacing);
  return out;
}

Result<std::vector<SpaceSeries>> read_sections(const std::vector<std::string>& paths,
                                               const SectionOptions& options,
                                               std::vector<std::string>* assumed,
                                               const RunContext& run) {
  if (paths.empty()) return error(ErrorCode::kUsage, "no files with sections");
  const bool matrices = std::all_of(paths.begin(), paths.end(), [](const std::string& path) {
    return matrix_with_siblings(path).has_value();
  });
  if (matrices) return rows_of_grids(paths);
  OBVID_TRY(check_no_matrices(paths));
  std::vector<SpaceSeries> sections;
  std::string flat_file, spatial_file;
  for (const std::string& path : paths) {
    OBVID_TRY(may_go_on(run));
    const auto text = read_file(path);
    OBVID_TRY(text);
    if (is_blade_table(*text)) {
      std::vector<std::string> airfoils;
      std::copy_if(paths.begin(), paths.end(), std::back_inserter(airfoils),
                   [&](const std::string& other) { return other != path; });
      return blade_sections(path, *text, airfoils);
    }
    auto parsed = parse_sections(*text, path, options, run);
    OBVID_TRY(parsed);
    (parsed->flat ? flat_file : spatial_file) = path;
    for (const std::string& what : parsed->assumed) {
      if (assumed != nullptr) assumed->push_back(path + ": " + what);
    }
    if (paths.size() > 1 && parsed->sections.size() == 1)
      parsed->sections.front().name = file_name(path);
    std::move(parsed->sections.begin(), parsed->sections.end(), std::back_inserter(sections));
  }
  if (!flat_file.empty() && !spatial_file.empty()) {
    return error(ErrorCode::kTooFewColumns, "this file has no z, others have")
        .where(flat_file)
        .hint("give all sections a z, or none of them");
  }
  if (spatial_file.empty()) lift(sections, options.spacing);
  return sections;
}

}  // namespace obvid
