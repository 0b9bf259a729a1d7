// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace obvid::test
