// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// A place on a curve.
struct CurveSample {
  Vec2 point;
  double s = 0.0;      ///< arc length from the start, units
  double theta = 0.0;  ///< heading, rad, unwrapped along the curve
  double kappa = 0.0;  ///< signed curvature, 1/unit
};

/// How densely a curve is sampled: one of the three, else by the chord tolerance 1e-4 of its
/// length.
struct SampleOptions {
  std::optional<std::size_t> count;  ///< so many, at equal arc lengths, both ends included
  std::optional<double> step;        ///< arc length from one to the next; the last may be shorter
  std::optional<double> chord_tolerance;  ///< distance of a chord from the curve, units
};

/// Samples along connected pieces. By chord tolerance the ends of all pieces are among them, and a
/// corner stands twice: with the heading and curvature before it and after it.
/// Errors: E203 options that are not positive, or more than ten million samples; E311 no pieces;
/// under watch, here and below, E103.
[[nodiscard]] Result<std::vector<CurveSample>> sample(std::span<const Piece> pieces,
                                                      const SampleOptions& options,
                                                      Watch* watch = nullptr);

/// Places along connected pieces, each heading near the one before. Errors: E203 beyond the curve;
/// E311 no pieces. Cost O(pieces) and some microseconds for each place.
[[nodiscard]] Result<std::vector<CurveSample>> sample_at_lengths(std::span<const Piece> pieces,
                                                                 std::span<const double> lengths);
/// The same for parameters: 2.5 is the middle of the third piece, by its own parameter.
[[nodiscard]] Result<std::vector<CurveSample>> sample_at_parameters(
    std::span<const Piece> pieces, std::span<const double> parameters);

/// Columns `s_mm,x_mm,y_mm,heading_deg,curvature_1_per_mm,normal_x,normal_y` (the unit is the
/// contour's; without it, `s,x,y,...,curvature,...`, when that is merely assumed; the normal is the
/// left one). `parse_points` knows samples by these names. Numbers read back to the same doubles.
[[nodiscard]] Result<std::string> samples_csv(const Contour& contour, const SampleOptions& options,
                                              Watch* watch = nullptr);

/// Wavefront OBJ: vertices and one polyline, closed for closed contours.
[[nodiscard]] Result<std::string> obj_text(const Contour& contour, const SampleOptions& options,
                                           Watch* watch = nullptr);

/// PLY (ASCII): vertices and edges.
[[nodiscard]] Result<std::string> ply_text(const Contour& contour, const SampleOptions& options,
                                           Watch* watch = nullptr);

}  // namespace obvid
