// SPDX-License-Identifier: Apache-2.0
// Derivation: docs/methods/series.md.
#include "obvid/series/internal/scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace obvid {
namespace {

constexpr std::array<std::size_t, 4> kOthers = {0, 1, 3, 4};  // of five, those beside the middle
constexpr std::size_t kLeastPlaces = 20;
constexpr double kNormalPerMedian = 1.4826022185056018;  // 1 / inverse normal of 3/4
constexpr double kExceeded = 0.05;                       // probability that any point is beyond
/// Residuals of every second point hold the curve's part 16 times, its square 256 times.
constexpr double kStridePower = 256.0;
/// Of the variance that is seen: below it is the curve that is seen.
constexpr double kLeastPart = 0.75;

/// Residual of the middle of five points from the cubic through the others, in units of the
/// deviation of one point; nothing where they do not advance along their chord.
std::optional<double> residual(const std::array<Vec2, 5>& p) {
  const Vec2 chord = p[4] - p[0];
  const double length = norm(chord);
  if (!(length > 0.0)) return std::nullopt;
  const Vec2 along = (1.0 / length) * chord, across = left_normal(along);
  std::array<double, 5> u{};
  for (std::size_t k = 0; k < 5; ++k) {
    u[k] = dot(p[k] - p[2], along);
    if (k > 0 && !(u[k] > u[k - 1])) return std::nullopt;
  }
  double miss = 0.0, variance = 1.0;
  for (const std::size_t k : kOthers) {
    double weight = 1.0;
    for (const std::size_t j : kOthers) {
      if (j != k) weight *= -u[j] / (u[k] - u[j]);
    }
    miss -= weight * dot(p[k] - p[2], across);
    variance += weight * weight;
  }
  return std::abs(miss) / std::sqrt(variance);
}

struct Seen {
  double deviation = 0.0;
  std::size_t places = 0;
};

Seen seen_at(const std::vector<Vec2>& p, std::size_t stride) {
  std::vector<double> residuals;
  for (std::size_t i = 2 * stride; i + 2 * stride < p.size(); ++i) {
    const auto one =
        residual({p[i - 2 * stride], p[i - stride], p[i], p[i + stride], p[i + 2 * stride]});
    if (one) residuals.push_back(*one);
  }
  if (residuals.empty()) return {};
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return {kNormalPerMedian * *middle, residuals.size()};
}

}  // namespace

Result<Scatter> scatter_of(const std::vector<Vec2>& points) {
  const Seen near = seen_at(points, 1), far = seen_at(points, 2);
  if (near.places < kLeastPlaces || far.places < kLeastPlaces / 2) {
    return error(ErrorCode::kTooFewPoints, "too few points to estimate their noise from")
        .hint("say how far they may move")
        .value(static_cast<double>(near.places));
  }
  const double seen = near.deviation * near.deviation;
  const double own = (kStridePower * seen - far.deviation * far.deviation) / (kStridePower - 1.0);
  if (!(own > kLeastPart * seen)) {
    return error(ErrorCode::kNothingThere,
                 "the points show their curve and no noise that can be told from it")
        .hint("say how far they may move, or leave the noise out where they are exact");
  }
  Scatter out;
  out.deviation = std::sqrt(own);
  out.places = near.places;
  const double count = static_cast<double>(points.size());
  out.bound_factor = std::sqrt(2.0 * std::log(count / kExceeded));
  out.bound = out.bound_factor * out.deviation;
  return out;
}

}  // namespace obvid
