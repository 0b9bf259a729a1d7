// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "section_curve.h"

namespace obvid {

/// What the breaks have to achieve.
struct BreakGoals {
  double tolerance = 0.0;  ///< units: largest distance from the contours
};

/// Plane curvature of a curve as seen along the normal of a section's plane.
[[nodiscard]] double plane_curvature(const Hermite& at, const Frame& frame);

/// What rounding makes of the curvature of a skin at a place of a section, `span` parameters of
/// which are a span of the skin. 0 where the section stands still.
[[nodiscard]] double curvature_rounding(const Hermite& at, double span,
                                        const SectionCurve& section);

/// The fewest breaks (found by halving) at which splines of degree 5 that take over two derivatives
/// of every section follow all of them within the tolerance and keep their curvature: to a tenth of
/// its change over a span, or `kKept` of itself, and changing one way where it does so on the
/// contour. Halving prefers the common marks; for curvature alone it ends at 2^8 parts between two
/// marks. Errors: E502 when the tolerance is not reached with 2^10 parts; E103.
[[nodiscard]] Result<std::vector<double>> breaks_for(const std::vector<SectionCurve>& sections,
                                                     const std::vector<double>& marks,
                                                     const BreakGoals& goals,
                                                     const RunContext& run);

}  // namespace obvid
