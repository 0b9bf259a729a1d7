// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "obvid/core/progress.h"
#include "obvid/pipeline/fit.h"

namespace obvid {

/// A heading or curvature that the user fixed and that stands in the way, and what would do in its
/// place while all else stays.
struct FeasibleRange {
  enum class Datum { kHeading, kCurvature };
  std::size_t point = 0;  ///< index into the points of the series
  Datum datum = Datum::kHeading;
  double asked = 0.0;  ///< rad or 1/unit
  /// With each of the two `fit` forms and proves a contour; values between were not all tried.
  double least = 0.0, greatest = 0.0;
};

/// For a job that `fit` refuses because given data contradict the points or each other (E403): the
/// first heading or curvature, from the refused place outwards, that a contour allows when it alone
/// is freed, and how far it may go on both sides: found by steps and bisection to a hundredth of
/// the range, rounded inwards. Headings go at most half a turn from the asked one. Nothing when
/// more than one datum is in the way, when nothing is fixed, or when the search ends at its limit
/// of work before that.
[[nodiscard]] std::optional<FeasibleRange> feasible_range(const PointSeries& series,
                                                          const FitJob& job, const Error& refusal,
                                                          const Progress& progress = {});

}  // namespace obvid
