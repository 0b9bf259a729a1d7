// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/bspline_cubic.h"

#include <algorithm>
#include <limits>

namespace obvid {
namespace {

/// Polynomial point + x (slope + x (second + x third)), x = u - from.
struct Span {
  double from = 0.0;
  Vec2 point, slope, second, third;

  [[nodiscard]] Vec2 at(double u) const {
    const double x = u - from;
    return point + x * (slope + x * (second + x * third));
  }
};

Span span_of(const CubicSpline& s, std::size_t i) {
  const double over = 1.0 / (s.knots[i + 1] - s.knots[i]);
  const Vec2 mean = over * (s.points[i + 1] - s.points[i]);
  const Vec2 a = s.slopes[i] - mean, b = s.slopes[i + 1] - mean;
  return {s.knots[i], s.points[i], s.slopes[i], -over * (2.0 * a + b), (over * over) * (a + b)};
}

/// Span that holds u, or the nearest one.
std::size_t find_span(const CubicSpline& s, double u) {
  const auto inner = s.knots.begin() + 1, end = s.knots.end() - 1;
  return static_cast<std::size_t>(std::upper_bound(inner, end, u) - inner);
}

RationalBezier bezier_piece(const CubicSpline& s, std::size_t i) {
  const double third = (s.knots[i + 1] - s.knots[i]) / 3.0;
  RationalBezier piece;
  piece.degree = 3;
  piece.offset = {s.points[i], s.points[i] + third * s.slopes[i],
                  s.points[i + 1] - third * s.slopes[i + 1], s.points[i + 1]};
  piece.weight = {1.0, 1.0, 1.0, 1.0};
  return piece;
}

}  // namespace

Jet evaluate(const CubicSpline& spline, double u) {
  const Span s = span_of(spline, find_span(spline, u));
  const double x = u - s.from;
  return {s.at(u), s.slope + x * (2.0 * s.second + (3.0 * x) * s.third),
          2.0 * s.second + (6.0 * x) * s.third, 6.0 * s.third};
}

void evaluate_sorted(const CubicSpline& spline, std::span<const double> u, std::span<Vec2> out) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t last = spline.knots.size() - 2;
  double low = kInfinity, high = kInfinity;  // of no span yet
  std::size_t i = 0;
  Span here;
  for (std::size_t j = 0; j < u.size(); ++j) {
    if (!(u[j] >= low && u[j] < high)) {
      // mostly the next span: no need to search
      const bool next = low < high && u[j] >= high && (i + 1 == last || u[j] < spline.knots[i + 2]);
      i = next ? i + 1 : find_span(spline, u[j]);
      here = span_of(spline, i);
      low = i == 0 ? -kInfinity : spline.knots[i];
      high = i == last ? kInfinity : spline.knots[i + 1];
    }
    out[j] = here.at(u[j]);
  }
}

std::vector<RationalBezier> bezier_pieces(const CubicSpline& spline) {
  std::vector<RationalBezier> pieces;
  pieces.reserve(spline.knots.size());
  for (std::size_t i = 0; i + 1 < spline.knots.size(); ++i) {
    pieces.push_back(bezier_piece(spline, i));
  }
  return pieces;
}

NurbsCurve as_nurbs(const CubicSpline& spline) {
  const auto& u = spline.knots;
  const std::size_t n = u.size();
  NurbsCurve curve;
  curve.degree = 3;
  curve.knots.assign(3, u.front());
  curve.knots.insert(curve.knots.end(), u.begin(), u.end());
  curve.knots.insert(curve.knots.end(), 3, u.back());
  curve.points = {spline.points.front(), bezier_piece(spline, 0).offset[1]};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = u[i] - u[i - 1], behind = u[i + 1] - u[i];
    // the longer span's control polygon is extended: that blows up no rounding
    if (behind >= before) {
      const RationalBezier b = bezier_piece(spline, i);
      curve.points.push_back(b.offset[1] - (before / behind) * (b.offset[2] - b.offset[1]));
    } else {
      const RationalBezier b = bezier_piece(spline, i - 1);
      curve.points.push_back(b.offset[2] + (behind / before) * (b.offset[2] - b.offset[1]));
    }
  }
  curve.points.push_back(bezier_piece(spline, n - 2).offset[2]);
  curve.points.push_back(spline.points.back());
  curve.weights.assign(curve.points.size(), 1.0);
  return curve;
}

}  // namespace obvid
