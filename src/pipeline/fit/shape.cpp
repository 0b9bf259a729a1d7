// SPDX-License-Identifier: Apache-2.0
#include "fit/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "obvid/numeric/internal/small_system.h"

namespace obvid::pipeline_detail {
namespace {

/// Steps of one fit, and its last one, in lengths of the section.
constexpr int kFitSteps = 8;
constexpr double kFitted = 1e-13;
/// Rounds of Lawson's method: each takes weight to the points that lie farthest off.
constexpr int kMostRounds = 200;
constexpr double kLeastWeight = 1e-9;  ///< of a point, of the largest one
constexpr int kMeetingSteps = 30;
constexpr double kMet = 1e-14;  ///< last step towards the place where two meet, of the coordinates
constexpr std::size_t kMostUnknowns = 3;

/// The line or circle with the least weighted squares of distances, from one near it.
std::optional<Shape> fitted(Shape shape, const ShapePoints& points,
                            const std::vector<double>& weight, bool arc, double length) {
  const std::size_t unknowns = arc ? 3 : 2;
  for (int step = 0; step < kFitSteps; ++step) {
    std::array<std::array<double, kMostUnknowns>, kMostUnknowns> a{};
    std::array<double, kMostUnknowns> b{};
    for (std::size_t i = 0; i < points.at.size(); ++i) {
      const double s = shape.foot(points.at[i]), off = shape.off(points.at[i]);
      const double turn = shape.kappa * s, half = 0.5 * turn;
      const double sinc = half == 0.0 ? 1.0 : std::sin(half) / half;
      // how far the foot goes along its normal with the offset, the heading and the curvature
      const std::array<double, kMostUnknowns> slope = {
          std::cos(turn), s / length * (turn == 0.0 ? 1.0 : std::sin(turn) / turn),
          0.5 * (s / length) * (s / length) * sinc * sinc};
      for (std::size_t r = 0; r < unknowns; ++r) {
        b[r] += weight[i] * off / length * slope[r];
        for (std::size_t c = 0; c < unknowns; ++c) a[r][c] += weight[i] * slope[r] * slope[c];
      }
    }
    if (!arc) a[2][2] = 1.0;  // a line stays one
    if (!solve_small(a, b)) return std::nullopt;
    shape.anchor = shape.anchor + b[0] * length * left_normal(unit_at(shape.theta));
    shape.theta += b[1];
    shape.kappa += b[2] / length;
    const double largest = std::max({std::abs(b[0]), std::abs(b[1]), std::abs(b[2])});
    if (!(largest < 1.0)) return std::nullopt;  // it runs away
    if (largest < kFitted) break;
  }
  return shape;
}

/// The line through both ends, or the circle of least squares of the squared distances.
std::optional<Shape> first_guess(const ShapePoints& points, bool arc) {
  const Vec2 first = points.at.front(), last = points.at.back();
  const Vec2 middle_point = points.at[points.at.size() / 2];
  if (!arc) {
    if (first == last) return std::nullopt;
    return Shape{0.5 * (first + last), heading(last - first), 0.0};
  }
  const auto circle = circle_of_squares(points.at);
  if (!circle) return std::nullopt;
  const auto& [centre, radius] = *circle;
  double turned = 0.0;
  for (std::size_t i = 1; i < points.at.size(); ++i) {
    turned += cross(points.at[i - 1] - centre, points.at[i] - centre);
  }
  const Vec2 out = middle_point - centre;
  if (turned == 0.0 || !(norm(out) > 0.0)) return std::nullopt;
  Shape shape;
  shape.anchor = centre + (radius / norm(out)) * out;
  shape.kappa = (turned > 0.0 ? 1.0 : -1.0) / radius;
  shape.theta = heading(turned > 0.0 ? left_normal(out) : -left_normal(out));
  return shape;
}

/// Of the reaches, the most that a point is off.
double most_used(const Shape& shape, const ShapePoints& points) {
  double most = 0.0;
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    most = std::max(most, std::abs(shape.off(points.at[i])) / points.reach[i]);
  }
  return most;
}

/// Whether feet follow one another as far as the reaches tell.
bool feet_follow(const Shape& shape, const ShapePoints& points) {
  double before = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    const double s = shape.foot(points.at[i]);
    if (s + 2.0 * points.reach[i] < before) return false;
    before = std::max(before, s);
  }
  return shape.foot(points.at.back()) > shape.foot(points.at.front());
}

}  // namespace

std::optional<Shape> shape_within(const ShapePoints& points, bool arc) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.at.size(); ++i) {
    length += norm(points.at[i] - points.at[i - 1]);
  }
  auto shape = first_guess(points, arc);
  if (!shape || !(length > 0.0)) return std::nullopt;
  std::vector<double> weight;
  for (const double reach : points.reach) weight.push_back(1.0 / (reach * reach));
  const double unit = *std::max_element(weight.begin(), weight.end());
  for (double& w : weight) w /= unit;
  for (int round = 0; round < kMostRounds; ++round) {
    shape = fitted(*shape, points, weight, arc, length);
    if (!shape) return std::nullopt;
    if (most_used(*shape, points) <= 1.0) {
      return feet_follow(*shape, points) ? shape : std::nullopt;
    }
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < points.at.size(); ++i) {
      const double used = std::abs(shape->off(points.at[i])) / points.reach[i];
      const double part = weight[i] * points.reach[i] * points.reach[i];
      sum += part;
      squares += part * used * used;
      weight[i] *= used;
    }
    if (squares > sum) return std::nullopt;
    const double largest = *std::max_element(weight.begin(), weight.end());
    for (double& w : weight) w = std::max(w / largest, kLeastWeight);
  }
  return std::nullopt;
}

std::optional<Vec2> meeting(const Shape& a, const Shape& b, Vec2 near) {
  Vec2 p = near;
  for (int k = 0; k < kMeetingSteps; ++k) {
    const Vec2 na = left_normal(unit_at(a.theta + a.kappa * a.foot(p)));
    const Vec2 nb = left_normal(unit_at(b.theta + b.kappa * b.foot(p)));
    const double off_a = a.off(p), off_b = b.off(p), det = cross(na, nb);
    if (det == 0.0) return std::nullopt;
    const Vec2 step = Vec2{off_a * nb.y - off_b * na.y, off_b * na.x - off_a * nb.x} / det;
    p = p - step;
    if (norm(step) <= kMet * (std::abs(p.x) + std::abs(p.y))) return p;
  }
  return std::nullopt;
}

}  // namespace obvid::pipeline_detail
