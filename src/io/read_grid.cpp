// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/internal/read_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "matrix_names.h"
#include "number_rows.h"
#include "obvid/core/files.h"
#include "text_number.h"

namespace obvid {
namespace {

using std::string_view;

Result<PointGrid> grid_of(const std::vector<std::vector<Vec3>>& rows, string_view name) {
  PointGrid grid;
  grid.name = std::string(name);
  grid.count_v = rows.size();
  grid.count_u = rows.empty() ? 0 : rows.front().size();
  for (std::size_t j = 0; j < rows.size(); ++j) {
    if (rows[j].size() != grid.count_u) {
      return error(ErrorCode::kBadCount, fmt::format("row {} has {} points where the first has {}",
                                                     j + 1, rows[j].size(), grid.count_u))
          .where(std::string(name))
          .hint("a grid needs rows of equal length")
          .point(j)
          .value(static_cast<double>(rows[j].size()));
    }
    grid.points.insert(grid.points.end(), rows[j].begin(), rows[j].end());
  }
  if (grid.count_u >= 2 && grid.count_v >= 2) return grid;
  return error(ErrorCode::kTooFewPoints,
               fmt::format("{} rows of {} points are no grid", grid.count_v, grid.count_u))
      .where(std::string(name))
      .hint("give at least 2 x 2 points; rows are separated by blank lines");
}

/// Half a unit of the last digits of three columns.
Vec3 half_units_of(const NumberRows& rows, const std::array<int, 3>& columns) {
  const std::vector<double> half = rows.rounding(columns);
  return {half[0], half[1], half[2]};
}

/// Of a matrix: the most of all its columns from this one on.
double matrix_rounding(const NumberRows& rows, std::size_t from = 0) {
  double most = 0.0;
  for (std::size_t k = from; k < rows.digits.size(); ++k) {
    most = std::max(most, rows.rounding(std::array{static_cast<int>(k)}).front());
  }
  return most;
}

Result<PointGrid> with_rounding(Result<PointGrid> grid, Vec3 rounding) {
  if (grid) grid->rounding = rounding;
  return grid;
}

// ---- three matrices ---------------------------------------------------------------------------

Result<NumberRows> matrix(const std::string& path) {
  const auto text = read_file(path);
  OBVID_TRY(text);
  auto rows = number_rows(*text, path);
  if (!rows) return rows;
  for (const NumberRow& row : rows->rows) {
    if (row.values.size() == rows->rows.front().values.size()) continue;
    return fail(error_at(ErrorCode::kBadCount,
                         fmt::format("this row has {} numbers, the first has {}", row.values.size(),
                                     rows->rows.front().values.size()),
                         path, row.line));
  }
  return rows;
}

Result<PointGrid> from_three(const MatrixName& name) {
  std::array<NumberRows, 3> all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string file = name.path(axis);
    auto rows = matrix(file);
    OBVID_TRY(rows);
    all[axis] = std::move(*rows);
    const bool same = all[axis].rows.size() == all[0].rows.size() &&
                      all[axis].rows.front().values.size() == all[0].rows.front().values.size();
    if (same) continue;
    return error(ErrorCode::kBadCount, "the matrix is not as large as that of x")
        .where(file)
        .hint("the three files hold one coordinate each of the same points");
  }
  std::vector<std::vector<Vec3>> points;
  for (std::size_t j = 0; j < all[0].rows.size(); ++j) {
    points.emplace_back();
    for (std::size_t i = 0; i < all[0].rows[j].values.size(); ++i) {
      points.back().push_back(
          {all[0].rows[j].values[i], all[1].rows[j].values[i], all[2].rows[j].values[i]});
    }
  }
  return with_rounding(grid_of(points, name.common_name()),
                       {matrix_rounding(all[0]), matrix_rounding(all[1]), matrix_rounding(all[2])});
}

// ---- one text ---------------------------------------------------------------------------------

Result<Vec3> point_of(const NumberRow& row, string_view name) {
  if (row.values.size() >= 3) return Vec3{row.values[0], row.values[1], row.values[2]};
  return fail(error_at(ErrorCode::kTooFewColumns,
                       fmt::format("{} numbers where x y z are needed", row.values.size()), name,
                       row.line));
}

Result<std::vector<Vec3>> points_of(const NumberRows& rows, std::size_t from, string_view name) {
  std::vector<Vec3> points;
  for (std::size_t i = from; i < rows.rows.size(); ++i) {
    const auto point = point_of(rows.rows[i], name);
    OBVID_TRY(point);
    points.push_back(*point);
  }
  return points;
}

std::vector<std::vector<Vec3>> cut(const std::vector<Vec3>& points, std::size_t length) {
  std::vector<std::vector<Vec3>> rows;
  for (std::size_t i = 0; i < points.size(); i += length) {
    const auto from = points.begin() + static_cast<std::ptrdiff_t>(i);
    rows.emplace_back(from,
                      from + static_cast<std::ptrdiff_t>(std::min(length, points.size() - i)));
  }
  return rows;
}

/// "40 30": counts of points in a row and of rows, before as many points.
bool led_by_counts(const NumberRows& rows) {
  const std::vector<double>& head = rows.rows.front().values;
  return head.size() == 2 && rows.rows.size() >= 2 && rows.rows[1].values.size() >= 3;
}

/// The counts must be whole, and as many points must follow.
Result<void> check_counts(const NumberRows& rows, string_view name) {
  const NumberRow& head = rows.rows.front();
  const double u = head.values[0], v = head.values[1];
  const auto size = static_cast<double>(rows.rows.size() - 1);
  const bool whole = u >= 1.0 && v >= 1.0 && u == std::floor(u) && v == std::floor(v);
  if (whole && u * v == size) return {};
  return fail(error_at(ErrorCode::kBadCount,
                       fmt::format("{:g} x {:g} points are announced, {:g} follow", u, v, size),
                       name, head.line,
                       "correct the counts (points in a row, rows) or leave out the line"));
}

bool has_gaps(const NumberRows& rows, std::size_t from) {
  for (std::size_t i = from + 1; i < rows.rows.size(); ++i) {
    if (rows.rows[i].after_gap) return true;
  }
  return false;
}

/// Length of scan lines: a coordinate that stays for the whole line, or one that comes again at the
/// same place of every line. 0 when there is neither.
std::size_t line_length(const std::vector<Vec3>& points) {
  const std::size_t n = points.size();
  for (const auto coordinate : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    std::size_t run = 1;
    while (run < n && points[run].*coordinate == points[0].*coordinate) ++run;
    if (run < 2 || run == n || n % run != 0) continue;
    bool good = true;
    for (std::size_t i = 0; i < n && good; ++i) {
      good = points[i].*coordinate == points[i - i % run].*coordinate;
    }
    if (good) return run;
  }
  for (const auto coordinate : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    std::size_t period = 1;
    while (period < n && points[period].*coordinate != points[0].*coordinate) ++period;
    if (period < 2 || period >= n || n % period != 0) continue;
    bool good = true;
    for (std::size_t i = period; i < n && good; ++i) {
      good = points[i].*coordinate == points[i - period].*coordinate;
    }
    if (good) return period;
  }
  return 0;
}

Result<PointGrid> from_list(const NumberRows& rows, string_view name) {
  const bool counts = led_by_counts(rows);
  const std::size_t from = counts ? 1 : 0;
  if (counts) {
    OBVID_TRY(check_counts(rows, name));
  }
  const auto points = points_of(rows, from, name);
  OBVID_TRY(points);
  if (counts) {
    return grid_of(cut(*points, static_cast<std::size_t>(rows.rows.front().values[0])), name);
  }
  if (has_gaps(rows, from)) {
    std::vector<std::vector<Vec3>> grid;
    for (std::size_t i = from; i < rows.rows.size(); ++i) {
      if (i == from || rows.rows[i].after_gap) grid.emplace_back();
      grid.back().push_back((*points)[i - from]);
    }
    return grid_of(grid, name);
  }
  const std::size_t length = line_length(*points);
  if (length == 0) {
    return error(ErrorCode::kBadCount, "rows of the grid cannot be told from each other")
        .where(std::string(name))
        .hint(
            "put a blank line between rows, or begin with a line of two counts: points in a "
            "row, rows; `surface scatter` takes points in no order")
        .value(static_cast<double>(points->size()));
  }
  return grid_of(cut(*points, length), name);
}

/// Columns row, col, x, y, z.
Result<PointGrid> from_places(const NumberRows& rows, string_view name) {
  std::array<std::size_t, 5> column{};
  constexpr std::array<string_view, 5> kNames = {"row", "col", "x", "y", "z"};
  std::size_t widest = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    const int at = column_named(rows, kNames[k]);
    if (at < 0) {
      return error(ErrorCode::kTooFewColumns, fmt::format("there is no column {}", kNames[k]))
          .where(std::string(name))
          .hint("the columns are row, col, x, y, z");
    }
    column[k] = static_cast<std::size_t>(at);
    widest = std::max(widest, column[k] + 1);
  }
  std::map<double, std::map<double, Vec3>> places;
  for (const NumberRow& row : rows.rows) {
    if (row.values.size() < widest) {
      return fail(
          error_at(ErrorCode::kTooFewColumns, "the row has too few columns", name, row.line));
    }
    const auto at = [&](std::size_t k) { return row.values[column[k]]; };
    const bool fresh = places[at(0)].emplace(at(1), Vec3{at(2), at(3), at(4)}).second;
    if (fresh) continue;
    return fail(
        error_at(ErrorCode::kBadCount, "this place of the grid is given twice", name, row.line));
  }
  std::vector<std::vector<Vec3>> grid;
  for (const auto& [index, line] : places) {
    const auto& first = places.begin()->second;
    const bool alike = std::equal(line.begin(), line.end(), first.begin(), first.end(),
                                  [](const auto& a, const auto& b) { return a.first == b.first; });
    if (!alike) {
      return error(ErrorCode::kBadCount,
                   fmt::format("row {:g} has not the same columns as row {:g}", index,
                               places.begin()->first))
          .where(std::string(name))
          .hint("every place of the grid needs a point")
          .value(index);
    }
    grid.emplace_back();
    for (const auto& [place, point] : line) grid.back().push_back(point);
  }
  return grid_of(grid, name);
}

Result<PointGrid> from_heights(const NumberRows& rows, string_view name, double spacing) {
  std::vector<std::vector<Vec3>> grid;
  for (const NumberRow& row : rows.rows) {
    const double y = spacing * static_cast<double>(grid.size());
    grid.emplace_back();
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      grid.back().push_back({spacing * static_cast<double>(i), y, row.values[i]});
    }
  }
  auto made = grid_of(grid, name);
  if (made) made->of_heights = true;
  return made;
}

/// Half-breadths: first row stations, first column waterlines. `corner` words stand in the header.
Result<PointGrid> from_offsets(const NumberRows& rows, string_view name) {
  std::vector<double> stations;
  for (std::size_t i = 1; i < rows.header.size(); ++i) {
    const text::ParsedNumber number = text::parse_number(rows.header[i], true);
    if (number.kind != text::NumberKind::kNumber) {
      return error(ErrorCode::kBadNumber,
                   fmt::format("station '{}' is not a number", rows.header[i]))
          .where(std::string(name))
          .hint("write its distance in place of its name");
    }
    if (!stations.empty() && !(number.value > stations.back())) {
      return error(ErrorCode::kBadNumber,
                   fmt::format("station {:g} does not lie behind station {:g}", number.value,
                               stations.back()))
          .where(std::string(name))
          .hint("the first row holds the stations in ascending order")
          .value(number.value);
    }
    stations.push_back(number.value);
  }
  std::vector<std::vector<Vec3>> grid;
  for (const NumberRow& row : rows.rows) {
    if (row.values.size() != stations.size() + 1) {
      return fail(error_at(
          ErrorCode::kBadCount,
          fmt::format("{} half-breadths for {} stations", row.values.size() - 1, stations.size()),
          name, row.line, "every station needs a number in every row"));
    }
    grid.emplace_back();
    for (std::size_t i = 0; i < stations.size(); ++i) {
      grid.back().push_back({stations[i], row.values[i + 1], row.values[0]});
    }
  }
  return grid_of(grid, name);
}

/// A header of one word and numbers: a table of half-breadths.
bool is_offset_table(const NumberRows& rows) {
  if (rows.header.size() < 3) return false;
  std::size_t numbers = 0;
  for (std::size_t i = 1; i < rows.header.size(); ++i) {
    numbers += text::parse_number(rows.header[i], true).kind == text::NumberKind::kNumber ? 1 : 0;
  }
  return numbers + 1 == rows.header.size();
}

bool is_matrix_text(string_view text, string_view name) {
  const auto rows = number_rows(text, name);
  return rows && is_matrix(*rows);
}

std::optional<MatrixName> matrix_name(const std::string& path) {
  const auto name = matrix_with_siblings(path);
  return name ? name : matrix_by_ending(path);
}

Error not_one_grid(const std::string& path) {
  return error(ErrorCode::kUsage,
               "a grid is one file, or three whose names differ in one letter: _x, _y, _z")
      .where(path)
      .hint("name them like hull_x.dat, hull_y.dat, hull_z.dat");
}

/// Three files that are given, in any order.
Result<PointGrid> from_three_names(const std::vector<std::string>& paths) {
  const auto first = matrix_name(paths.front());
  if (!first) return fail(not_one_grid(paths.front()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string wanted = first->path(axis);
    if (std::find(paths.begin(), paths.end(), wanted) != paths.end()) continue;
    return error(ErrorCode::kUsage, "the three files do not belong together")
        .where(paths.front())
        .hint(fmt::format("{} is not among them", wanted));
  }
  return from_three(*first);
}

Result<PointGrid> grid_in(const NumberRows& rows, string_view name, const GridOptions& options) {
  if (column_named(rows, "row") >= 0 && column_named(rows, "col") >= 0) {
    return with_rounding(from_places(rows, name),
                         half_units_of(rows, {column_named(rows, "x"), column_named(rows, "y"),
                                              column_named(rows, "z")}));
  }
  if (is_offset_table(rows)) {
    return with_rounding(from_offsets(rows, name),
                         {0.0, matrix_rounding(rows, 1), rows.rounding(std::array{0}).front()});
  }
  if (is_matrix(rows)) {
    return with_rounding(from_heights(rows, name, options.spacing),
                         {0.0, 0.0, matrix_rounding(rows)});
  }
  return with_rounding(from_list(rows, name), half_units_of(rows, {0, 1, 2}));
}

}  // namespace

Result<PointGrid> parse_grid(string_view text, string_view name, const GridOptions& options) {
  const auto rows = number_rows(text, name);
  OBVID_TRY(rows);
  const auto units = units_of_columns(*rows, name);
  OBVID_TRY(units);
  auto grid = grid_in(*rows, name, options);
  if (grid) grid->units = *units;
  return grid;
}

Result<PointGrid> read_grid(const std::vector<std::string>& paths, const GridOptions& options) {
  if (paths.empty()) return error(ErrorCode::kUsage, "no file with a grid");
  if (paths.size() == 3) return from_three_names(paths);
  if (paths.size() > 1) return fail(not_one_grid(paths[1]));
  if (const auto name = matrix_with_siblings(paths.front())) return from_three(*name);
  const auto text = read_file(paths.front());
  OBVID_TRY(text);
  auto grid = parse_grid(*text, paths.front(), options);
  const auto lonely = lonely_matrix(paths.front());
  if (grid && lonely && is_matrix_text(*text, paths.front())) {
    return error(ErrorCode::kBadCount,
                 fmt::format("the name says that these are the coordinates {} of a grid",
                             "xyz"[lonely->axis]))
        .where(paths.front())
        .hint(fmt::format("put {} beside it, or give a matrix of heights another name",
                          lonely->path(lonely->axis == 0 ? 1 : 0)));
  }
  if (grid) grid->name = std::filesystem::path(paths.front()).stem().string();
  return grid;
}

}  // namespace obvid
