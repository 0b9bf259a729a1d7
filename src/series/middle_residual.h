// SPDX-License-Identifier: Apache-2.0
// How far points lie off the curve of their neighbours (docs/methods/series.md).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "obvid/geom/internal/chord.h"
#include "obvid/geom/vec2.h"
#include "obvid/numeric/internal/median.h"
#include "obvid/numeric/internal/wide.h"

namespace obvid {

struct MiddleResidual {
  double off = 0.0;       ///< across their chord, units; of a point that is not between its
                          ///< neighbours along it from the line between them
  double variance = 1.0;  ///< that it has where each point's is 1
  bool between = true;    ///< along the chord

  [[nodiscard]] double in_deviations() const { return off / std::sqrt(variance); }
};

/// Of the middle of five points from the cubic through the others; nothing where these do not
/// advance along their chord. Points of a curve that is no more than rounded are off by the last
/// digits of their coordinates; these are kept.
inline std::optional<MiddleResidual> middle_residual(const std::array<Vec2, 5>& p) {
  constexpr std::array<std::size_t, 4> kOthers = {0, 1, 3, 4};
  const Vec2 chord = p[4] - p[0];
  const double length = norm(chord);
  if (!(length > 0.0)) return std::nullopt;
  const Vec2 along = (1.0 / length) * chord, across = left_normal(along);
  const auto part_of = [&](std::size_t k, Vec2 direction) {
    const auto from = [](double a, double b) { return numeric::Wide(b) - numeric::Wide(a); };
    return from(p[2].x, p[k].x) * direction.x + from(p[2].y, p[k].y) * direction.y;
  };
  const numeric::Wide zero;
  std::array<numeric::Wide, 5> u{};
  for (std::size_t k = 0; k < 5; ++k) u[k] = part_of(k, along);
  if (!(u[0] < u[1] && u[1] < u[3] && u[3] < u[4])) return std::nullopt;
  MiddleResidual out;
  out.between = u[1] < zero && zero < u[3];
  if (!out.between) {
    out.off = distance_from_chord(p[2], p[1], p[3]);
    return out;
  }
  numeric::Wide miss;
  for (const std::size_t k : kOthers) {
    numeric::Wide weight(1.0);
    for (const std::size_t j : kOthers) {
      if (j != k) weight *= -u[j] / (u[k] - u[j]);
    }
    miss -= weight * part_of(k, across);
    out.variance += static_cast<double>(weight) * static_cast<double>(weight);
  }
  out.off = std::abs(static_cast<double>(miss));
  return out;
}

/// The same from the cubic through the four over the lengths of their chords, which goes around a
/// nose where one over a straight line does not: distance of the middle point from it between its
/// neighbours. Nothing where neighbours are one point.
inline std::optional<MiddleResidual> residual_along_way(const std::array<Vec2, 5>& p) {
  constexpr std::size_t kOthers = 4;
  constexpr int kLooks = 16, kHalvings = 40;
  const std::array<Vec2, kOthers> q = {p[0] - p[2], p[1] - p[2], p[3] - p[2], p[4] - p[2]};
  std::array<double, kOthers> t{};
  for (std::size_t k = 1; k < kOthers; ++k) {
    t[k] = t[k - 1] + norm(q[k] - q[k - 1]);
    if (!(t[k] > t[k - 1])) return std::nullopt;
  }
  const auto at = [&](double u) {
    MiddleResidual out;
    Vec2 here{};
    for (std::size_t k = 0; k < kOthers; ++k) {
      double weight = 1.0;
      for (std::size_t j = 0; j < kOthers; ++j) {
        if (j != k) weight *= (u - t[j]) / (t[k] - t[j]);
      }
      here = here + weight * q[k];
      out.variance += weight * weight;
    }
    out.off = norm(here);
    return out;
  };
  double step = (t[2] - t[1]) / kLooks, nearest = t[1];
  for (int k = 1; k <= kLooks; ++k) {
    if (at(t[1] + k * step).off < at(nearest).off) nearest = t[1] + k * step;
  }
  for (int k = 0; k < kHalvings; ++k, step *= 0.5) {
    const double here = nearest;
    for (const double u : {here - 0.5 * step, here + 0.5 * step}) {
      if (u >= t[1] && u <= t[2] && at(u).off < at(nearest).off) nearest = u;
    }
  }
  return at(nearest);
}

/// Standard deviation of normal errors from their sizes, by the median; `sizes` is not empty.
inline double deviation_of(std::vector<double> sizes) {
  constexpr double kNormalPerMedian = 1.4826022185056018;  // 1 / inverse normal of 3/4
  return kNormalPerMedian * median_of(std::move(sizes));
}

/// Deviations that none of so many normal errors exceeds, 95 times of 100:
/// P(|z| > k) <= exp(-k^2/2), once for each.
inline double bound_factor(std::size_t count) {
  constexpr double kExceeded = 0.05;
  return std::sqrt(2.0 * std::log(static_cast<double>(count) / kExceeded));
}

}  // namespace obvid
