// SPDX-License-Identifier: Apache-2.0
// Whether the parts of a contour file fit each other: elements, runs, carrier, NURBS curve.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "checks.h"

namespace judge {
namespace {

bool is_polynomial(const Bezier& b) {
  return std::all_of(b.weight.begin(), b.weight.end(), [&](double w) { return w == b.weight[0]; });
}

/// Which pieces a carrier is made of (docs/carriers.md).
bool fits(const std::string& carrier, const Piece& piece) {
  if (std::holds_alternative<Line>(piece) || std::holds_alternative<Arc>(piece)) return true;
  if (carrier == "imported") return true;  // as it is drawn
  if (std::holds_alternative<Clothoid>(piece)) return carrier == "clothoids";
  const auto& b = std::get<Bezier>(piece);
  if (carrier == "spiral") return b.degree() == 4;
  if (carrier == "conics") return b.degree() == 2;
  if (carrier == "beziers") return b.degree() == 2 && is_polynomial(b);
  if (carrier == "bspline") return b.degree() == 5 && is_polynomial(b);
  if (carrier == "cubic" || carrier == "baseline") return b.degree() == 3 && is_polynomial(b);
  return false;
}

void check_carrier(const ContourFile& file, Sheet& sheet) {
  static const std::set<std::string> kNames = {"spiral",  "arcs",      "conics",
                                               "beziers", "clothoids", "bspline",
                                               "cubic",   "baseline",  "imported"};
  const bool known = kNames.contains(file.carrier);
  if (!sheet.expect(known, "carrier", file.carrier, std::string("a known name"), "")) return;
  for (std::size_t i = 0; i < file.pieces.size(); ++i) {
    if (fits(file.carrier, file.pieces[i])) continue;
    const auto* b = std::get_if<Bezier>(&file.pieces[i]);
    return sheet.fails(
        "carrier", file.carrier,
        b == nullptr ? type_name(file.pieces[i]) : fmt::format("bezier of degree {}", b->degree()),
        fmt::format("piece {}", i));
  }
  sheet.holds("carrier");
}

void check_elements(const Course& course, Sheet& sheet) {
  const ContourFile& file = course.file;
  const std::size_t wanted = file.pieces.size() + (file.closed ? 0 : 1);
  const bool repeated = file.closed && file.elements.size() == wanted + 1;
  if (!sheet.expect(file.elements.size() == wanted || repeated, "elements",
                    static_cast<long double>(file.elements.size()),
                    static_cast<long double>(wanted), "number of elements")) {
    return;
  }
  const ElementGap gap = worst_element_gap(course);
  constexpr double kHeading = 1e-6, kCurvature = 1e-6;
  // where the pieces miss the joint, `joint_gaps` says how far (judged on its own)
  const Figure told = figure(member(course.file.certificate, "joint_gaps"), "position");
  const double position =
      1e-12 + 64.0 * 0x1p-53 * course.ends.coordinate / course.ends.size + told.value.value_or(0.0);
  sheet.expect(gap.position <= position && gap.heading <= kHeading && gap.curvature <= kCurvature,
               "elements", std::string("point, heading, curvature of the joint"),
               fmt::format("off by {:.3g} of the size, {:.3g} rad, {:.3g} of the curvature",
                           gap.position, gap.heading, gap.curvature),
               fmt::format("joint {}", gap.at));
}

/// Runs cover the pieces in order and none of their pieces goes against their direction.
void check_runs(const Course& course, Sheet& sheet) {
  const bool proved = flag(course.file.certificate, "proved").value_or(true);  // none: runs claim
  if (const auto fault = run_fault(course, proved)) {
    return sheet.fails("runs", fault->stated, fault->found, fault->where);
  }
  sheet.holds("runs");
}

/// The control points of span k of a curve whose inner knots stand `degree` times.
Span span_of(const FileSpline& spline, std::size_t k, Point origin) {
  std::vector<Vec> points;
  std::vector<Real> weights;
  const auto p = static_cast<std::size_t>(spline.degree);
  for (std::size_t j = 0; j <= p; ++j) {
    points.push_back(seen(spline.points[k * p + j], origin));
    weights.push_back(spline.weights[k * p + j]);
  }
  return {std::move(points), std::move(weights)};
}

bool has_bezier_knots(const FileSpline& spline, std::size_t spans) {
  const auto p = static_cast<std::size_t>(spline.degree);
  if (spline.points.size() != spans * p + 1 || spline.weights.size() != spline.points.size() ||
      spline.knots.size() != spline.points.size() + p + 1) {
    return false;
  }
  for (std::size_t i = 0; i < spline.knots.size(); ++i) {
    // p + 1 equal ones at the ends, p at each inner place
    const std::size_t place = i == 0 ? 0 : std::min((i - 1) / p, spans);
    const std::size_t head = place == 0 ? 0 : 1 + place * p;
    if (spline.knots[i] != spline.knots[head]) return false;
    if (i > 0 && spline.knots[i] < spline.knots[i - 1]) return false;
  }
  return true;
}

void check_spline(const Course& course, Sheet& sheet) {
  const ContourFile& file = course.file;
  if (!file.spline) return;
  const FileSpline& spline = *file.spline;
  const std::size_t spans = file.pieces.size();
  if (spline.degree < 1 || !has_bezier_knots(spline, spans)) {
    return sheet.fails("bspline", "one span per piece", "other knots", "");
  }
  for (std::size_t k = 0; k < spans; ++k) {
    const Span span = span_of(spline, k, course.origin);
    for (const Real t : {0.0L, 0.3L, 0.5L, 0.8L, 1.0L}) {
      const Real off = norm(span.point(t) - course.path.spans()[k].point(t));
      if (off <= 1e-15L * course.ends.size + 0x1p-60L * course.ends.coordinate) continue;
      return sheet.fails("bspline", "equals the pieces", fmt::format("off by {:.3Lg}", off),
                         fmt::format("piece {}, t = {:.1Lf}", k, t));
    }
  }
  sheet.holds("bspline");
}

/// `points` of an exact piece are its sums rounded.
void check_rounded(const ContourFile& file, Sheet& sheet) {
  for (std::size_t i = 0; i < file.pieces.size(); ++i) {
    const auto* b = std::get_if<Bezier>(&file.pieces[i]);
    if (b == nullptr || b->origin == Point{}) continue;
    for (std::size_t j = 0; j < b->offset.size(); ++j) {
      const Point sum{b->origin.x + b->offset[j].x, b->origin.y + b->offset[j].y};
      if (sum == b->rounded[j]) continue;
      return sheet.fails("pieces.exact", "points are the rounded sums", "they are not",
                         fmt::format("piece {}", i));
    }
  }
  sheet.holds("pieces.exact");
}

/// Numbers whose rounding could hide something: no piece needs them.
void check_sizes(const Course& course, Sheet& sheet) {
  constexpr double kMostHeading = 1e4;  // rad
  for (std::size_t i = 0; i < course.file.pieces.size(); ++i) {
    const Piece& piece = course.file.pieces[i];
    double theta = 0.0;
    if (const auto* arc = std::get_if<Arc>(&piece)) theta = arc->theta0;
    if (const auto* one = std::get_if<Clothoid>(&piece)) theta = one->theta0;
    const auto* b = std::get_if<Bezier>(&piece);
    const double origin =
        b == nullptr ? 0.0 : std::max(std::abs(b->origin.x), std::abs(b->origin.y));
    const bool far = origin > 4.0 * (course.ends.coordinate + course.ends.size);
    if (std::abs(theta) <= kMostHeading && !far) continue;
    return sheet.fails(
        "pieces.sizes",
        far ? fmt::format("origin {:.3g}", origin) : fmt::format("theta0 {:.3g}", theta),
        "its rounding hides gaps", fmt::format("piece {}", i));
  }
  sheet.holds("pieces.sizes");
}

/// Corners that stand on no point lie between two neighbours, of points that may be passed.
void check_between(const ContourFile& file, Sheet& sheet) {
  for (const FileElement& e : file.elements) {
    if (!e.between) continue;
    const auto [before, behind] = *e.between;
    const std::size_t n = file.points.size();
    const bool neighbours = before < n && (file.closed ? behind == (before + 1) % n
                                                       : behind == before + 1 && behind < n);
    sheet.expect(neighbours && e.corner && !e.source && !file.tolerance.empty(), "elements.between",
                 fmt::format("{}, {}", before, behind),
                 std::string("neighbours around a corner on no point"), "");
  }
}

/// Elements that name a point stand on it, or as near as its tolerance; all points are met in
/// order.
void check_points_met(const Course& course, Sheet& sheet) {
  const ContourFile& file = course.file;
  const std::string fault = missed_point(course);
  // a contour that is told not to run through all of them claims nothing here
  const bool claimed = flag(file.certificate, "through_points").value_or(true);
  if (!claimed && !fault.empty()) return sheet.holds("points met");
  sheet.expect(fault.empty(), "points met", std::string("every point"), fault, "");
  check_between(file, sheet);
  if (file.points.size() < 2 || file.closed) return;
  std::size_t due = 0;
  for (const FileElement& e : file.elements) {
    if (!e.source) continue;
    if (*e.source < due) {
      return sheet.fails("elements.source", std::to_string(*e.source), std::to_string(due), "");
    }
    due = *e.source + 1;
  }
  sheet.holds("elements.source");
}

}  // namespace

std::optional<RunFault> run_fault(const Course& course, bool monotone) {
  const ContourFile& file = course.file;
  std::size_t due = 0;
  for (std::size_t r = 0; r < file.runs.size(); ++r) {
    const FileRun& run = file.runs[r];
    const std::string where = fmt::format("run {}", r),
                      said = fmt::format("direction {}", run.direction);
    if (run.first != due || run.last < run.first || run.last >= file.pieces.size()) {
      return RunFault{fmt::format("pieces {}-{}", run.first, run.last),
                      fmt::format("piece {} is due", due), where};
    }
    due = run.last + 1;
    if (!file.promises_monotone() && run.direction == 0) continue;  // claims nothing
    if (!monotone && file.promises_monotone()) continue;  // `monotone` says what became of it
    bool changes = false;
    for (std::size_t i = run.first; i <= run.last; ++i) {
      const CurvatureLaw& law = course.laws[i];
      const JointFacts& joint = course.joints[i];
      const std::string at = fmt::format("{}, piece {}", where, i);
      const bool inner = i > run.first && !joint.corner && !joint.step && joint.clear_jump &&
                         file.promises_monotone();
      for (const int sign : {inner ? joint.jump : 0, law.direction()}) {
        if (sign == 0) continue;
        changes = true;
        if (sign != run.direction) return RunFault{said, fmt::format("direction {}", sign), at};
      }
      if (law.decided && !law.one_way()) return RunFault{said, "curvature turns", at};
    }
    if (run.direction != 0 && !changes && file.carrier != "arcs") {
      return RunFault{said, "constant", where};
    }
  }
  if (due == file.pieces.size()) return std::nullopt;
  return RunFault{fmt::format("{} pieces covered", due), fmt::format("{}", file.pieces.size()), ""};
}

void check_form(const Course& course, Sheet& sheet) {
  check_carrier(course.file, sheet);
  check_elements(course, sheet);
  check_runs(course, sheet);
  check_spline(course, sheet);
  check_rounded(course.file, sheet);
  check_sizes(course, sheet);
  check_points_met(course, sheet);
}

}  // namespace judge
