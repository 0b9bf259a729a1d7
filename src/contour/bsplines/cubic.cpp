// SPDX-License-Identifier: Apache-2.0
// The C2 cubic spline by its slopes: docs/methods/bsplines.md, section 1.
#include <cmath>
#include <optional>

#include "obvid/contour/bsplines.h"
#include "obvid/numeric/internal/tridiagonal.h"
#include "spline_knots.h"

namespace obvid {
namespace {

/// Slopes m_i. Rows of a spline are dominated by their diagonal, except the not-a-knot ends, which
/// are entered so that theirs is what remains.
using SlopeSystem = TridiagonalSystem<double, Vec2>;

/// Length and mean slope of a span.
struct Step {
  double h = 0.0;
  Vec2 mean;
};

Step step(const std::vector<Vec2>& points, const std::vector<double>& u, std::size_t i) {
  const double h = u[i + 1] - u[i];
  return {h, (1.0 / h) * (points[i + 1] - points[i])};
}

/// Continuity of the second derivative between two spans.
Vec2 joint_right(const Step& a, const Step& b) { return 3.0 * (b.h * a.mean + a.h * b.mean); }

/// First row of a not-a-knot spline: continuity of the third derivative at the second knot, with
/// m_2 taken out by the row of that knot. Seen from the other end it is the last one.
Vec2 not_a_knot_right(const Step& outer, const Step& inner) {
  const double sum = outer.h + inner.h;
  return (1.0 / sum) *
         ((outer.h + 2.0 * sum) * inner.h * outer.mean + (outer.h * outer.h) * inner.mean);
}

void set_start(SlopeSystem& system, const CubicSplineOptions& o, const Step& a, const Step& b) {
  if (o.end == SplineEnd::kTangents) return system.set_first(1.0, 0.0, o.start_slope);
  if (o.end == SplineEnd::kNatural) return system.set_first(2.0, 1.0, 3.0 * a.mean);
  system.set_first(b.h, a.h + b.h, not_a_knot_right(a, b));
}

void add_end(SlopeSystem& system, std::size_t i, const CubicSplineOptions& o, const Step& a,
             const Step& b) {
  if (o.end == SplineEnd::kTangents) return system.add(i, 0.0, 1.0, 0.0, o.end_slope);
  if (o.end == SplineEnd::kNatural) return system.add(i, 1.0, 2.0, 0.0, 3.0 * b.mean);
  system.add(i, a.h + b.h, a.h, 0.0, not_a_knot_right(b, a));
}

std::vector<Vec2> open_slopes(const std::vector<Vec2>& points, const std::vector<double>& u,
                              const CubicSplineOptions& options) {
  const std::size_t n = points.size();
  SlopeSystem system(n);
  Step a = step(points, u, 0), b = n > 2 ? step(points, u, 1) : a;
  set_start(system, options, a, b);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    b = step(points, u, i);
    system.add(i, b.h, 2.0 * (a.h + b.h), a.h, joint_right(a, b));
    if (i + 2 < n) a = b;
  }
  add_end(system, n - 1, options, a, b);
  return system.solve();
}

/// Two points, or three without data at the ends: the line or the parabola through them.
std::vector<Vec2> parabola_slopes(const std::vector<Vec2>& points, const std::vector<double>& u) {
  const Step a = step(points, u, 0);
  if (points.size() == 2) return {a.mean, a.mean};
  const Step b = step(points, u, 1);
  const Vec2 bend = (1.0 / (a.h + b.h)) * (b.mean - a.mean);
  return {a.mean - a.h * bend, a.mean + a.h * bend, b.mean + b.h * bend};
}

/// Four points without data at the ends: the cubic through them, by divided differences. The system
/// of slopes has nothing but the middle span to tell two of its rows apart, however short that is.
std::vector<Vec2> one_cubic_slopes(const std::vector<Vec2>& points, const std::vector<double>& u) {
  const Step a = step(points, u, 0), b = step(points, u, 1), c = step(points, u, 2);
  const Vec2 first = (1.0 / (a.h + b.h)) * (b.mean - a.mean);
  const Vec2 last = (1.0 / (b.h + c.h)) * (c.mean - b.mean);
  const Vec2 third = (1.0 / (a.h + b.h + c.h)) * (last - first);
  return {a.mean - a.h * first + (a.h * (a.h + b.h)) * third,
          a.mean + a.h * first - (a.h * b.h) * third, c.mean - c.h * last - (c.h * b.h) * third,
          c.mean + c.h * last + (c.h * (b.h + c.h)) * third};
}

/// Cyclic system: the corner entries make a matrix of rank one, which Sherman and Morrison's
/// formula adds to the tridiagonal rest. `points` ends with its first point.
std::vector<Vec2> periodic_slopes(const std::vector<Vec2>& points, const std::vector<double>& u) {
  const std::size_t n = points.size() - 1;
  const Step first = step(points, u, 0), last = step(points, u, n - 1);
  // row 0 has first.h before (m_{n-1}), row n-1 has step(n-2).h behind (m_0)
  const double corner_above = first.h, corner_below = step(points, u, n - 2).h;
  const double shift = 2.0 * (last.h + first.h);  // any number of the diagonal's size will do
  SlopeSystem plain(n), unit(n);
  Step a = last;
  for (std::size_t i = 0; i < n; ++i) {
    const Step b = step(points, u, i);
    const double diagonal = 2.0 * (a.h + b.h);
    const Vec2 right = joint_right(a, b);
    if (i == 0) {
      plain.set_first(diagonal + shift, a.h, right);
      unit.set_first(diagonal + shift, a.h, {-shift, 0.0});
    } else {
      const bool end = i + 1 == n;
      const double more = end ? corner_above * corner_below / shift : 0.0;
      const double behind = end ? 0.0 : a.h;
      plain.add(i, b.h, diagonal + more, behind, right);
      unit.add(i, b.h, diagonal + more, behind, {end ? corner_below : 0.0, 0.0});
    }
    a = b;
  }
  std::vector<Vec2> m = plain.solve();
  const std::vector<Vec2> q = unit.solve();
  const double tail = -corner_above / shift;
  const Vec2 along = m[0] + tail * m[n - 1];
  const Vec2 factor = (1.0 / (1.0 + q[0].x + tail * q[n - 1].x)) * along;
  for (std::size_t i = 0; i < n; ++i) m[i] = m[i] - q[i].x * factor;
  m.push_back(m.front());
  return m;
}

bool finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

}  // namespace

Result<CubicSpline> cubic_spline(const std::vector<Vec2>& points,
                                 const CubicSplineOptions& options) {
  const bool periodic = options.end == SplineEnd::kPeriodic;
  const bool tangents = options.end == SplineEnd::kTangents;
  if (tangents && !(finite(options.start_slope) && finite(options.end_slope))) {
    return error(ErrorCode::kBadOption, "a given slope is no number");
  }
  CubicSpline spline{{}, points, {}};
  if (periodic && !points.empty()) spline.points.push_back(points.front());
  auto knots = bsplines::spline_knots(spline.points, options.parameter, periodic ? 4 : 2);
  if (!knots) {
    Error error = std::move(knots.error());
    if (periodic && error.index + 1 == static_cast<std::ptrdiff_t>(spline.points.size())) {
      error.where = "points " + std::to_string(points.size()) + " and 1";
      error.index = static_cast<std::ptrdiff_t>(points.size()) - 1;
      error.last = 0;
    }
    return fail(std::move(error));
  }
  spline.knots = std::move(*knots);
  const std::size_t few = options.end == SplineEnd::kNotAKnot  ? 3
                          : options.end == SplineEnd::kNatural ? 2
                                                               : 0;
  if (periodic) {
    spline.slopes = periodic_slopes(spline.points, spline.knots);
  } else if (points.size() <= few) {
    spline.slopes = parabola_slopes(points, spline.knots);
  } else if (options.end == SplineEnd::kNotAKnot && points.size() == 4) {
    spline.slopes = one_cubic_slopes(points, spline.knots);
  } else {
    spline.slopes = open_slopes(points, spline.knots, options);
  }
  return spline;
}

}  // namespace obvid
