// SPDX-License-Identifier: Apache-2.0
// The other direction of a tensor product, while one is approximated.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "approximate_line.h"

namespace obvid {

/// Mixes of the points of a row, by shares that are not negative and sum to 1. Points of a row are
/// coefficients of splines in the other direction; the mixes are places of these, or control points
/// of their Bezier pieces: no place is farther from 0 than the farthest of those.
class RowHull {
 public:
  /// Adds a spline whose coefficients are the next points of the row: so many places of each span.
  void add_places(int degree, const std::vector<double>& knots, std::size_t per_span);
  /// The same: control points of so many pieces of each span.
  void add_pieces(int degree, const std::vector<double>& knots, std::size_t per_span);
  /// Adds points that stand for themselves.
  void add_points(std::size_t count);

  /// Square of the length of the longest mix, of points as x y z one after the other. Where no
  /// point is longer than `negligible`, neither is a mix: then that of the longest point.
  [[nodiscard]] double longest_squared(const double* row, double negligible = 0.0) const;

 private:
  struct Mix {
    std::size_t first = 0, count = 0;  ///< points of the row
    std::array<double, kMostLineDegree + 1> share{};
  };
  std::size_t width_ = 0;
  std::vector<Mix> mixes_;
};

/// The other direction as errors see it: places to look at, and hulls for bounds, of which the
/// closer one costs more.
struct OtherWay {
  RowHull places, hull, close_hull;

  void add(int degree, const std::vector<double>& knots) {
    constexpr std::size_t kPlaces = 3, kClosePieces = 4;  // of a span
    places.add_places(degree, knots, kPlaces);
    hull.add_pieces(degree, knots, 1);
    close_hull.add_pieces(degree, knots, kClosePieces);
  }
};

}  // namespace obvid
