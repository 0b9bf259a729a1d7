// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "kinds.h"
#include "one_denominator.h"

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

/// Whether weights agree but for rounding; then they are made the same.
bool made_same(const std::vector<double>& pattern, std::vector<double>& weights) {
  constexpr double kRounding = 1e-14;  // of a weight: moves points by that part of the size
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (std::abs(weights[i] - pattern[i]) > kRounding * pattern[i]) return false;
  }
  weights = pattern;
  return true;
}

SpaceCurve over_unit(const SpaceCurve& curve) {
  SpaceCurve out = with_domain(curve, {0.0, 1.0});
  const auto first = [&](double w) { return w == out.weights.front(); };
  if (std::all_of(out.weights.begin(), out.weights.end(), first)) out.weights.clear();
  return out;
}

/// Both curves over the same knots and, where degrees allow it, with the same weights.
struct Rows {
  SpaceCurve a, b;
  bool one_denominator = true;
};

Rows rows_of(const SpaceCurve& first, const SpaceCurve& second) {
  const SpaceCurve a = over_unit(first), b = over_unit(second);
  if (one_point(b)) return {a, like(a, b.points.front())};
  if (one_point(a)) return {like(b, a.points.front()), b};
  std::vector<SpaceCurve> both = compatible({a, b});
  if (made_same(both[0].weights, both[1].weights)) return {both[0], both[1]};
  if (auto product = with_one_denominator(a, b)) return {(*product)[0], (*product)[1]};
  return {both[0], both[1], false};
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

namespace {

Result<void> check_both(const SpaceCurve& one, const SpaceCurve& other) {
  return check(one).and_then([&] { return check(other); });
}

/// How far points of rulings are from where the definition has them when the curves have different
/// weights: the rulings are the same. Weights vary slowly, so a raster finds the largest.
double sideways(const RuledSurface& s, const NurbsSurface& form) {
  constexpr int kInSpan = 8, kAlong = 16;
  double worst = 0.0;
  for (std::size_t k = 1; k < form.knots_u.size(); ++k) {
    const Range span{form.knots_u[k - 1], form.knots_u[k]};
    if (!(span.length() > 0.0)) continue;
    for (int i = 0; i <= kInSpan; ++i) {
      const double u = span.at(static_cast<double>(i) / kInSpan);
      for (int j = 1; j < kAlong; ++j) {
        const double v = static_cast<double>(j) / kAlong;
        worst = std::max(worst, norm(evaluate(form, u, v).point - evaluate_kind(s, u, v).point));
      }
    }
  }
  constexpr double kBetween = 1.1;  // what it may rise between the samples
  return kBetween * worst;
}

}  // namespace

Result<NurbsForm> nurbs_of(const RuledSurface& s, double) {
  OBVID_TRY(check_both(s.first, s.second));
  const Rows rows = rows_of(s.first, s.second);
  NurbsForm form{between_rows(rows.a, rows.b, {0.0, 1.0}), 0.0};
  if (!rows.one_denominator) form.deviation = sideways(s, form.surface);
  return form;
}

Result<NurbsForm> nurbs_of(const DirectedSurface& s, double) {
  OBVID_TRY(check_both(s.directrix, s.direction));
  if (!(s.to > s.from) || !std::isfinite(s.from) || !std::isfinite(s.to)) {
    return error(ErrorCode::kBadOption, "the parameters along the directions do not ascend")
        .value(s.to - s.from);
  }
  const Rows rows = rows_of(s.directrix, s.direction);
  if (!rows.one_denominator) {
    return error(ErrorCode::kBadOption,
                 "a rational directrix and its directions have degrees that are too high together")
        .hint("give both with the same weights, or with a lower degree")
        .value(static_cast<double>(s.directrix.degree + s.direction.degree));
  }
  return NurbsForm{
      between_rows(along(rows.a, rows.b, s.from), along(rows.a, rows.b, s.to), {s.from, s.to}),
      0.0};
}

DirectedSurface cylinder_over(const SpaceCurve& directrix, Vec3 direction) {
  return {directrix, line_between(direction, direction), 0.0, 1.0};
}

RuledSurface cone_over(const SpaceCurve& directrix, Vec3 apex) {
  return {directrix, line_between(apex, apex)};
}

}  // namespace obvid
