// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/nurbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/curve/internal/basis.h"
#include "obvid/curve/internal/blossom.h"
#include "obvid/curve/internal/homogeneous.h"
#include "obvid/curve/internal/knots.h"

namespace obvid {
namespace {

template <class V>
Line line_of(const Nurbs<V>& curve) {
  return {curve.degree, curve.knots, lifted(curve.points, curve.weights)};
}

template <class V>
Nurbs<V> curve_of(const Line& line, bool rational) {
  Nurbs<V> curve{line.degree, line.knots, {}, {}};
  curve.points.reserve(line.points.size());
  for (const Vec4& p : line.points) {
    curve.points.push_back(rational ? dropped<V>(p) : numerator<V>(p));
    if (rational) curve.weights.push_back(p.w);
  }
  return curve;
}

template <class V>
bool belongs_together(const Nurbs<V>& c) {
  const auto p = static_cast<std::size_t>(std::max(c.degree, 0));
  return c.degree >= 1 && c.degree <= kMaxNurbsDegree && c.points.size() > p &&
         (c.weights.empty() || c.weights.size() == c.points.size()) &&
         c.knots.size() == c.points.size() + p + 1;
}

/// Bezier control point number `right` of the span [knots[k], knots[k + 1]].
template <class V>
Vec4 span_point(const Nurbs<V>& c, std::size_t k, std::size_t right) {
  const auto p = static_cast<std::size_t>(c.degree);
  std::array<Vec4, kMaxNurbsDegree + 1> d{};
  for (std::size_t j = 0; j <= p; ++j) d[j] = lifted(c.points, c.weights, k - p + j);
  return blossom(c.knots, k, p, d, right, c.knots[k + 1], c.knots[k],
                 [](const Vec4& a, const Vec4& b, double share) { return between(a, b, share); });
}

}  // namespace

template <class V>
Result<void> check_points(const std::vector<V>& points, const std::vector<double>& weights,
                          std::size_t wanted) {
  if (points.size() != wanted || (!weights.empty() && weights.size() != wanted)) {
    return error(ErrorCode::kBadOption,
                 fmt::format("{} control points and {} weights where the knots need {}",
                             points.size(), weights.size(), wanted))
        .value(static_cast<double>(wanted));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto index = static_cast<std::ptrdiff_t>(i);
    if (!is_finite(points[i]) || (!weights.empty() && !std::isfinite(weights[i]))) {
      return error(ErrorCode::kNotFinite, fmt::format("control point {} is not finite", i))
          .point(index);
    }
    if (!weights.empty() && !(weights[i] > 0.0)) {
      return error(ErrorCode::kBadOption,
                   fmt::format("weight {} is {:g}, weights are greater than 0", i, weights[i]))
          .point(index)
          .value(weights[i]);
    }
  }
  return {};
}

template <class V>
Result<void> check(const Nurbs<V>& curve) {
  OBVID_TRY(check_knots(curve.degree, curve.knots, "the knots"));
  return check_points(curve.points, curve.weights,
                      curve.knots.size() - static_cast<std::size_t>(curve.degree) - 1);
}

template <class V>
NurbsJet<V> evaluate(const Nurbs<V>& curve, double u) {
  const BasisValues basis = basis_at(curve.degree, curve.knots, u, 3);
  std::array<Vec4, 4> h{};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(curve.degree); ++j) {
    const Vec4 p = lifted(curve.points, curve.weights, basis.first + j);
    for (std::size_t r = 0; r < 4; ++r) h[r] = h[r] + basis.value[r][j] * p;
  }
  if (curve.weights.empty()) {
    return {numerator<V>(h[0]), numerator<V>(h[1]), numerator<V>(h[2]), numerator<V>(h[3])};
  }
  NurbsJet<V> jet;
  const double w = h[0].w;
  jet.point = numerator<V>(h[0]) / w;
  jet.d1 = (numerator<V>(h[1]) - h[1].w * jet.point) / w;
  jet.d2 = (numerator<V>(h[2]) - 2.0 * h[1].w * jet.d1 - h[2].w * jet.point) / w;
  jet.d3 =
      (numerator<V>(h[3]) - 3.0 * h[1].w * jet.d2 - 3.0 * h[2].w * jet.d1 - h[3].w * jet.point) / w;
  return jet;
}

template <class V>
Nurbs<V> reversed(const Nurbs<V>& curve) {
  Nurbs<V> out = curve;
  const double sum = curve.knots.front() + curve.knots.back();
  std::transform(curve.knots.rbegin(), curve.knots.rend(), out.knots.begin(),
                 [&](double u) { return sum - u; });
  // the ends without rounding
  const auto ends = static_cast<std::ptrdiff_t>(curve.degree) + 1;
  std::fill(out.knots.begin(), out.knots.begin() + ends, curve.knots.front());
  std::fill(out.knots.end() - ends, out.knots.end(), curve.knots.back());
  std::reverse(out.points.begin(), out.points.end());
  std::reverse(out.weights.begin(), out.weights.end());
  return out;
}

template <class V>
Nurbs<V> with_domain(const Nurbs<V>& curve, Range range) {
  Nurbs<V> out = curve;
  out.knots = mapped(curve.knots, range.from, range.to);
  return out;
}

template <class V>
Nurbs<V> with_knots(const Nurbs<V>& curve, const std::vector<double>& new_knots) {
  return curve_of<V>(inserted(line_of(curve), new_knots), !curve.weights.empty());
}

template <class V>
Nurbs<V> with_degree(const Nurbs<V>& curve, int degree) {
  if (degree <= curve.degree) return curve;
  Line line = line_of(curve);
  while (line.degree < degree) line = raised(line);
  return curve_of<V>(line, !curve.weights.empty());
}

template <class V>
std::array<Nurbs<V>, 2> split(const Nurbs<V>& curve, double u) {
  const auto p = static_cast<std::size_t>(curve.degree);
  const std::vector<double> added(p - std::min(p, multiplicity(curve.knots, u)), u);
  const Nurbs<V> cut = with_knots(curve, added);
  const auto first = std::lower_bound(cut.knots.begin(), cut.knots.end(), u) - cut.knots.begin();
  const auto joint = first - 1;  // control point that lies on the curve at u
  const auto degree = static_cast<std::ptrdiff_t>(p);
  Nurbs<V> before{curve.degree,
                  {cut.knots.begin(), cut.knots.begin() + first + degree},
                  {cut.points.begin(), cut.points.begin() + joint + 1},
                  {}};
  before.knots.push_back(u);
  Nurbs<V> after{curve.degree, {u}, {cut.points.begin() + joint, cut.points.end()}, {}};
  after.knots.insert(after.knots.end(), cut.knots.begin() + first, cut.knots.end());
  if (!cut.weights.empty()) {
    before.weights.assign(cut.weights.begin(), cut.weights.begin() + joint + 1);
    after.weights.assign(cut.weights.begin() + joint, cut.weights.end());
  }
  return {before, after};
}

template <class V>
std::vector<Nurbs<V>> spans(const Nurbs<V>& curve) {
  std::vector<Nurbs<V>> out;
  if (!belongs_together(curve)) return out;
  const auto p = static_cast<std::size_t>(curve.degree);
  for (std::size_t k = p; k < curve.points.size(); ++k) {
    const double from = curve.knots[k], to = curve.knots[k + 1];
    if (!(to > from)) continue;
    Line line{curve.degree, std::vector<double>(p + 1, from), {}};
    line.knots.insert(line.knots.end(), p + 1, to);
    for (std::size_t j = 0; j <= p; ++j) line.points.push_back(span_point(curve, k, j));
    Nurbs<V> span = curve_of<V>(line, !curve.weights.empty());
    if (!out.empty()) {  // neighbours share their end: both round to it, one of them is kept
      span.points.front() = out.back().points.back();
      if (!span.weights.empty()) span.weights.front() = out.back().weights.back();
    }
    out.push_back(std::move(span));
  }
  return out;
}

std::vector<BezierSpan> bezier_spans(const NurbsCurve& curve) {
  std::vector<BezierSpan> out;
  if (curve.degree > kMaxBezierDegree) return out;
  for (const NurbsCurve& span : spans(curve)) {
    BezierSpan one{span.knots.front(), span.knots.back(), {}};
    one.piece.degree = span.degree;
    std::copy(span.points.begin(), span.points.end(), one.piece.offset.begin());
    std::fill_n(one.piece.weight.begin(), span.points.size(), 1.0);
    std::copy(span.weights.begin(), span.weights.end(), one.piece.weight.begin());
    out.push_back(one);
  }
  return out;
}

NurbsCurve nurbs_of(const RationalBezier& piece) {
  const auto n = static_cast<std::size_t>(piece.degree) + 1;
  NurbsCurve out{piece.degree, std::vector<double>(n, 0.0), {}, {}};
  out.knots.insert(out.knots.end(), n, 1.0);
  for (std::size_t j = 0; j < n; ++j) {
    out.points.push_back(piece.origin + piece.offset[j]);
    out.weights.push_back(piece.weight[j]);
  }
  return out;
}

template Result<void> check_points(const std::vector<Vec2>&, const std::vector<double>&,
                                   std::size_t);
template Result<void> check(const Nurbs<Vec2>&);
template NurbsJet<Vec2> evaluate(const Nurbs<Vec2>&, double);
template Nurbs<Vec2> reversed(const Nurbs<Vec2>&);
template Nurbs<Vec2> with_domain(const Nurbs<Vec2>&, Range);
template Nurbs<Vec2> with_knots(const Nurbs<Vec2>&, const std::vector<double>&);
template Nurbs<Vec2> with_degree(const Nurbs<Vec2>&, int);
template std::array<Nurbs<Vec2>, 2> split(const Nurbs<Vec2>&, double);
template std::vector<Nurbs<Vec2>> spans(const Nurbs<Vec2>&);
template Result<void> check_points(const std::vector<Vec3>&, const std::vector<double>&,
                                   std::size_t);
template Result<void> check(const Nurbs<Vec3>&);
template NurbsJet<Vec3> evaluate(const Nurbs<Vec3>&, double);
template Nurbs<Vec3> reversed(const Nurbs<Vec3>&);
template Nurbs<Vec3> with_domain(const Nurbs<Vec3>&, Range);
template Nurbs<Vec3> with_knots(const Nurbs<Vec3>&, const std::vector<double>&);
template Nurbs<Vec3> with_degree(const Nurbs<Vec3>&, int);
template std::array<Nurbs<Vec3>, 2> split(const Nurbs<Vec3>&, double);
template std::vector<Nurbs<Vec3>> spans(const Nurbs<Vec3>&);

}  // namespace obvid
