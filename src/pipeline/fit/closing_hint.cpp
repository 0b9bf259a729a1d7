// SPDX-License-Identifier: Apache-2.0
#include "fit/closing_hint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "obvid/core/internal/figures.h"
#include "obvid/numeric/internal/median.h"

namespace obvid::pipeline_detail {

std::optional<std::string> hint_at_closing(const std::vector<Vec2>& points, const Units& units) {
  constexpr double kMayClose = 2.0;      // middle chords
  constexpr double kOfLength = 0.025;    // of the whole
  constexpr double kLeastLength = 10.0;  // of the whole, gaps
  constexpr double kPercent = 100.0;
  constexpr double kGoesOn = std::numbers::pi / 3;  // at either end, rad
  // a tip: a step like the others, and a turn at one end that is none of a trailing edge, rad
  constexpr double kLeastOfStep = 0.5, kSharpest = 25.0 / 36.0 * std::numbers::pi;
  if (points.size() < 4) return std::nullopt;
  const Vec2 gap = points.front() - points.back();
  const Vec2 first = points[1] - points.front();
  const Vec2 last = points.back() - points[points.size() - 2];
  std::vector<double> lengths;
  for (std::size_t i = 1; i < points.size(); ++i) {
    lengths.push_back(norm(points[i] - points[i - 1]));
  }
  const double apart = norm(gap), length = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  const double step = median_of(lengths);
  const bool near = apart <= kMayClose * step, in_length = apart <= kOfLength * length;
  if ((!near && !in_length) || length < kLeastLength * apart) return std::nullopt;
  const double before = std::abs(turning(last, gap)), behind = std::abs(turning(gap, first));
  const bool goes_on = std::max(before, behind) <= kGoesOn;
  const bool at_tip = std::min(before, behind) <= kGoesOn &&
                      std::max(before, behind) <= kSharpest && near && in_length &&
                      apart >= kLeastOfStep * step;
  if (!goes_on && !at_tip) return std::nullopt;
  return fmt::format(
      "the ends are {:.4g} {} apart, {}, and the curve would go on there{}: --closed closes it, "
      "--open says that it ends",
      apart, units.text(),
      near ? "hardly farther than neighbours"
           : fmt::format("{} % of its length", significant(kPercent * apart / length, 2)),
      goes_on ? "" : ", around a tip");
}

}  // namespace obvid::pipeline_detail
