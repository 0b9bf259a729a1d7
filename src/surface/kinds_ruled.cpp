// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "kinds.h"

namespace obvid {
namespace {

NurbsSurface between_rows(const SpaceCurve& low, const SpaceCurve& high, Range v) {
  NurbsSurface s{low.degree, 1, low.knots, {v.from, v.from, v.to, v.to}, low.points, low.weights};
  s.points.insert(s.points.end(), high.points.begin(), high.points.end());
  s.weights.insert(s.weights.end(), high.weights.begin(), high.weights.end());
  return s;
}

bool one_point(const SpaceCurve& curve) {
  return std::all_of(curve.points.begin(), curve.points.end(),
                     [&](const Vec3& p) { return p == curve.points.front(); });
}

/// A curve that stands still, with the weights of another: both rows then have one denominator.
SpaceCurve like(const SpaceCurve& pattern, Vec3 point) {
  SpaceCurve curve = pattern;
  std::fill(curve.points.begin(), curve.points.end(), point);
  return curve;
}

SpaceCurve along(const SpaceCurve& directrix, const SpaceCurve& direction, double v) {
  SpaceCurve curve = directrix;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    curve.points[i] = curve.points[i] + v * direction.points[i];
  }
  return curve;
}

}  // namespace

SpaceJet evaluate_unit(const SpaceCurve& curve, double t) {
  const Range range = domain(curve);
  const double l = range.length();
  SpaceJet jet = evaluate(curve, range.at(t));
  jet.d1 = l * jet.d1;
  jet.d2 = l * l * jet.d2;
  jet.d3 = l * l * l * jet.d3;
  return jet;
}

SurfaceJet evaluate_kind(const RuledSurface& s, double u, double v) {
  const SpaceJet a = evaluate_unit(s.first, u), b = evaluate_unit(s.second, u);
  return {(1.0 - v) * a.point + v * b.point,
          (1.0 - v) * a.d1 + v * b.d1,
          b.point - a.point,
          (1.0 - v) * a.d2 + v * b.d2,
          b.d1 - a.d1,
          {}};
}

SurfaceJet evaluate_kind(const DirectedSurface& s, double u, double v) {
  const SpaceJet a = evaluate_unit(s.directrix, u), d = evaluate_unit(s.direction, u);
  return {a.point + v * d.point, a.d1 + v * d.d1, d.point, a.d2 + v * d.d2, d.d1, {}};
}

Result<NurbsForm> nurbs_of(const RuledSurface& s) {
  SpaceCurve first = with_domain(s.first, {0.0, 1.0}), second = with_domain(s.second, {0.0, 1.0});
  if (one_point(second)) {
    second = like(first, second.points.front());
  } else if (one_point(first)) {
    first = like(second, first.points.front());
  } else {
    std::vector<SpaceCurve> rows = compatible({first, second});
    first = std::move(rows[0]);
    second = std::move(rows[1]);
  }
  return NurbsForm{between_rows(first, second, {0.0, 1.0}), 0.0};
}

Result<NurbsForm> nurbs_of(const DirectedSurface& s) {
  if (!(s.to > s.from)) {
    return fail({ErrorCode::kBadOption, "the parameters along the directions do not ascend", "", "",
                 -1, s.to - s.from});
  }
  SpaceCurve directrix = with_domain(s.directrix, {0.0, 1.0}), direction = s.direction;
  if (one_point(direction)) {
    direction = like(directrix, direction.points.front());
  } else {
    std::vector<SpaceCurve> rows = compatible({directrix, direction});
    directrix = std::move(rows[0]);
    direction = std::move(rows[1]);
  }
  if (directrix.weights != direction.weights) {
    return fail({ErrorCode::kBadOption, "directions have other weights than their directrix", "",
                 "give directions as a polynomial curve to a polynomial directrix", -1, 0.0});
  }
  const Range v{s.from, s.to};
  return NurbsForm{
      between_rows(along(directrix, direction, s.from), along(directrix, direction, s.to), v), 0.0};
}

DirectedSurface cylinder_over(const SpaceCurve& directrix, Vec3 direction) {
  return {directrix, line_between(direction, direction), 0.0, 1.0};
}

RuledSurface cone_over(const SpaceCurve& directrix, Vec3 apex) {
  return {directrix, line_between(apex, apex)};
}

}  // namespace obvid
