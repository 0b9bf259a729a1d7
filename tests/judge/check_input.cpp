// SPDX-License-Identifier: Apache-2.0
// Whether the contour is what was asked for: points, unit, closing, tolerances, given data.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "checks.h"

namespace judge {
namespace {

constexpr double kGivenHeading = 1e-9;      // rad (docs/claims.md)
constexpr double kGivenCurvature = 1e-9;    // of the curvature, or of the largest around where 0
constexpr double kDefaultTolerance = 3e-6;  // of the size (docs/cli.md)

struct Expected {
  std::vector<GivenPoint> points;
  bool closed = false;
  bool joined = false;  ///< the last point became the first one
};

double reach_of(const GivenPoint& p, const Input& input) {
  return p.tolerance.value_or(input.noise.value_or(0.0));
}

Expected expected_of(const Input& input) {
  Expected out{input.points, input.closed, false};
  if (out.points.size() < 3 || input.open) return out;
  const GivenPoint first = out.points.front(), last = out.points.back();
  const double apart = std::hypot(first.point.x - last.point.x, first.point.y - last.point.y);
  const bool exact = first.point == last.point;
  const bool near = apart <= reach_of(first, input) + reach_of(last, input);
  if (!exact && !near) return out;
  out.closed = true;
  out.joined = !exact;
  GivenPoint& kept = out.points.front();
  if (!kept.heading) kept.heading = last.heading;
  if (!kept.kappa) kept.kappa = last.kappa;
  out.points.pop_back();
  return out;
}

void check_points(const Course& course, const Expected& expected, const Input& input,
                  Sheet& sheet) {
  const ContourFile& file = course.file;
  if (!sheet.expect(file.points.size() == expected.points.size(), "points",
                    static_cast<long double>(file.points.size()),
                    static_cast<long double>(expected.points.size()), "number of points")) {
    return;
  }
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    const Point a = file.points[i], b = expected.points[i].point;
    const bool moved = expected.joined && i == 0;
    if (a == b || moved) continue;
    return sheet.fails("points", fmt::format("[{}, {}]", a.x, a.y),
                       fmt::format("[{}, {}]", b.x, b.y), fmt::format("point {}", i + 1));
  }
  sheet.holds("points");
  if (input.rounding) return;
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    const double stated = file.tolerance.empty() ? 0.0 : file.tolerance[i];
    double asked = reach_of(expected.points[i], input);
    // these follow the spirals within the tolerance (docs/carriers.md)
    if (file.carrier == "bspline" || file.carrier == "cubic") {
      asked += figure(file.report, "tolerance").value.value_or(0.0);
    }
    if (stated <= asked || (expected.joined && i == 0)) continue;
    return sheet.fails("point_tolerance", shown(stated), shown(asked),
                       fmt::format("point {}", i + 1));
  }
  sheet.holds("point_tolerance");
}

/// The ends that meet at a point: of the contour, by the file's stations.
struct Sides {
  std::vector<std::pair<double, double>> heading_kappa;
  double largest_kappa = 0.0;
};

Sides sides_at(const Course& course, std::size_t point) {
  Sides out;
  const auto add = [&](Real order, bool behind) {
    const Element e = course.element(order, behind);
    double kappa = static_cast<double>(e.kappa);
    if (order == std::floor(order)) {
      const auto j = static_cast<std::size_t>(order);
      const std::size_t piece = behind ? j : j - 1;
      kappa = static_cast<double>(
          (behind ? course.ends.start[piece] : course.ends.end[piece]).kappa.middle());
      out.largest_kappa =
          std::max({out.largest_kappa,
                    static_cast<double>(std::abs(course.ends.start[piece].kappa.middle())),
                    static_cast<double>(std::abs(course.ends.end[piece].kappa.middle()))});
    }
    out.heading_kappa.emplace_back(static_cast<double>(e.theta), kappa);
  };
  for (const Part& part : course.parts) {
    if (part.from_point == point) add(part.from, true);
    if (part.to_point == point) add(part.to, false);
  }
  return out;
}

void check_heading(const Sides& sides, double given, bool corner, const std::string& where,
                   Sheet& sheet) {
  double worst = 0.0, best = std::numeric_limits<double>::max(), stated = 0.0;
  for (const auto& [heading, kappa] : sides.heading_kappa) {
    const double off = std::abs(std::remainder(heading - given, 2.0 * std::numbers::pi));
    if (off >= worst) stated = heading;
    worst = std::max(worst, off);
    best = std::min(best, off);
  }
  sheet.expect((corner ? best : worst) <= kGivenHeading * (1.0 + 1e-6), "given.heading", stated,
               given, where);
}

void check_curvature(const Course& course, const Sides& sides, double given, bool corner,
                     const std::string& where, Sheet& sheet) {
  const double scale = given != 0.0 ? std::abs(given) : sides.largest_kappa;
  double worst = 0.0, best = std::numeric_limits<double>::max(), stated = 0.0;
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const auto& [heading, kappa] : sides.heading_kappa) {
    const double off = std::abs(kappa - given);
    if (off >= worst) stated = kappa;
    worst = std::max(worst, off);
    best = std::min(best, off);
    low = std::min(low, kappa);
    high = std::max(high, kappa);
  }
  const double slack = kGivenCurvature * scale * (1.0 + 1e-6);
  bool ok = (corner ? best : worst) <= slack;
  // arcs: any curvature between both arcs belongs to their common point
  if (course.file.carrier == "arcs") ok = ok || (given >= low - slack && given <= high + slack);
  sheet.expect(ok, "given.curvature", stated, given, where);
}

void check_given(const Course& course, const Expected& expected, Sheet& sheet) {
  bool any = false;
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    const GivenPoint& p = expected.points[i];
    if (!p.heading && !p.kappa) continue;
    any = true;
    const std::string where = fmt::format("point {}", i + 1);
    const Sides sides = sides_at(course, i);
    if (sides.heading_kappa.empty()) {
      sheet.unjudged("given.heading", "no station", where);
      continue;
    }
    bool corner = false;
    for (const FileElement& e : course.file.elements)
      corner = corner || (e.corner && e.source == i);
    if (p.heading) check_heading(sides, *p.heading, corner, where, sheet);
    if (p.kappa) check_curvature(course, sides, *p.kappa, corner, where, sheet);
  }
  if (any && course.file.given.is_null()) sheet.missing("given", "list of what was fixed");
}

void check_convex(const Course& course, Sheet& sheet) {
  double low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < course.ends.start.size(); ++i) {
    for (const End* end : {&course.ends.start[i], &course.ends.end[i]}) {
      low = std::min(low, end->kappa.upper());
      high = std::max(high, end->kappa.lower());
    }
  }
  constexpr double kConvexRounding = 1e-9;
  const double most = std::max(-low, high);
  sheet.expect(std::min(-low, high) <= kConvexRounding * most, "convex",
               std::string("no inflection"),
               fmt::format("curvature from {:.6g} to {:.6g}", low, high), "");
}

}  // namespace

void check_input(const Course& course, const Input& input, Sheet& sheet) {
  const ContourFile& file = course.file;
  const Expected expected = expected_of(input);
  sheet.expect(file.units == input.units, "units", file.units, input.units, "");
  sheet.expect(file.carrier == input.carrier, "carrier", file.carrier, input.carrier, "");
  sheet.expect(file.closed == expected.closed, "closed", file.closed ? "true" : "false",
               expected.closed ? "true" : "false", "");
  if (file.closed != expected.closed) return;
  check_points(course, expected, input, sheet);
  if (file.points.size() == expected.points.size()) check_given(course, expected, sheet);
  if (input.convex) check_convex(course, sheet);
  const Figure tolerance = figure(file.report, "tolerance");
  if (!tolerance.known()) return;
  if (input.tolerance) {
    sheet.expect(*tolerance.value == *input.tolerance, "report.tolerance", *tolerance.value,
                 *input.tolerance, "as asked for");
    return;
  }
  double lx = 1e308, ly = 1e308, hx = -1e308, hy = -1e308;
  for (const Point p : file.points) {
    lx = std::min(lx, p.x);
    ly = std::min(ly, p.y);
    hx = std::max(hx, p.x);
    hy = std::max(hy, p.y);
  }
  const double found = kDefaultTolerance * std::hypot(hx - lx, hy - ly);
  sheet.expect(std::abs(*tolerance.value - found) <= 1e-9 * found, "report.tolerance",
               *tolerance.value, found, "3e-6 of the size");
}

}  // namespace judge
