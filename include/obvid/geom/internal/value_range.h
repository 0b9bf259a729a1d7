// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "obvid/geom/internal/angle.h"

namespace obvid {

/// Ends between which a heading or a curvature may lie, both included; an end that is none is
/// infinite.
struct ValueRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool empty() const { return !(low <= high); }
  bool operator==(const ValueRange&) const = default;
};

/// What lies in both; empty when nothing does.
[[nodiscard]] inline ValueRange common(const ValueRange& a, const ValueRange& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

/// The angle of the same direction as `theta` that lies nearest to the middle of a range, rad.
[[nodiscard]] inline double turned_to(const ValueRange& thetas, double theta) {
  return nearest_angle(theta, 0.5 * (thetas.low + thetas.high));
}

/// The range of the same headings whose middle lies nearest to an angle, rad.
[[nodiscard]] inline ValueRange turned_near(const ValueRange& thetas, double near) {
  const double middle = 0.5 * (thetas.low + thetas.high);
  const double turns = nearest_angle(middle, near) - middle;
  return {thetas.low + turns, thetas.high + turns};
}

/// Headings in both ranges, rad, on a turn of `a`: headings count modulo a full turn. Empty when
/// there are none; nothing where two ranges apart from each other are left.
[[nodiscard]] inline std::optional<ValueRange> common_headings(const ValueRange& a,
                                                               const ValueRange& b) {
  if (b.high - b.low >= kFullTurn) return a;
  if (a.high - a.low >= kFullTurn) return b;
  const ValueRange near = turned_near(b, 0.5 * (a.low + a.high));
  ValueRange found{1.0, 0.0};
  for (const double turn : {-kFullTurn, 0.0, kFullTurn}) {
    const ValueRange both = common(a, {near.low + turn, near.high + turn});
    if (both.empty()) continue;
    if (!found.empty()) return std::nullopt;
    found = both;
  }
  return found;
}

/// Curvatures of a range of radii, both ends of one sign: `20..30` is 1/30..1/20, `20..` (a large
/// arc, or a line) is 0..1/20, `..30` is everything that turns left at least as sharply as 1/30;
/// `..-20` and `-30..` are the same to the right. Nothing where the range is empty, or where its
/// ends are finite and of two signs.
[[nodiscard]] inline std::optional<ValueRange> curvatures_of_radii(const ValueRange& radii) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double low = radii.low, high = radii.high;
  if (radii.empty() || (low == -kNone && high == kNone)) return std::nullopt;
  if (low >= 0.0 || (low == -kNone && high > 0.0)) {  // to the left
    return ValueRange{high == kNone ? 0.0
                      : high == 0.0 ? kNone
                                    : 1.0 / high,
                      low > 0.0 ? 1.0 / low : kNone};
  }
  if (high <= 0.0 || (high == kNone && low < 0.0)) {
    return ValueRange{high < 0.0 ? 1.0 / high : -kNone, low == -kNone ? 0.0 : 1.0 / low};
  }
  return std::nullopt;
}

}  // namespace obvid
