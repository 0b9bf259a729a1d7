// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>

#include "obvid/alignment/alignment.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/report/stored_contour.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// What an alignment of points is to be.
struct AlignmentJob {
  std::optional<double> noise{};  ///< how far the alignment may pass a point, units; nothing: half
                                  ///< a unit of the last printed digit. Points with a tolerance of
                                  ///< their own keep that
};

/// Lines, arcs and clothoids through points, with what is to be said of them.
struct AlignmentReport {
  std::string name;
  Units units;
  double tolerance = 0.0;  ///< largest of all points, units
  Alignment alignment;
  StoredContour stored;  ///< the same as a contour, each element a piece, with its certificate
};

/// The fewest lines, arcs and clothoids found (`fit_alignment`) within the tolerances of a series.
/// Reentrant. Errors: those of `fit_alignment`; E203 a tolerance that is not a positive length, or
/// none where the points have no printed digits.
[[nodiscard]] Result<AlignmentReport> alignment_report(const PointSeries& series,
                                                       const AlignmentJob& job,
                                                       const RunContext& run = {});

/// All figures; angles in rad, lengths in units, curvatures in 1/unit.
[[nodiscard]] std::string alignment_json(const AlignmentReport& report);
/// The table of elements: kind, station, length, radii, clothoid parameter, azimuth, coordinates.
[[nodiscard]] std::string alignment_csv(const AlignmentReport& report);

/// "line", "arc", "clothoid".
[[nodiscard]] const char* to_string(AlignmentKind kind);
/// Parameter of a clothoid, sqrt(length / |change of curvature|), units; 0 of other elements.
[[nodiscard]] double clothoid_parameter(const AlignmentElement& element);
/// Clockwise from the direction of y, degrees in [0, 360): what surveyors call the azimuth.
[[nodiscard]] double azimuth_deg(double theta);
/// How often the curvature steps from one element to the next.
[[nodiscard]] std::size_t curvature_steps(const Alignment& alignment);

}  // namespace obvid
