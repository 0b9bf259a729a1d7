// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/space_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "obvid/curve/internal/knots.h"
#include "obvid/surface/internal/collocation.h"
#include "snap.h"

namespace obvid {
namespace {

/// Knots of all curves as one list, those that differ by rounding made one.
std::vector<double> common_knots(const std::vector<SpaceCurve>& curves) {
  std::vector<double> all;
  for (const SpaceCurve& c : curves) all.insert(all.end(), c.knots.begin(), c.knots.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<double> kept;
  for (const double u : all) {
    if (kept.empty() || u - kept.back() > kSameKnot) kept.push_back(u);
  }
  kept.back() = 1.0;
  return kept;
}

}  // namespace

double curvature(const SpaceJet& jet) {
  const double speed = norm(jet.d1);
  return speed > 0.0 ? norm(cross(jet.d1, jet.d2)) / (speed * speed * speed) : 0.0;
}

SpaceCurve line_between(Vec3 from, Vec3 to) { return {1, {0.0, 0.0, 1.0, 1.0}, {from, to}, {}}; }

SpaceCurve arc_about(Vec3 start, Vec3 centre, Vec3 axis, double angle) {
  const Vec3 foot = centre + dot(start - centre, axis) * axis;
  const Vec3 x = start - foot, y = cross(axis, x);
  // spans of at most a quarter turn; a whisker more than a quarter is rounding, not a new span
  constexpr double kRounding = 1e-12;
  const double quarters = std::abs(angle) / (std::numbers::pi / 2.0);
  const auto spans = static_cast<std::size_t>(std::max(1.0, std::ceil(quarters - kRounding)));
  const double step = angle / static_cast<double>(spans), w = std::cos(step / 2.0);
  const bool full = std::abs(quarters - 4.0) <= kRounding;
  SpaceCurve arc{2, {0.0, 0.0, 0.0}, {start}, {1.0}};
  for (std::size_t i = 0; i < spans; ++i) {
    const double middle = (static_cast<double>(i) + 0.5) * step,
                 end = static_cast<double>(i + 1) * step;
    arc.points.push_back(foot + (std::cos(middle) / w) * x + (std::sin(middle) / w) * y);
    arc.weights.push_back(w);
    const bool last = i + 1 == spans;
    arc.points.push_back(last && full ? start : foot + std::cos(end) * x + std::sin(end) * y);
    arc.weights.push_back(1.0);
    const double knot = last ? 1.0 : static_cast<double>(i + 1) / static_cast<double>(spans);
    arc.knots.insert(arc.knots.end(), last ? 3 : 2, knot);
  }
  return arc;
}

SpaceCurve placed(const NurbsCurve& curve, const Frame& frame) {
  SpaceCurve out{curve.degree, curve.knots, {}, curve.weights};
  out.points.reserve(curve.points.size());
  for (const Vec2& p : curve.points) out.points.push_back(frame.at(p));
  const bool polynomial =
      std::all_of(out.weights.begin(), out.weights.end(), [](double w) { return w == 1.0; });
  if (polynomial) out.weights.clear();
  return out;
}

std::vector<SpaceCurve> compatible(std::vector<SpaceCurve> curves) {
  if (curves.empty()) return curves;
  int degree = 1;
  bool rational = false;
  for (const SpaceCurve& c : curves) {
    degree = std::max(degree, c.degree);
    rational = rational || !c.weights.empty();
  }
  for (SpaceCurve& c : curves) c = with_degree(with_domain(c, {0.0, 1.0}), degree);
  const std::vector<double> distinct = common_knots(curves);
  for (SpaceCurve& c : curves) snap(c.knots, distinct);
  for (SpaceCurve& c : curves) {
    std::vector<double> added;
    for (const double u : distinct) {
      std::size_t most = 0;
      for (const SpaceCurve& other : curves) most = std::max(most, multiplicity(other.knots, u));
      added.insert(added.end(), most - multiplicity(c.knots, u), u);
    }
    // the curves already done keep the larger numbers, so later ones see the same maxima
    c = with_knots(c, added);
    if (rational && c.weights.empty()) c.weights.assign(c.points.size(), 1.0);
  }
  return curves;
}

Result<SpaceCurve> interpolated(const std::vector<Vec3>& points,
                                const std::vector<double>& parameters) {
  if (points.size() != parameters.size()) {
    return error(ErrorCode::kUsage, "as many parameters as points are needed")
        .value(static_cast<double>(parameters.size()));
  }
  const Result<Collocation> system = cubic_collocation(parameters);
  OBVID_TRY(system);
  return SpaceCurve{system->degree, system->knots, system->matrix.solve(points), {}};
}

std::vector<double> chord_parameters(const std::vector<Vec3>& points, double exponent) {
  std::vector<double> at(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    at[i] = at[i - 1] + std::pow(norm(points[i] - points[i - 1]), exponent);
  }
  const double all = at.empty() ? 0.0 : at.back();
  if (all > 0.0) {
    for (double& t : at) t = t == all ? 1.0 : t / all;
  }
  return at;
}

}  // namespace obvid
