// SPDX-License-Identifier: Apache-2.0
// C2 cubic through points and tangents: docs/methods/bsplines.md, section 2.
#include <array>
#include <cmath>
#include <numbers>

#include "obvid/contour/bsplines.h"
#include "spline_knots.h"

namespace obvid {
namespace {

constexpr std::size_t kOrder = 4;
/// Farthest nonzero entry from the diagonal: point and derivative rows of parameter i stand at 2i
/// and 2i + 1, and their four control points begin at most two before and one behind.
constexpr std::size_t kReach = 3;

/// Cubic B-splines (and their derivatives) that are not zero at u, and the first one's index.
struct Basis {
  std::size_t first = 0;
  std::array<double, kOrder> value{};
  std::array<double, kOrder> slope{};
};

/// Cox and de Boor's recurrence on the span [knots[k], knots[k + 1]].
Basis basis_at(const std::vector<double>& knots, std::size_t k, double u) {
  Basis b;
  b.first = k - (kOrder - 1);
  b.value[0] = 1.0;
  for (std::size_t p = 1; p < kOrder; ++p) {
    std::array<double, kOrder> raised{};
    b.slope = {};
    for (std::size_t j = 0; j < p; ++j) {
      const double low = knots[k + 1 + j - p], high = knots[k + 1 + j];
      const double part = b.value[j] / (high - low);
      raised[j] += (high - u) * part;
      raised[j + 1] += (u - low) * part;
      const double rate = static_cast<double>(p) * part;
      b.slope[j] -= rate;
      b.slope[j + 1] += rate;
    }
    b.value = raised;
  }
  return b;
}

/// Inner knots between the parameters: the halves of the first and last interval, thirds of the
/// others. Then every inner interval has two, and point and derivative determine the spline
/// (Schoenberg and Whitney).
std::vector<double> inner_knots(const std::vector<double>& u) {
  const std::size_t n = u.size();
  std::vector<double> knots(kOrder, u.front());
  const auto between = [&](std::size_t i, double part) {
    knots.push_back(u[i] + part * (u[i + 1] - u[i]));
  };
  for (std::size_t i = 0; i + 1 < n && n > 2; ++i) {
    if (i == 0 || i + 2 == n) {
      between(i, 1.0 / 2.0);
    } else {
      between(i, 1.0 / 3.0);
      between(i, 2.0 / 3.0);
    }
  }
  knots.insert(knots.end(), kOrder, u.back());
  return knots;
}

/// Matrix with entries only near the diagonal, solved by elimination: collocation matrices of
/// B-splines are totally positive and need no pivoting.
class BandSystem {
 public:
  explicit BandSystem(std::size_t n) : rows_(n), right_(n) {}

  void set(std::size_t row, const Basis& basis, const std::array<double, kOrder>& entries,
           Vec2 right) {
    for (std::size_t j = 0; j < kOrder; ++j) {
      if (entries[j] != 0.0) rows_[row][basis.first + j + kReach - row] = entries[j];
    }
    right_[row] = right;
  }

  std::vector<Vec2> solve() {
    const std::size_t n = right_.size();
    for (std::size_t c = 0; c < n; ++c) {
      for (std::size_t r = c + 1; r < n && r <= c + kReach; ++r) {
        const double f = rows_[r][c + kReach - r] / rows_[c][kReach];
        if (f == 0.0) continue;
        for (std::size_t k = c; k < n && k <= c + kReach; ++k) {
          rows_[r][k + kReach - r] -= f * rows_[c][k + kReach - c];
        }
        right_[r] = right_[r] - f * right_[c];
      }
    }
    for (std::size_t c = n; c-- > 0;) {
      for (std::size_t k = c + 1; k < n && k <= c + kReach; ++k) {
        right_[c] = right_[c] - rows_[c][k + kReach - c] * right_[k];
      }
      right_[c] = right_[c] / rows_[c][kReach];
    }
    return std::move(right_);
  }

 private:
  std::vector<std::array<double, 2 * kReach + 1>> rows_;
  std::vector<Vec2> right_;
};

/// Length of a circle arc that turns by twice `half_turn`, over its chord. Beyond a right angle the
/// circle says little and its right angle is taken.
double arc_over_chord(double half_turn) {
  const double x = std::min(std::abs(half_turn), 0.5 * std::numbers::pi);
  constexpr double kSmall = 1e-4;  // rad: x^4/120 is below rounding
  return x < kSmall ? 1.0 + x * x / 6.0 : x / std::sin(x);
}

/// Speed of the curve over one chord: its expected length by the step of the parameter.
std::vector<double> speeds(const std::vector<Vec2>& points, const std::vector<double>& headings,
                           const std::vector<double>& u) {
  std::vector<double> speed(points.size() - 1);
  for (std::size_t i = 0; i < speed.size(); ++i) {
    const double turn = turning(unit_at(headings[i]), unit_at(headings[i + 1]));
    speed[i] = norm(points[i + 1] - points[i]) * arc_over_chord(0.5 * turn) / (u[i + 1] - u[i]);
  }
  return speed;
}

}  // namespace

Result<NurbsCurve> spline_through_tangents(const std::vector<Vec2>& points,
                                           const std::vector<double>& headings,
                                           SplineParameter parameter) {
  if (headings.size() != points.size()) {
    return error(ErrorCode::kUsage, "one heading for each point is expected")
        .value(static_cast<double>(headings.size()));
  }
  const auto u = bsplines::spline_knots(points, parameter, 2);
  OBVID_TRY(u);
  const std::size_t n = points.size();
  const auto speed = speeds(points, headings, *u);
  NurbsCurve curve;
  curve.degree = 3;
  curve.knots = inner_knots(*u);
  curve.weights.assign(2 * n, 1.0);
  BandSystem system(2 * n);
  std::size_t k = kOrder - 1;
  for (std::size_t i = 0; i < n; ++i) {
    while (k + 1 < 2 * n && curve.knots[k + 1] <= (*u)[i]) ++k;
    const Basis basis = basis_at(curve.knots, k, (*u)[i]);
    const double here = i == 0       ? speed[0]
                        : i + 1 == n ? speed[n - 2]
                                     : 0.5 * (speed[i - 1] + speed[i]);
    // at the end the derivative leads, so that the diagonal has no zero
    const std::size_t point_row = i + 1 == n ? 2 * i + 1 : 2 * i;
    const std::size_t slope_row = i + 1 == n ? 2 * i : 2 * i + 1;
    system.set(point_row, basis, basis.value, points[i]);
    system.set(slope_row, basis, basis.slope, here * unit_at(headings[i]));
  }
  curve.points = system.solve();
  curve.points.front() = points.front();
  curve.points.back() = points.back();
  return curve;
}

}  // namespace obvid
