// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/spline_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "obvid/exchange/internal/sketch.h"
#include "obvid/geom/internal/chord.h"
#include "obvid/idspline/internal/scalar_cubic.h"
#include "obvid/io/internal/json_list.h"
#include "obvid/numeric/internal/golden.h"

namespace obvid {
namespace {

constexpr double kUnknownError = std::numeric_limits<double>::quiet_NaN();
/// Default tolerance of machining, of the size of what is formed.
constexpr double kMachiningPart = 1e-4;
/// Coordinates of a program are written to this part of its tolerance's decimal place.
constexpr double kProgrammedPart = 0.1;
constexpr int kMostHalvingsOfMove = 40;
/// Places of a move at which its distance from the spline is looked at: a polynomial of degree 6
/// has no more extrema beside a chord.
constexpr int kPlacesOfMove = 8;
constexpr std::size_t kPictureSteps = 16;  // of a cell

using Place = std::array<double, 3>;

Vec3 in_space(const Place& p) { return {p[0], p[1], p[2]}; }

double away(const Place& a, const Place& b) { return norm(in_space(a) - in_space(b)); }

double from_move(const Place& p, const Place& a, const Place& b) {
  return distance_from_chord(in_space(p), in_space(a), in_space(b));
}

/// Any spline of this file: what it has at a parameter, and the integral over a cell.
struct Candidate {
  std::string name;
  std::function<std::vector<double>(double)> at;
  std::function<double(std::size_t)> cell_integral;  // of a function
};

/// As a place on the sheet: a function is its graph.
Place place_of(const Candidate& one, std::size_t dimensions, double u) {
  const std::vector<double> v = one.at(u);
  if (dimensions == 1) return {u, v[0], 0.0};
  return {v[0], v[1], dimensions > 2 ? v[2] : 0.0};
}

Place place_of(const SplineInput& input, std::size_t i) {
  if (input.dimensions == 1) return {input.nodes[i], input.values[0][i], 0.0};
  return {input.values[0][i], input.values[1][i], input.dimensions > 2 ? input.values[2][i] : 0.0};
}

double span_of_input(const SplineInput& input) {
  Place low = place_of(input, 0), high = low;
  for (std::size_t i = 0; i < input.nodes.size(); ++i) {
    const Place p = place_of(input, i);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  return away(low, high);
}

/// Straight moves along a spline, within a tolerance, as a program writes them.
class Moves {
 public:
  Moves(const Candidate& one, const SplineInput& input, double tolerance, const RunContext& run)
      : one_(one), run_(run), dimensions_(input.dimensions), tolerance_(tolerance) {
    const double place = std::floor(std::log10(kProgrammedPart * tolerance));
    step_ = std::pow(10.0, place);
    add(place_of(one, dimensions_, input.nodes.front()));
    for (std::size_t i = 0; i + 1 < input.nodes.size(); ++i) {
      cut(input.nodes[i], input.nodes[i + 1], kMostHalvingsOfMove);
    }
  }

  /// E103 when they end before the spline does.
  [[nodiscard]] const Result<void>& whole() const { return going_; }
  [[nodiscard]] const std::vector<Place>& places() const { return places_; }
  [[nodiscard]] double length() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < places_.size(); ++i) sum += away(places_[i - 1], places_[i]);
    return sum;
  }

 private:
  void cut(double from, double to, int left) {
    if (going_) going_ = may_go_on(run_);
    if (!going_) return;
    const Place a = place_of(one_, dimensions_, from), b = place_of(one_, dimensions_, to);
    double far = 0.0;
    for (int k = 1; k < kPlacesOfMove; ++k) {
      const double u = from + (to - from) * k / kPlacesOfMove;
      far = std::max(far, from_move(place_of(one_, dimensions_, u), a, b));
    }
    const double middle = 0.5 * (from + to);
    if (far > tolerance_ && left > 0 && middle > from && middle < to) {
      cut(from, middle, left - 1);
      cut(middle, to, left - 1);
      return;
    }
    add(b);
  }

  void add(const Place& p) {
    Place rounded;
    for (std::size_t k = 0; k < 3; ++k) rounded[k] = std::round(p[k] / step_) * step_;
    if (places_.empty() || !(rounded == places_.back())) places_.push_back(rounded);
  }

  const Candidate& one_;
  const RunContext& run_;
  Result<void> going_;
  std::size_t dimensions_;
  double tolerance_, step_ = 0.0;
  std::vector<Place> places_;
};

/// Figures of one spline.
class RowMaker {
 public:
  RowMaker(const SplineInput& input, const std::optional<SplineInput>& finer, double tolerance,
           const RunContext& run)
      : input_(input), finer_(finer), tolerance_(tolerance), run_(run) {}

  [[nodiscard]] Result<SplineRow> operator()(const Candidate& one) const {
    SplineRow row;
    row.name = one.name;
    for (std::size_t i = 0; i < input_.nodes.size(); ++i) {
      row.largest_move =
          std::max(row.largest_move,
                   away(place_of(one, input_.dimensions, input_.nodes[i]), place_of(input_, i)));
    }
    OBVID_TRY(add_integrals(one, row));
    const Moves moves(one, input_, tolerance_, run_);
    OBVID_TRY(moves.whole());
    row.blocks = moves.places().size() - 1;
    row.path_length = moves.length();
    OBVID_TRY(add_errors(one, moves, row));
    return row;
  }

 private:
  Result<void> add_integrals(const Candidate& one, SplineRow& row) const {
    row.integral = input_.dimensions == 1 ? 0.0 : kUnknownError;
    row.integral_error = input_.integrals.empty() ? kUnknownError : 0.0;
    if (input_.dimensions != 1) return {};
    for (std::size_t i = 0; i + 1 < input_.nodes.size(); ++i) {
      OBVID_TRY(may_go_on(run_));
      const double here = one.cell_integral(i);
      row.integral += here;
      if (input_.integrals.empty()) continue;
      row.integral_error = std::max(row.integral_error, std::abs(here - input_.integrals[i]));
    }
    return {};
  }

  Result<void> add_errors(const Candidate& one, const Moves& moves, SplineRow& row) const {
    if (!finer_) {
      row.largest_error = row.largest_at = row.rms_error = row.path_deviation = kUnknownError;
      return {};
    }
    double squares = 0.0;
    std::size_t near = 0;  // move: both go the same way
    for (std::size_t i = 0; i < finer_->nodes.size(); ++i) {
      OBVID_TRY(may_go_on(run_));
      const Place truth = place_of(*finer_, i);
      const double path = from_path(moves.places(), truth, near);
      row.path_deviation = std::max(row.path_deviation, path);
      const double error = input_.dimensions == 1
                               ? std::abs(one.at(finer_->nodes[i])[0] - finer_->values[0][i])
                               : from_curve(one, truth);
      squares += error * error;
      if (error < row.largest_error) continue;
      row.largest_error = error;
      row.largest_at = finer_->nodes[i];
    }
    row.rms_error = std::sqrt(squares / static_cast<double>(finer_->nodes.size()));
    return {};
  }

  static double from_path(const std::vector<Place>& path, const Place& p, std::size_t& near) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = near; i + 1 < path.size(); ++i) {
      const double here = from_move(p, path[i], path[i + 1]);
      if (here < least) near = i;
      least = std::min(least, here);
    }
    return least;
  }

  /// By the nearest of equal steps, then by golden sections beside it.
  [[nodiscard]] double from_curve(const Candidate& one, const Place& p) const {
    const double first = input_.nodes.front(), last = input_.nodes.back();
    const std::size_t steps = kPictureSteps * input_.nodes.size();
    const double width = (last - first) / static_cast<double>(steps);
    const auto distance = [&](double u) { return away(place_of(one, input_.dimensions, u), p); };
    double best = first;
    for (std::size_t k = 0; k <= steps; ++k) {
      const double u = first + width * static_cast<double>(k);
      if (distance(u) < distance(best)) best = u;
    }
    constexpr double kNearestFoundTo = 1e-10;  // of a step
    return distance(lowest_place(std::max(first, best - width), std::min(last, best + width),
                                 distance, kNearestFoundTo * width));
  }

  const SplineInput& input_;
  const std::optional<SplineInput>& finer_;
  double tolerance_;
  const RunContext& run_;
};

Result<std::vector<IdSpline>> id_parts(const SplineInput& input, const IdSplineOptions& options) {
  std::vector<IdSpline> out;
  for (const std::vector<double>& values : input.values) {
    IdSplineData data{input.nodes, values, input.integrals, {}, {}};
    if (options.degree >= 4) data.slopes = input.slopes;
    if (options.degree >= 6) data.seconds = input.seconds;
    auto part = id_spline(std::move(data), options);
    OBVID_TRY(part);
    out.push_back(std::move(*part));
  }
  return out;
}

std::string id_name(const IdSplineOptions& options) {
  const char* smooth = options.smoothing == IdSmoothing::kNone         ? ""
                       : options.smoothing == IdSmoothing::kValuesKept ? ", values kept"
                                                                       : ", values free";
  return fmt::format("degree {}{}", options.degree, smooth);
}

template <class Spline>
Candidate candidate_of(std::string name, std::vector<Spline> parts,
                       const std::vector<double>& nodes) {
  Candidate out;
  out.name = std::move(name);
  out.at = [parts](double u) {
    std::vector<double> values;
    for (const Spline& part : parts) values.push_back(evaluate(part, u).value);
    return values;
  };
  out.cell_integral = [parts, nodes](std::size_t i) {
    return integral(parts.front(), nodes[i], nodes[i + 1]);
  };
  return out;
}

template <class Make>
Result<Candidate> cubic_candidate(std::string name, const SplineInput& input, const Make& make) {
  std::vector<ScalarCubic> parts;
  for (const std::vector<double>& values : input.values) {
    auto part = make(input.nodes, values);
    OBVID_TRY(part);
    parts.push_back(std::move(*part));
  }
  return candidate_of(std::move(name), std::move(parts), input.nodes);
}

/// The other degrees, and the cubic splines (12) to (17) of the article.
Result<std::vector<Candidate>> others(const SplineInput& input, const IdSplineOptions& chosen) {
  std::vector<Candidate> out;
  for (const int degree : {2, 4, 6}) {
    for (const IdSmoothing smoothing :
         {IdSmoothing::kNone, IdSmoothing::kValuesKept, IdSmoothing::kValuesFree}) {
      const IdSplineOptions options{degree, smoothing};
      const bool same = degree == chosen.degree && smoothing == chosen.smoothing;
      if (same || (degree == 2 && smoothing == IdSmoothing::kValuesKept)) continue;
      auto parts = id_parts(input, options);
      OBVID_TRY(parts);
      out.push_back(candidate_of(id_name(options), std::move(*parts), input.nodes));
    }
  }
  const auto add = [&](Result<Candidate> one) -> Result<void> {
    OBVID_TRY(one);
    out.push_back(std::move(*one));
    return {};
  };
  OBVID_TRY(add(cubic_candidate("cubic, local", input, local_cubic)));
  const auto by_slopes = [](const std::vector<double>& x, const std::vector<double>& f) {
    return global_cubic_by_slopes(x, f);
  };
  const auto natural = [](const std::vector<double>& x, const std::vector<double>& f) {
    return global_cubic_by_seconds(x, f, {0.0, 0.0});
  };
  OBVID_TRY(add(cubic_candidate("cubic, by slopes", input, by_slopes)));
  OBVID_TRY(add(cubic_candidate("cubic, natural", input, natural)));
  return out;
}

/// Largest step of the slope at an inner node, of the larger of both slopes.
double largest_jump(const std::vector<IdSpline>& parts) {
  double largest = 0.0;
  for (const IdSpline& part : parts) {
    for (std::size_t i = 1; i + 1 < part.nodes.size(); ++i) {
      const double before = evaluate(cell(part, i - 1), part.nodes[i]).d1;
      const double after = evaluate(cell(part, i), part.nodes[i]).d1;
      const double scale = std::max(std::abs(before), std::abs(after));
      if (scale > 0.0) largest = std::max(largest, std::abs(after - before) / scale);
    }
  }
  return largest;
}

Error short_row(const ColumnTable& table, std::size_t row, const std::string& name) {
  return error(ErrorCode::kTooFewColumns, "a row is too short")
      .where(fmt::format("{}:{}", name, table.lines[row]))
      .hint("every row needs x and its values; the last one alone may lack the integral")
      .point(row);
}

Error missing_column(const char* what, const std::string& name) {
  return {
      ErrorCode::kUsage, fmt::format("there is no column {}", what), name,
      "a function has columns x and f, and integral, slope, second if they are known; points of "
      "a curve (--curve) have x, y and z"};
}

/// One column, all rows; `last_may_lack`: one entry less does.
Result<std::vector<double>> whole_column(const ColumnTable& table, std::size_t column,
                                         bool last_may_lack, const std::string& name) {
  std::vector<double> out;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (column < table.rows[i].size()) {
      out.push_back(table.rows[i][column]);
    } else if (!(last_may_lack && i + 1 == table.rows.size())) {
      return fail(short_row(table, i, name));
    }
  }
  if (last_may_lack && out.size() == table.rows.size()) out.pop_back();
  return out;
}

Result<SplineInput> curve_input(const ColumnTable& table, const std::string& name) {
  SplineInput out;
  out.name = name;
  const bool named = !table.names.empty();
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < 3; ++k) {
    const char* const wanted = k == 0 ? "x" : k == 1 ? "y" : "z";
    const auto at = named ? table.column({wanted}) : std::optional(k);
    const bool there = at && *at < table.rows.front().size();
    if (!there && k < 2) return fail(missing_column(wanted, name));
    if (there) columns.push_back(*at);
  }
  out.dimensions = columns.size();
  for (const std::size_t column : columns) {
    auto values = whole_column(table, column, false, name);
    OBVID_TRY(values);
    out.values.push_back(std::move(*values));
  }
  out.nodes.assign(table.rows.size(), 0.0);
  for (std::size_t i = 1; i < out.nodes.size(); ++i) {
    out.nodes[i] = out.nodes[i - 1] + away(place_of(out, i - 1), place_of(out, i));
  }
  return out;
}

}  // namespace

Result<SplineInput> spline_input(const ColumnTable& table, const std::string& name, bool curve) {
  if (table.rows.size() < 2) {
    return error(ErrorCode::kTooFewPoints, "a spline needs at least two nodes")
        .where(name)
        .hint("add rows")
        .value(static_cast<double>(table.rows.size()));
  }
  if (curve) return curve_input(table, name);
  SplineInput out;
  out.name = name;
  const bool named = !table.names.empty();
  const auto x = named ? table.column({"x"}) : std::optional<std::size_t>(0);
  const auto f = named ? table.column({"f", "value", "y"}) : std::optional<std::size_t>(1);
  if (!x) return fail(missing_column("x", name));
  if (!f) return fail(missing_column("f", name));
  if (!named && table.rows.front().size() > 2) {
    return error(ErrorCode::kUsage, "columns beyond the second need names")
        .where(name)
        .hint("write a header: x, f, integral, slope, second");
  }
  auto nodes = whole_column(table, *x, false, name);
  OBVID_TRY(nodes);
  out.nodes = std::move(*nodes);
  auto values = whole_column(table, *f, false, name);
  OBVID_TRY(values);
  out.values.push_back(std::move(*values));
  const auto take = [&](std::initializer_list<std::string_view> names, bool cells,
                        std::vector<double>& to) -> Result<void> {
    const auto at = table.column(names);
    if (!at) return {};
    auto column = whole_column(table, *at, cells, name);
    OBVID_TRY(column);
    to = std::move(*column);
    return {};
  };
  OBVID_TRY(take({"integral"}, true, out.integrals));
  OBVID_TRY(take({"slope"}, false, out.slopes));
  OBVID_TRY(take({"second"}, false, out.seconds));
  return out;
}

Result<SplineReport> spline_report(SplineInput input, const SplineJob& job,
                                   const std::optional<SplineInput>& finer, const RunContext& run) {
  SplineReport out;
  auto parts = id_parts(input, job.options);
  OBVID_TRY(parts);
  out.parts = std::move(*parts);
  out.tolerance = job.tolerance.value_or(kMachiningPart * span_of_input(input));
  out.largest_jump = largest_jump(out.parts);
  std::vector<Candidate> all = {candidate_of(id_name(job.options), out.parts, input.nodes)};
  if (job.compare) {
    OBVID_TRY(tell(run, "spline", 0.0));
    auto more = others(input, job.options);
    OBVID_TRY(more);
    all.insert(all.end(), more->begin(), more->end());
  }
  const RowMaker row_of(input, finer, out.tolerance, run);
  for (const Candidate& one : all) {
    OBVID_TRY(tell(run, "figures",
                   static_cast<double>(out.rows.size()) / static_cast<double>(all.size())));
    auto row = row_of(one);
    OBVID_TRY(row);
    out.rows.push_back(std::move(*row));
  }
  out.input = std::move(input);
  return out;
}

std::string spline_samples_csv(const SplineReport& report, std::size_t count) {
  const std::vector<double>& nodes = report.input.nodes;
  const bool function = report.input.dimensions == 1;
  std::string out = function ? "x,f,f_d1,f_d2,integral\n" : "parameter,x,x_d1,x_d2,y,y_d1,y_d2";
  if (!function) out += report.input.dimensions > 2 ? ",z,z_d1,z_d2\n" : "\n";
  const std::size_t steps = std::max<std::size_t>(count, 2) - 1;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(steps);
    const double u = k == steps ? nodes.back() : nodes.front() + t * (nodes.back() - nodes.front());
    out += fmt::format("{}", u);
    for (const IdSpline& part : report.parts) {
      const ScalarJet jet = evaluate(part, u);
      out += fmt::format(",{},{},{}", jet.value, jet.d1, jet.d2);
    }
    if (function) out += fmt::format(",{}", integral(report.parts[0], nodes.front(), u));
    out += "\n";
  }
  return out;
}

std::string spline_report_json(const SplineReport& report) {
  JsonText json;
  json.begin_object().pair("format", "obvid-spline").pair("version", 1);
  json.pair("name", report.input.name).pair("dimensions", report.input.dimensions);
  json.pair("degree", report.parts.front().degree).pair("tolerance", report.tolerance);
  json.pair("largest_jump_of_slope", report.largest_jump);
  json.key("rows").begin_array();
  for (const SplineRow& row : report.rows) {
    json.begin_object().pair("spline", row.name).pair("largest_error", row.largest_error);
    json.pair("largest_at", row.largest_at).pair("rms_error", row.rms_error);
    json.pair("largest_move", row.largest_move).pair("integral", row.integral);
    json.pair("integral_error", row.integral_error).pair("blocks", row.blocks);
    json.pair("path_length", row.path_length).pair("path_deviation", row.path_deviation);
    json.end_object();
  }
  json.end_array();
  add_list(json, "nodes", report.input.nodes).key("parts").begin_array();
  for (const IdSpline& part : report.parts) {
    json.begin_object().key("cells").begin_array();
    for (std::size_t i = 0; i + 1 < part.nodes.size(); ++i) {
      const auto coefficients = power_coefficients(cell(part, i));
      json.begin_object().pair("integral", part.integrals[i]).key("coefficients").begin_array();
      for (int k = 0; k <= part.degree; ++k) {
        json.value(coefficients[static_cast<std::size_t>(k)]);
      }
      json.end_array().end_object();
    }
    json.end_array().end_object();
  }
  json.end_array().end_object();
  return json.take();
}

namespace {

Sketch spline_sketch(const SplineReport& report) {
  const Candidate one = candidate_of("", report.parts, report.input.nodes);
  Sketch out;
  out.title = report.input.name;
  out.remarks.push_back(report.rows.front().name);
  if (report.input.dimensions > 2) out.remarks.emplace_back("as seen along z");
  SketchLayer curve = sketch_layer("SPLINE", "spline", "#1f4e79", 5),
              nodes = sketch_layer("POINTS", "given points", "#c00000", 1);
  curve.polylines.emplace_back();
  const std::vector<double>& u = report.input.nodes;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Place p = place_of(report.input, i);
    nodes.points.push_back({p[0], p[1]});
    for (std::size_t k = 0; i + 1 < u.size() && k < kPictureSteps; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(kPictureSteps);
      const Place at = place_of(one, report.input.dimensions, u[i] + t * (u[i + 1] - u[i]));
      curve.polylines.back().push_back({at[0], at[1]});
    }
  }
  const Place end = place_of(one, report.input.dimensions, u.back());
  curve.polylines.back().push_back({end[0], end[1]});
  out.layers = {std::move(curve), std::move(nodes)};
  return out;
}

}  // namespace

std::string spline_svg(const SplineReport& report) { return sketch_svg(spline_sketch(report)); }
std::string spline_dxf(const SplineReport& report) { return sketch_dxf(spline_sketch(report)); }

}  // namespace obvid
