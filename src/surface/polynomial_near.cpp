// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "kinds.h"

namespace obvid {
namespace {

/// Bezier points of the cubic with the curve's points and derivatives at a and b.
std::array<Vec3, 4> cubic(const SpaceJet& a, const SpaceJet& b, double length) {
  return {a.point, a.point + (length / 3.0) * a.d1, b.point - (length / 3.0) * b.d1, b.point};
}

Vec3 at(std::array<Vec3, 4> b, double t) {
  for (std::size_t n = 3; n > 0; --n) {
    for (std::size_t j = 0; j < n; ++j) b[j] = (1.0 - t) * b[j] + t * b[j + 1];
  }
  return b[0];
}

/// Whether the derivatives of two pieces agree where they meet, apart from rounding.
bool same_derivative(const std::array<Vec3, 4>& before, double length_before,
                     const std::array<Vec3, 4>& after, double length_after) {
  constexpr double kRounding = 1e-10;  // of both derivatives
  const Vec3 left = (before[3] - before[2]) / length_before;
  const Vec3 right = (after[1] - after[0]) / length_after;
  return norm(left - right) <= kRounding * (norm(left) + norm(right));
}

class Halving {
 public:
  Halving(const SpaceCurve& curve, double tolerance) : curve_(curve), tolerance_(tolerance) {}

  bool add(double a, double b, int depth) {
    constexpr int kSamples = 8;
    const SpaceJet from = evaluate(curve_, a);
    // the end of a span belongs to it, not to the next one
    const SpaceJet to = from_the_left(b);
    const std::array<Vec3, 4> piece = cubic(from, to, b - a);
    double worst = 0.0;
    for (int k = 1; k < kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      worst = std::max(worst, norm(at(piece, t) - evaluate(curve_, a + t * (b - a)).point));
    }
    if (worst <= tolerance_) {
      deviation = std::max(deviation, worst);
      pieces.push_back(piece);
      ends.push_back(b);
      return true;
    }
    if (depth == 0) return false;
    const double middle = (a + b) / 2.0;
    return add(a, middle, depth - 1) && add(middle, b, depth - 1);
  }

  std::vector<std::array<Vec3, 4>> pieces;
  std::vector<double> ends;
  double deviation = 0.0;

 private:
  [[nodiscard]] SpaceJet from_the_left(double b) const {
    const bool knot = std::binary_search(curve_.knots.begin(), curve_.knots.end(), b);
    if (!knot || b == curve_.knots.back()) return evaluate(curve_, b);
    return evaluate(split(curve_, b)[0], b);
  }

  const SpaceCurve& curve_;
  double tolerance_;
};

}  // namespace

Result<PolynomialForm> polynomial_near(const SpaceCurve& given, double tolerance) {
  SpaceCurve curve = with_domain(given, {0.0, 1.0});
  if (curve.weights.empty()) return PolynomialForm{std::move(curve), 0.0};
  constexpr int kDeepest = 12;
  Halving halving(curve, tolerance);
  std::vector<double> knots = curve.knots;
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    if (halving.add(knots[i], knots[i + 1], kDeepest)) continue;
    return error(ErrorCode::kToleranceNotReached, "a rational curve is not followed by a cubic")
        .hint("allow a larger tolerance")
        .value(tolerance);
  }
  PolynomialForm form{{3, {0.0, 0.0, 0.0, 0.0}, {halving.pieces.front()[0]}, {}},
                      halving.deviation};
  double from = 0.0;
  for (std::size_t k = 0; k < halving.pieces.size(); ++k) {
    const std::array<Vec3, 4>& here = halving.pieces[k];
    const double to = halving.ends[k];
    form.curve.points.push_back(here[1]);
    form.curve.points.push_back(here[2]);
    const bool last = k + 1 == halving.pieces.size();
    // between pieces that meet with one derivative the joint itself is no control point
    const bool smooth =
        !last && same_derivative(here, to - from, halving.pieces[k + 1], halving.ends[k + 1] - to);
    if (!smooth) form.curve.points.push_back(here[3]);
    form.curve.knots.insert(form.curve.knots.end(), last ? 4 : smooth ? 2 : 3, to);
    from = to;
  }
  return form;
}

}  // namespace obvid
