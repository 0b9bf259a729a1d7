// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/bspline.h"

#include <algorithm>
#include <array>

#include "homogeneous.h"

namespace obvid {
namespace {

using curve_detail::Homogeneous;

Homogeneous between(const Homogeneous& a, const Homogeneous& b, double t) {
  const double s = 1.0 - t;
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.w + t * b.w};
}

bool belongs_together(const NurbsCurve& c) {
  const auto p = static_cast<std::size_t>(std::max(c.degree, 0));
  return c.degree >= 1 && c.degree <= kMaxBezierDegree && c.points.size() > p &&
         c.weights.size() == c.points.size() && c.knots.size() == c.points.size() + p + 1;
}

/// Blossom of the span [knots[k], knots[k + 1]] with `right` arguments at its end and the others at
/// its start: Bezier control point number `right` (de Boor's algorithm, one argument per step).
Homogeneous blossom(const NurbsCurve& c, std::size_t k, std::size_t right) {
  const auto p = static_cast<std::size_t>(c.degree);
  std::array<Homogeneous, kMaxBezierDegree + 1> d{};
  for (std::size_t j = 0; j <= p; ++j) {
    const std::size_t i = k - p + j;
    const double w = c.weights[i];
    d[j] = {w * c.points[i].x, w * c.points[i].y, w};
  }
  for (std::size_t r = 1; r <= p; ++r) {
    const double u = r <= right ? c.knots[k + 1] : c.knots[k];
    for (std::size_t j = p; j >= r; --j) {
      const double low = c.knots[k - p + j], high = c.knots[k + j + 1 - r];
      d[j] = between(d[j - 1], d[j], (u - low) / (high - low));
    }
  }
  return d[p];
}

RationalBezier span_piece(const NurbsCurve& c, std::size_t k) {
  RationalBezier piece;
  piece.degree = c.degree;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(c.degree); ++j) {
    const Homogeneous h = blossom(c, k, j);
    piece.offset[j] = {h.x / h.w, h.y / h.w};
    piece.weight[j] = h.w;
  }
  return piece;
}

}  // namespace

std::vector<BezierSpan> bezier_spans(const NurbsCurve& curve) {
  std::vector<BezierSpan> spans;
  if (!belongs_together(curve)) return spans;
  const auto p = static_cast<std::size_t>(curve.degree);
  for (std::size_t k = p; k < curve.points.size(); ++k) {
    if (!(curve.knots[k + 1] > curve.knots[k])) continue;
    spans.push_back({curve.knots[k], curve.knots[k + 1], span_piece(curve, k)});
    // neighbours share their end: both blossoms round to it, one of them is kept
    if (spans.size() > 1) {
      const RationalBezier& before = spans[spans.size() - 2].piece;
      spans.back().piece.offset[0] = before.offset[p];
      spans.back().piece.weight[0] = before.weight[p];
    }
  }
  return spans;
}

Jet evaluate(const NurbsCurve& curve, double u) {
  if (!belongs_together(curve)) return {};
  const auto p = static_cast<std::ptrdiff_t>(curve.degree);
  const auto first = curve.knots.begin() + p, last = curve.knots.end() - p - 1;
  const auto above = std::upper_bound(first, last, std::max(u, *first));
  auto k = above - curve.knots.begin() - 1;
  while (k > p && !(curve.knots[static_cast<std::size_t>(k)] < *last)) --k;
  const auto span = static_cast<std::size_t>(k);
  const double from = curve.knots[span], length = curve.knots[span + 1] - from;
  Jet jet = evaluate(span_piece(curve, span), (u - from) / length);
  jet.d1 = jet.d1 / length;
  jet.d2 = jet.d2 / (length * length);
  jet.d3 = jet.d3 / (length * length * length);
  return jet;
}

}  // namespace obvid
