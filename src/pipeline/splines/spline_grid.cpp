// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/spline_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "obvid/io/internal/json_list.h"

namespace obvid {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

std::vector<double> each_once(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t node_of(const std::vector<double>& nodes, double value) {
  return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), value) -
                                  nodes.begin());
}

Result<std::vector<double>> column_of(const ColumnTable& table, std::size_t column,
                                      const std::string& name) {
  std::vector<double> out;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (column >= table.rows[i].size()) {
      return error(ErrorCode::kTooFewColumns, "a row is too short")
          .where(fmt::format("{}:{}", name, table.lines[i]))
          .hint("every row needs all columns; where no cell begins any number may stand")
          .point(i);
    }
    out.push_back(table.rows[i][column]);
  }
  return out;
}

Error grid_error(ErrorCode code, std::string what, const std::string& name, std::string hint) {
  return {code, std::move(what), name, std::move(hint), -1, 0.0};
}

/// Picks the integrals of cells out of a column that has one entry per place.
std::vector<double> without_last(const std::vector<double>& at_places, std::size_t nx,
                                 std::size_t ny, bool last_x, bool last_y) {
  std::vector<double> out;
  for (std::size_t j = 0; j + (last_y ? 1 : 0) < ny; ++j) {
    for (std::size_t i = 0; i + (last_x ? 1 : 0) < nx; ++i) out.push_back(at_places[j * nx + i]);
  }
  return out;
}

/// Places between two questions whether to go on.
constexpr std::size_t kPlacesAtOnce = 1024;

Result<GridSplineRow> row_of_grid(const IdSpline2d& spline, const GridSplineInput& input,
                                  std::string name, const std::optional<GridPlaces>& finer,
                                  const RunContext& run) {
  GridSplineRow row;
  row.name = std::move(name);
  const std::size_t nx = spline.x.size(), ny = spline.y.size();
  for (std::size_t k = 0; k < nx * ny; ++k) {
    row.largest_move =
        std::max(row.largest_move, std::abs(spline.values[k] - input.data.values[k]));
  }
  row.integral =
      integral(spline, spline.x.front(), spline.x.back(), spline.y.front(), spline.y.back());
  row.integral_error = input.cells_given ? 0.0 : kNotKnown;
  for (std::size_t j = 0; input.cells_given && j + 1 < ny; ++j) {
    OBVID_TRY(may_go_on(run));
    for (std::size_t i = 0; i + 1 < nx; ++i) {
      const double here =
          integral(spline, spline.x[i], spline.x[i + 1], spline.y[j], spline.y[j + 1]);
      row.integral_error =
          std::max(row.integral_error, std::abs(here - input.data.cells[j * (nx - 1) + i]));
    }
  }
  if (!finer) {
    row.largest_error = row.largest_x = row.largest_y = row.rms_error = kNotKnown;
    return row;
  }
  double squares = 0.0;
  for (std::size_t k = 0; k < finer->x.size(); ++k) {
    if (k % kPlacesAtOnce == 0) OBVID_TRY(may_go_on(run));
    const double error = std::abs(evaluate(spline, finer->x[k], finer->y[k]).value - finer->f[k]);
    squares += error * error;
    if (error < row.largest_error) continue;
    row.largest_error = error;
    row.largest_x = finer->x[k];
    row.largest_y = finer->y[k];
  }
  row.rms_error = std::sqrt(squares / static_cast<double>(finer->x.size()));
  return row;
}

/// What is not given is taken from values.
Result<IdSpline2dData> completed(const GridSplineInput& input) {
  IdSpline2dData data = input.data;
  if (input.lines_given == input.cells_given) return data;
  auto plain = id_spline_2d({data.x, data.y, data.values, {}, {}, {}});
  OBVID_TRY(plain);
  if (!input.lines_given) {
    data.along_x = std::move(plain->along_x);
    data.along_y = std::move(plain->along_y);
  }
  if (!input.cells_given) data.cells = std::move(plain->cells);
  return data;
}

}  // namespace

bool is_grid_table(const ColumnTable& table) {
  return table.column({"x"}) && table.column({"y"}) && table.column({"f", "value"});
}

Result<GridPlaces> grid_places(const ColumnTable& table, const std::string& name) {
  if (!is_grid_table(table)) {
    return fail(grid_error(ErrorCode::kUsage, "columns are missing", name, "x, y and f"));
  }
  GridPlaces out;
  const std::array<std::pair<std::size_t, std::vector<double>*>, 3> wanted = {{
      {*table.column({"x"}), &out.x},
      {*table.column({"y"}), &out.y},
      {*table.column({"f", "value"}), &out.f},
  }};
  for (const auto& [column, to] : wanted) {
    auto values = column_of(table, column, name);
    OBVID_TRY(values);
    *to = std::move(*values);
  }
  return out;
}

Result<GridSplineInput> grid_spline_input(const ColumnTable& table, const std::string& name) {
  const auto places = grid_places(table, name);
  OBVID_TRY(places);
  GridSplineInput out;
  out.name = name;
  IdSpline2dData& data = out.data;
  data.x = each_once(places->x);
  data.y = each_once(places->y);
  const std::size_t nx = data.x.size(), ny = data.y.size(), count = places->f.size();
  if (nx < 2 || ny < 2) {
    return fail(grid_error(ErrorCode::kTooFewPoints, "a grid has two places in each direction",
                           name, "columns x and f alone are a function of one variable"));
  }
  std::vector<std::size_t> row(nx * ny, count);
  for (std::size_t k = 0; k < count; ++k) {
    row[node_of(data.y, places->y[k]) * nx + node_of(data.x, places->x[k])] = k;
  }
  if (count != nx * ny || std::find(row.begin(), row.end(), count) != row.end()) {
    return fail(
        grid_error(ErrorCode::kBadCount,
                   fmt::format("{} values of x by {} of y are {} places, the table has {} rows", nx,
                               ny, nx * ny, count),
                   name, "give every place of the grid once"));
  }
  const auto sorted = [&](const std::vector<double>& values) {
    std::vector<double> in_order;
    for (const std::size_t k : row) in_order.push_back(values[k]);
    return in_order;
  };
  data.values = sorted(places->f);
  const auto along_x = table.column({"integral_x"}), along_y = table.column({"integral_y"}),
             cells = table.column({"integral"});
  if (along_x.has_value() != along_y.has_value()) {
    return fail(grid_error(ErrorCode::kUsage, "integrals along one direction only", name,
                           "give both integral_x and integral_y, or neither"));
  }
  const auto take = [&](const std::optional<std::size_t>& column, bool last_x, bool last_y,
                        std::vector<double>& to) -> Result<void> {
    if (!column) return {};
    const auto values = column_of(table, *column, name);
    OBVID_TRY(values);
    to = without_last(sorted(*values), nx, ny, last_x, last_y);
    return {};
  };
  OBVID_TRY(take(along_x, true, false, data.along_x));
  OBVID_TRY(take(along_y, false, true, data.along_y));
  OBVID_TRY(take(cells, true, true, data.cells));
  out.lines_given = along_x.has_value();
  out.cells_given = cells.has_value();
  return out;
}

Result<GridSplineReport> grid_spline_report(GridSplineInput input, bool smooth,
                                            const std::optional<GridPlaces>& finer,
                                            const RunContext& run) {
  const auto data = completed(input);
  OBVID_TRY(data);
  GridSplineReport out;
  for (const bool kind : {smooth, !smooth}) {
    OBVID_TRY(tell(run, "spline", kind == smooth ? 0.0 : 0.5));
    auto spline = id_spline_2d(*data, kind);
    OBVID_TRY(spline);
    auto row = row_of_grid(*spline, input, kind ? "C1, values free" : "values kept", finer, run);
    OBVID_TRY(row);
    out.rows.push_back(std::move(*row));
    if (kind == smooth) out.spline = std::move(*spline);
  }
  out.input = std::move(input);
  return out;
}

Result<SurfaceModel> graph_of(const GridSplineReport& report) {
  const IdSpline2d& f = report.spline;
  IdSpline2dData x{f.x, f.y, {}, {}, {}, {}}, y = x;
  for (const double v : f.y) {
    for (const double u : f.x) {
      x.values.push_back(u);
      y.values.push_back(v);
    }
  }
  auto made_x = id_spline_2d(std::move(x)), made_y = id_spline_2d(std::move(y));
  OBVID_TRY(made_x);
  OBVID_TRY(made_y);
  const auto form = to_nurbs(IdSurface{std::move(*made_x), std::move(*made_y), f}, 1.0);
  OBVID_TRY(form);
  SurfaceModel model;
  model.patches.push_back({"graph", form->surface});
  return model;
}

std::string grid_spline_csv(const GridSplineReport& report, std::size_t count) {
  const IdSpline2d& f = report.spline;
  std::string out = "x,y,f,f_x,f_y\n";
  const auto at = [&](const std::vector<double>& nodes, std::size_t k) {
    const double t = static_cast<double>(k) / static_cast<double>(count - 1);
    return k + 1 == count ? nodes.back() : nodes.front() + t * (nodes.back() - nodes.front());
  };
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = 0; i < count; ++i) {
      const double x = at(f.x, i), y = at(f.y, j);
      const GridJet jet = evaluate(f, x, y);
      out += fmt::format("{},{},{},{},{}\n", x, y, jet.value, jet.dx, jet.dy);
    }
  }
  return out;
}

std::string grid_spline_json(const GridSplineReport& report) {
  JsonText json;
  json.begin_object().pair("format", "obvid-spline").pair("version", 1);
  json.pair("name", report.input.name).pair("dimensions", 1).pair("variables", 2);
  json.key("rows").begin_array();
  for (const GridSplineRow& row : report.rows) {
    json.begin_object().pair("spline", row.name).pair("largest_error", row.largest_error);
    json.pair("largest_x", row.largest_x).pair("largest_y", row.largest_y);
    json.pair("rms_error", row.rms_error).pair("largest_move", row.largest_move);
    json.pair("integral", row.integral).pair("integral_error", row.integral_error).end_object();
  }
  json.end_array();
  const IdSpline2d& f = report.spline;
  add_list(json, "x", f.x);
  add_list(json, "y", f.y);
  add_list(json, "values", f.values);
  add_list(json, "integrals_x", f.along_x);
  add_list(json, "integrals_y", f.along_y);
  add_list(json, "integrals", f.cells).end_object();
  return json.take();
}

}  // namespace obvid
