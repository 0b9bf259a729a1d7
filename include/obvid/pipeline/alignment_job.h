// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>

#include "obvid/alignment/alignment.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/element_table.h"
#include "obvid/report/stored_contour.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// What an alignment of points is to be.
struct AlignmentJob {
  std::optional<double> noise{};  ///< how far the alignment may pass a point, units; nothing: half
                                  ///< a unit of the last printed digit. Points with a tolerance of
                                  ///< their own keep that
  double least_length = 0.0;      ///< of each element, units; 0: a quarter of the points' distance
  double least_radius = 0.0;      ///< of each place, units; 0: any
  double first_station = 0.0;     ///< of the first point, units
  std::optional<double> acceleration{};  ///< to the side, m/s^2: what limits the speed
};

/// Lines, arcs and clothoids through points, with what is to be said of them.
struct AlignmentReport {
  std::string name;
  Units units;
  double tolerance = 0.0;  ///< largest of all points, units
  Alignment alignment;
  std::optional<SpeedLimit> limit;  ///< where an acceleration was given
  StoredContour stored;  ///< the same as a contour, each element a piece, with its certificate
};

/// The fewest lines, arcs and clothoids found (`fit_alignment`) within the tolerances of a series.
/// Reentrant. Errors: those of `fit_alignment`; E203 a tolerance that is not a positive length, or
/// none where the points have no printed digits, an acceleration that is not positive, or one
/// beside a unit that is no length.
[[nodiscard]] Result<AlignmentReport> alignment_report(const PointSeries& series,
                                                       const AlignmentJob& job,
                                                       const RunContext& run = {});

/// Station, offset (to the left positive) and coordinates of each point.
[[nodiscard]] std::string deviations_csv(const AlignmentReport& report,
                                         const std::vector<Vec2>& points);
/// All figures; angles in rad, lengths in units, curvatures in 1/unit.
[[nodiscard]] std::string alignment_json(const AlignmentReport& report);

}  // namespace obvid
