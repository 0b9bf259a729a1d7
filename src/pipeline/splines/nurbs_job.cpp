// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/nurbs_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/cad/internal/cad.h"
#include "obvid/exchange/internal/dxf/space.h"
#include "obvid/io/internal/json_list.h"
#include "obvid/numeric/internal/golden.h"
#include "obvid/pipeline/file_formats.h"

namespace obvid {
namespace {

constexpr double kGreatestFoundTo = 1e-16;  // of the support: to rounding

Error nurbs_error(ErrorCode code, std::string what, std::string where, std::string hint,
                  double value = 0.0) {
  return {code, std::move(what), std::move(where), std::move(hint), -1, value};
}

std::vector<double> uniform_knots(std::size_t points, int degree) {
  std::vector<double> out(static_cast<std::size_t>(degree) + 1, 0.0);
  const std::size_t spans = points - static_cast<std::size_t>(degree);
  for (std::size_t k = 1; k < spans; ++k) out.push_back(static_cast<double>(k));
  out.insert(out.end(), static_cast<std::size_t>(degree) + 1, static_cast<double>(spans));
  return out;
}

/// The degree that so many points allow.
int degree_for(std::size_t points, int wanted) {
  return std::min(wanted, static_cast<int>(std::min<std::size_t>(points, 1000)) - 1);
}

Result<std::vector<double>> knots_for(std::size_t points, int degree,
                                      const std::vector<double>& given, const char* option) {
  if (given.empty()) return uniform_knots(points, degree);
  const std::size_t needed = points + static_cast<std::size_t>(degree) + 1;
  if (given.size() == needed) return given;
  return fail(nurbs_error(ErrorCode::kBadOption,
                          fmt::format("{} knots were given, {} points of degree {} need {}",
                                      given.size(), points, degree, needed),
                          option, "clamped: the first and the last stand degree + 1 times",
                          static_cast<double>(given.size())));
}

/// The curve by the weight of one of its points.
class WeightOfPoint {
 public:
  WeightOfPoint(const SpaceCurve& curve, std::size_t point) : curve_(curve), point_(point) {
    // basis functions and sums of them are polynomial curves of the same knots
    own_ = {curve.degree, curve.knots, std::vector<Vec3>(curve.points.size()), {}};
    rest_ = others_ = own_;
    own_.points[point].x = 1.0;
    for (std::size_t j = 0; j < curve.points.size(); ++j) {
      if (j == point) continue;
      rest_.points[j].x = curve.weights[j];
      others_.points[j] = curve.weights[j] * curve.points[j];
    }
    find_greatest();
  }

  /// Whether the curve runs through the point whatever its weight: all knots inside the support of
  /// its basis function are one, as at the ends and everywhere in degree 1.
  [[nodiscard]] bool passes() const { return passes_; }
  /// Part of the way from B to the point that a weight leads to.
  [[nodiscard]] double part(double weight) const {
    const double pull = weight * basis();
    return pull / (rest() + pull);
  }
  /// The weight that leads so far.
  [[nodiscard]] double weight(double part) const { return part / (1.0 - part) * rest() / basis(); }

  [[nodiscard]] WeightRow row() const {
    WeightRow out;
    out.point = point_;
    out.weight = curve_.weights[point_];
    out.u = u_;
    const Vec3 p = curve_.points[point_];
    out.without = passes_ ? p : evaluate(others_, u_).point / rest();
    out.a = part(1.0);
    out.b = part(out.weight);
    out.even = (1.0 - out.a) * out.without + out.a * p;
    out.now = evaluate(curve_, u_).point;
    out.swing = norm(p - out.without);
    return out;
  }

 private:
  [[nodiscard]] double basis() const { return passes_ ? 1.0 : evaluate(own_, u_).point.x; }
  [[nodiscard]] double rest() const { return passes_ ? 0.0 : evaluate(rest_, u_).point.x; }

  void find_greatest() {
    const auto d = static_cast<std::size_t>(curve_.degree);
    passes_ = curve_.knots[point_ + 1] == curve_.knots[point_ + d];
    if (passes_) {
      u_ = curve_.knots[point_ + 1];
      return;
    }
    const double low = curve_.knots[point_], high = curve_.knots[point_ + d + 1];
    const auto height = [&](double u) { return evaluate(own_, u).point.x; };
    u_ = highest_place(low, high, height, kGreatestFoundTo * (high - low));
  }

  const SpaceCurve& curve_;
  std::size_t point_;
  SpaceCurve own_, rest_, others_;
  double u_ = 0.0;
  bool passes_ = false;
};

Result<void> take_weights(const NurbsJob& job, SpaceCurve& curve) {
  const auto known = [&](std::size_t point, const char* option) -> Result<void> {
    if (point < curve.points.size()) return {};
    return fail(nurbs_error(
        ErrorCode::kBadOption,
        fmt::format("there are {} control points, no point {}", curve.points.size(), point + 1),
        option, "points count from 1"));
  };
  for (const auto& [point, weight] : job.weights) {
    OBVID_TRY(known(point, "--weight-at"));
    curve.weights[point] = weight;
  }
  OBVID_TRY(check(curve));
  for (const auto& [point, part] : job.moves) {
    OBVID_TRY(known(point, "--move"));
    const WeightOfPoint weight(curve, point);
    if (weight.passes()) {
      return fail(nurbs_error(
          ErrorCode::kBadOption,
          fmt::format("the curve runs through control point {} whatever its weight", point + 1),
          "--move", "a higher degree, or knots that differ there, leave it free", part));
    }
    if (!(part > 0.0 && part < 1.0)) {
      return fail(nurbs_error(ErrorCode::kBadOption,
                              "a weight leads between 0 and 1 of the way from B to a point",
                              "--move", "3=0.7 leads 0.7 of the way to point 3", part));
    }
    curve.weights[point] = weight.weight(part);
  }
  return check(curve);
}

Result<NurbsReport> surface_report(NurbsReport out, const NurbsJob& job) {
  if (!job.weights.empty() || !job.moves.empty()) {
    return fail(nurbs_error(ErrorCode::kBadOption, "weights of a net stand in its column w",
                            job.weights.empty() ? "--move" : "--weight-at", ""));
  }
  const std::size_t across = out.table.rows, along = out.table.points.size() / across;
  NurbsSurface surface;
  surface.degree_u = degree_for(along, job.degree);
  surface.degree_v = degree_for(across, job.degree_v);
  auto u = knots_for(along, surface.degree_u, job.knots, "--knots");
  OBVID_TRY(u);
  auto v = knots_for(across, surface.degree_v, job.knots_v, "--knots-v");
  OBVID_TRY(v);
  surface.knots_u = std::move(*u);
  surface.knots_v = std::move(*v);
  surface.points = out.table.points;
  surface.weights = out.table.weights;
  OBVID_TRY(check(surface));
  out.shape = std::move(surface);
  return out;
}

/// Places of the values of a column in ascending order, each value once.
std::vector<double> different(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t rank_of(const std::vector<double>& sorted, double value) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) -
                                  sorted.begin());
}

/// Puts a list of points with rows and columns into the order of a net.
Result<void> arrange(const std::vector<double>& row, const std::vector<double>& col,
                     ControlTable& table) {
  const std::vector<double> rows = different(row), cols = different(col);
  const std::size_t count = rows.size() * cols.size();
  if (count != row.size()) {
    return fail(nurbs_error(ErrorCode::kBadCount,
                            fmt::format("{} rows by {} columns are {} points, the file holds {}",
                                        rows.size(), cols.size(), count, row.size()),
                            table.name, "give each place of the net once",
                            static_cast<double>(row.size())));
  }
  ControlTable sorted = table;
  std::vector<bool> taken(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = rank_of(rows, row[i]) * cols.size() + rank_of(cols, col[i]);
    if (taken[k]) {
      return fail(nurbs_error(ErrorCode::kBadCount,
                              fmt::format("row {}, column {} stands there twice", row[i], col[i]),
                              table.name, "give each place of the net once"));
    }
    taken[k] = true;
    sorted.points[k] = table.points[i];
    sorted.weights[k] = table.weights[i];
  }
  sorted.rows = rows.size();
  table = std::move(sorted);
  return {};
}

void add_vector(JsonText& json, Vec3 v) {
  json.begin_array().value(v.x).value(v.y).value(v.z).end_array();
}

}  // namespace

Result<ControlTable> control_table(const ColumnTable& table, const std::string& name) {
  ControlTable out;
  out.name = name;
  const bool named = !table.names.empty();
  const auto place = [&](const char* column, std::size_t unnamed) -> std::optional<std::size_t> {
    if (named) return table.column({column});
    return unnamed < table.rows.front().size() ? std::optional(unnamed) : std::nullopt;
  };
  constexpr std::size_t kNever = 1000;
  const auto x = place("x", 0), y = place("y", 1), z = place("z", 2), w = place("w", 3),
             row = place("row", kNever), col = place("col", kNever);
  if (!x || !y || row.has_value() != col.has_value()) {
    return fail(nurbs_error(ErrorCode::kUsage, "columns of control points are missing", name,
                            "x and y, z of space, w weights; row and col of a net"));
  }
  out.spatial = z.has_value();
  std::vector<double> rows, cols;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<double>& cells = table.rows[i];
    for (const auto& column : {x, y, z, w, row, col}) {
      if (!column || *column < cells.size()) continue;
      return error(ErrorCode::kTooFewColumns, "a row is too short")
          .where(fmt::format("{}:{}", name, table.lines[i]))
          .hint("every row needs all columns")
          .point(i);
    }
    out.points.push_back({cells[*x], cells[*y], z ? cells[*z] : 0.0});
    out.weights.push_back(w ? cells[*w] : 1.0);
    if (row) rows.push_back(cells[*row]);
    if (col) cols.push_back(cells[*col]);
  }
  if (row) {
    OBVID_TRY(arrange(rows, cols, out));
  }
  return out;
}

Result<NurbsReport> nurbs_report(ControlTable table, const NurbsJob& job, const RunContext& run) {
  if (table.points.size() / table.rows < 2) {
    return fail(nurbs_error(ErrorCode::kTooFewPoints, "a curve needs at least 2 control points",
                            table.name, "add rows", static_cast<double>(table.points.size())));
  }
  NurbsReport out;
  out.table = std::move(table);
  if (out.table.rows > 1) return surface_report(std::move(out), job);
  const std::size_t n = out.table.points.size();
  const int degree = degree_for(n, job.degree);
  auto knots = knots_for(n, degree, job.knots, "--knots");
  OBVID_TRY(knots);
  SpaceCurve curve{degree, std::move(*knots), out.table.points, out.table.weights};
  OBVID_TRY(take_weights(job, curve));
  for (std::size_t i = 0; i < n; ++i) {
    OBVID_TRY(tell(run, "weights", static_cast<double>(i) / static_cast<double>(n)));
    out.rows.push_back(WeightOfPoint(curve, i).row());
  }
  out.table.weights = curve.weights;
  out.shape = std::move(curve);
  return out;
}

std::string nurbs_json(const NurbsReport& report) {
  JsonText json;
  json.begin_object().pair("format", "obvid-nurbs").pair("version", 1);
  json.pair("name", report.table.name);
  if (const auto* curve = std::get_if<SpaceCurve>(&report.shape)) {
    json.pair("kind", "curve").pair("degree", curve->degree);
    add_list(json, "knots", curve->knots);
  } else {
    const auto& surface = std::get<NurbsSurface>(report.shape);
    json.pair("kind", "surface").pair("degree", surface.degree_u);
    json.pair("degree_v", surface.degree_v).pair("rows", report.table.rows);
    add_list(json, "knots", surface.knots_u);
    add_list(json, "knots_v", surface.knots_v);
  }
  json.key("points").begin_array();
  for (const Vec3& p : report.table.points) add_vector(json, p);
  json.end_array();
  add_list(json, "weights", report.table.weights);
  json.key("rows_of_weights").begin_array();
  for (const WeightRow& row : report.rows) {
    json.begin_object().pair("point", row.point + 1).pair("u", row.u).pair("w", row.weight);
    json.pair("a", row.a).pair("b", row.b);
    json.key("B");
    add_vector(json, row.without);
    json.key("N");
    add_vector(json, row.even);
    json.key("C");
    add_vector(json, row.now);
    json.end_object();
  }
  json.end_array().end_object();
  return json.take();
}

std::string nurbs_samples_csv(const SpaceCurve& curve, std::size_t count) {
  std::string out = "u,x,y,z,curvature\n";
  const Range range = domain(curve);
  const std::size_t steps = std::max<std::size_t>(count, 2) - 1;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double u = range.at(static_cast<double>(k) / static_cast<double>(steps));
    const SpaceJet jet = evaluate(curve, u);
    out +=
        fmt::format("{},{},{},{},{}\n", u, jet.point.x, jet.point.y, jet.point.z, curvature(jet));
  }
  return out;
}

Result<ControlTable> read_control_table(const std::string& path) {
  const auto table = read_columns(path);
  OBVID_TRY(table);
  return control_table(*table, path == "-" ? "standard input" : path);
}

std::optional<SurfaceModel> nurbs_surface(const NurbsReport& report, const Units& units) {
  const auto* const surface = std::get_if<NurbsSurface>(&report.shape);
  if (surface == nullptr) return std::nullopt;
  SurfaceModel model;
  model.units = units;
  model.patches.push_back({"surface", *surface});
  return model;
}

Result<std::string> nurbs_file(const NurbsReport& report, const std::string& path,
                               const Units& units, std::size_t samples, const RunContext& run) {
  if (!std::holds_alternative<SpaceCurve>(report.shape)) {
    return error(ErrorCode::kUnknownFormat, "a net is written as a surface").where(path);
  }
  const auto& curve = std::get<SpaceCurve>(report.shape);
  const auto format = space_format_of(path);
  if (format == FileFormat::kContour) return nurbs_json(report);
  if (format == FileFormat::kSamples) return nurbs_samples_csv(curve, samples);
  if (format == FileFormat::kDxf) return space_dxf({curve}, curve.points, units);
  CadWriteOptions write;
  write.units = units.name;
  if (format == FileFormat::kIges) write.format = CadFormat::kIges;
  if (format == FileFormat::kBrep) write.format = CadFormat::kBrep;
  const bool cad =
      format == FileFormat::kStep || format == FileFormat::kIges || format == FileFormat::kBrep;
  if (cad) return cad_text({{"curve", curve}}, write, {{}, run.cancelled});
  return error(ErrorCode::kUnknownFormat, "nurbs writes no such file of a curve")
      .where(path)
      .hint("possible are .json, .csv, .step, .iges, .brep and .dxf");
}

}  // namespace obvid
