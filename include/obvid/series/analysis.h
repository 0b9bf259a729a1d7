// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// Size of a series, units: squares and cubes of lengths beyond would leave the range of doubles.
inline constexpr double kSmallestSeries = 1e-100;
inline constexpr double kLargestSeries = 1e100;

/// Diagonal of the points' bounding box; 0 without points.
[[nodiscard]] double bounding_diagonal(const std::vector<Vec2>& points);

/// A chord of the series, from point i to point i + 1.
struct Chord {
  double length = 0.0;
  double omega = 0.0;  ///< heading, rad, unwrapped along the series
};

/// Circle through point i and both neighbours ([000]: adjacent circle). At the two ends the
/// circle of the inner neighbour is taken over.
struct AdjacentCircle {
  double kappa = 0.0;     ///< signed curvature, 1/unit; 0 for three points in line
  double eta_in = 0.0;    ///< angle from the chord before to the circle's tangent at the point, rad
  double eta_out = 0.0;   ///< angle from the circle's tangent at the point to the chord after, rad
  double rounding = 0.0;  ///< how far half an ulp in each coordinate can move `kappa`
};

/// Points first..last (both included, at least 4, or the whole series of 3 or 2) that lie on one
/// circle or line within the rounding of their coordinates.
struct CircularStretch {
  std::size_t first = 0;
  std::size_t last = 0;
  double kappa = 0.0;  ///< 0 for a line
};

/// Maximal part of the series whose adjacent circles change one way. Chords that rounding decides
/// belong to the run before them, those at the beginning to the first one.
struct SeriesRun {
  std::size_t first_chord = 0;
  std::size_t last_chord = 0;
  int direction = 0;  ///< +1 curvature increases, -1 decreases, 0 constant (one circle or line)
};

/// What the points alone say about any fair curve through them (docs/methods/series.md).
struct Analysis {
  std::vector<Chord> chords;               ///< n - 1
  std::vector<AdjacentCircle> circles;     ///< n
  std::vector<std::int8_t> direction;      ///< n - 1: what a contour begins with: +1, -1, or 0
                                           ///< inside a circular stretch
  std::vector<std::optional<int>> change;  ///< n - 1: how the adjacent circles change, +1, -1, or 0
                                           ///< on one circle; none where rounding decides
  std::vector<double> points_only_error;   ///< n - 1; NaN where it is not defined: on the first
                                           ///< and last chord, beside a vertex and where the points
                                           ///< turn by half a turn or more
  std::vector<SeriesRun> runs;             ///< of `change`; none where rounding decides every chord
  std::vector<CircularStretch> stretches;
  int vertices = 0;              ///< changes of direction between runs, or what is forced if more
  int vertices_lower_bound = 0;  ///< what the points force (forced_vertices.h)
  int inflections = 0;  ///< sign changes of the adjacent curvatures, as rounding leaves them
  int inflections_lower_bound = 0;
  std::vector<std::size_t> rounding_decided;  ///< chords whose direction lies within coordinate
                                              ///< rounding, ascending
  double size = 0.0;                          ///< diagonal of the bounding box
  double largest_turning = 0.0;               ///< between neighbouring chords, rad
};

/// Analyses distinct points (no two neighbours equal, at least 2).
/// Errors: E309 when the size leaves [1e-100, 1e100]; E402 where the series turns back by 170
/// degrees or more, naming the point. Cost O(n).
[[nodiscard]] Result<Analysis> analyse(const std::vector<Vec2>& points);

/// The same where neighbouring chords may turn by anything short of half a turn: points inserted
/// beside a sharp bend. What such a bend says of the curve there is that of its circle. Points on
/// both sides of a point must differ. Error: E309. Cost O(n).
[[nodiscard]] Result<Analysis> measure_series(const std::vector<Vec2>& points);

/// Largest distance between two curves of monotone curvature through the chord's ends and their
/// neighbours that turn by less than half a turn there: between both adjacent circles, rounded
/// upward. NaN on the first and last chord, and where the points themselves turn by half a turn.
[[nodiscard]] double four_point_error(const Analysis& analysis, std::size_t chord);

/// Chords and adjacent circles alone, for distinct points (at least 2). Cost O(n).
[[nodiscard]] std::vector<Chord> measure_chords(const std::vector<Vec2>& points);
[[nodiscard]] std::vector<AdjacentCircle> measure_circles(const std::vector<Vec2>& points,
                                                          const std::vector<Chord>& chords);

/// Turning of the polyline at a point, rad; NaN at the two ends.
[[nodiscard]] double turning_at(const Analysis& analysis, std::size_t point);

/// Height of a circle of curvature `kappa` above its chord of length `h` (the sagitta, `kappa h^2/4
/// / (1 + sqrt(1 - (kappa h/2)^2))`).
[[nodiscard]] double sagitta(double kappa, double h);

}  // namespace obvid
