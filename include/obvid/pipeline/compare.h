// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/run_context.h"
#include "obvid/picture/picture_svg.h"
#include "obvid/pipeline/fit.h"

namespace obvid {

/// One carrier of a comparison: what `fit` makes and says of it, and some more.
struct ComparedCarrier {
  Carrier carrier = Carrier::kSpiral;
  std::optional<Error>
      refusal;  ///< why there is no contour of this carrier; the rest is empty then
  Fit fit;
  std::size_t control_points = 0;  ///< of the contour as NURBS curves with the fewest inner knots;
                                   ///< 0 where a piece is none (clothoids)
  int continuity = 0;  ///< 0 position, 1 heading, 2 curvature, 3 its slope at every joint (corners
                       ///< apart)
  Continuity followed =
      Continuity::kG2;   ///< of the spirals that it follows and is measured against
  double seconds = 0.0;  ///< one call of `fit`, median of several
};

/// All carriers through the same points with the same constraints; the spirals come first.
struct Comparison {
  std::vector<ComparedCarrier> carriers;
};

/// Forms the contour with each carrier. With `continuity` G3 the spirals have continuous slopes of
/// the curvature and the others follow these; one that cannot, or has more vertices so, follows the
/// G2 spirals if that is better. A carrier that cannot do it is a row with a refusal. Error
/// bounds and distances from the spirals are those of `Fit::report`.
/// When the work is cancelled (E103), `finished` takes the carriers that were done by then.
/// Errors: those of `fit` with spirals. Cost: a few calls of `fit` for each carrier, at least.
[[nodiscard]] Result<Comparison> compare_carriers(const PointSeries& series, const FitJob& job,
                                                  const RunContext& run = {},
                                                  Comparison* finished = nullptr);

/// "G2": continuity of all joints.
[[nodiscard]] std::string continuity_name(const ComparedCarrier& row);

/// A picture of all carriers side by side, each with its curvature.
[[nodiscard]] std::string comparison_svg(const PointSeries& series, const Comparison& compared,
                                         const ShownCurvatures& shown = {});

/// Control points of the contour as NURBS curves: neighbouring pieces of one kind share knots as
/// far as the carrier is continuous in its parameter (B-splines), else their end points. 0 when a
/// piece is a clothoid, which is no NURBS curve.
[[nodiscard]] std::size_t control_points(const Contour& contour);

}  // namespace obvid
