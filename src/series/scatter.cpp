// SPDX-License-Identifier: Apache-2.0
// Derivation: docs/methods/series.md.
#include "obvid/series/internal/scatter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "middle_residual.h"

namespace obvid {
namespace {

constexpr std::size_t kLeastPlaces = 20;
/// Residuals of every second point hold the curve's part 16 times, its square 256 times.
constexpr double kStridePower = 256.0;
/// Of the variance that is seen: below it is the curve that is seen.
constexpr double kLeastPart = 0.75;

struct Seen {
  double deviation = 0.0;
  std::size_t places = 0;
};

Seen seen_at(const std::vector<Vec2>& p, std::size_t stride) {
  std::vector<double> residuals;
  for (std::size_t i = 2 * stride; i + 2 * stride < p.size(); ++i) {
    const auto one =
        middle_residual({p[i - 2 * stride], p[i - stride], p[i], p[i + stride], p[i + 2 * stride]});
    if (one && one->between) residuals.push_back(one->in_deviations());
  }
  if (residuals.empty()) return {};
  const std::size_t places = residuals.size();
  return {deviation_of(std::move(residuals)), places};
}

}  // namespace

std::optional<double> middle_deviation(const std::vector<Vec2>& points) {
  const Seen near = seen_at(points, 1);
  return near.places < kLeastPlaces ? std::nullopt : std::optional(near.deviation);
}

Result<Scatter> scatter_of(const std::vector<Vec2>& points) {
  const Seen near = seen_at(points, 1), far = seen_at(points, 2);
  const bool few = near.places < kLeastPlaces || far.places < kLeastPlaces / 2;
  constexpr std::size_t kBeside = 2;  // on each side of a place
  if (few && points.size() >= kLeastPlaces + 2 * kBeside * 2) {
    return error(ErrorCode::kTooFewPoints,
                 "too few points lie between those before and behind them in the list to estimate "
                 "their noise from")
        .hint(
            "say how far they may move; --unordered puts points in no order in that of their "
            "curve")
        .value(static_cast<double>(near.places));
  }
  if (few) {
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
  out.bound_factor = bound_factor(points.size());
  out.bound = out.bound_factor * out.deviation;
  return out;
}

}  // namespace obvid
