// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "../common/plane_curves.h"
#include "obvid/fairing/internal/fairing.h"

namespace obvid::test {

inline FairedSeries faired(const MeasuredSeries& series) {
  Watch nobody;
  return fair(series, nobody);
}

inline MeasuredSeries measured(std::vector<Vec2> points, double reach, bool closed = false) {
  MeasuredSeries series;
  series.reach.assign(points.size(), reach);
  series.points = std::move(points);
  series.closed = closed;
  return series;
}

/// Whether a spiral exists between two elements (Kurnosenko's A, B and Q, and Vogt's sigma > 0
/// which they do not imply), from their numbers alone.
inline bool spiral_exists(const Element& a, const Element& b, int direction) {
  const Vec2 chord = b.point - a.point;
  const double h = norm(chord), omega = std::atan2(chord.y, chord.x);
  const double alpha = std::remainder(a.theta - omega, kTurn);
  const double beta = std::remainder(b.theta - omega, kTurn);
  const double A = direction * (0.5 * a.kappa * h + std::sin(alpha));
  const double B = direction * (0.5 * b.kappa * h - std::sin(beta));
  const double half = std::sin(0.5 * (alpha + beta));
  return A < 0.0 && B > 0.0 && direction * (alpha + beta) > 0.0 && A * B + half * half < 0.0;
}

}  // namespace obvid::test
