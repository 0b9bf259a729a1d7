// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "obvid/series/point_series.h"

namespace obvid {

/// What counts as a corner when nobody says otherwise, rad (docs/methods/series.md).
inline constexpr double kDefaultCornerAngle = std::numbers::pi / 9.0;

/// Which corners are asked for.
struct CornerConstraints {
  bool find = true;                    ///< search them; else only those that are marked
  double angle = kDefaultCornerAngle;  ///< rad, least turn of a corner that is searched
  bool exact = false;                  ///< points are met: it turns by that between its neighbours
};

/// Whether the last point is the first one again, within the tolerances of both.
[[nodiscard]] bool returns_to_start(const std::vector<Vec2>& points, double tolerance_of_first,
                                    double tolerance_of_last);

/// One point for two that stand for the same place. Whatever lies within `tolerance` of it lies
/// within the own tolerance of each of the two.
struct JoinedPoint {
  Vec2 point;
  double tolerance = 0.0;
};

/// For points no farther from each other than the sum of their tolerances.
[[nodiscard]] JoinedPoint join_points(Vec2 a, double tolerance_a, Vec2 b, double tolerance_b);

/// Indices of the corners, ascending: where the series turns at once, by more than its smooth
/// neighbourhood explains, and every point marked in `fixed`. An open series has none at its ends.
/// `tolerance` says how far each point may lie from where it belongs (printed rounding, noise);
/// empty means exactly there. `fixed` is empty or has one entry per point. A closed series does
/// not repeat its first point. Cost O(n log m), m points within the reach of the noise.
[[nodiscard]] std::vector<std::size_t> find_corners(const std::vector<Vec2>& points,
                                                    const std::vector<double>& tolerance,
                                                    bool closed,
                                                    const std::vector<FixedData>& fixed,
                                                    const CornerConstraints& constraints);

/// Part of a series between two corners or ends: places first..last of `SplitSeries::order`, both
/// included. In a closed series `last` may be the number of points: its first place again.
struct Section {
  std::size_t first = 0;
  std::size_t last = 0;

  friend constexpr bool operator==(const Section& a, const Section& b) = default;
};

/// A series cut at its corners.
struct SplitSeries {
  std::vector<std::size_t> order;  ///< original index of the point at each place
  std::vector<Section> sections;   ///< in order; neighbours share their corner
  bool smooth_loop = false;        ///< closed without a corner: one section, seam at place 0

  /// Original index of the point at a place that a section names.
  [[nodiscard]] std::size_t point_at(std::size_t place) const {
    return order[place < order.size() ? place : 0];
  }
};

/// Cuts `count` points at `corners` (ascending). A closed series with corners is turned so that it
/// begins at the first of them.
[[nodiscard]] SplitSeries split_sections(std::size_t count, const std::vector<std::size_t>& corners,
                                         bool closed);

}  // namespace obvid
