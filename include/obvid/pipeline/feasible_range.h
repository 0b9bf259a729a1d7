// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>

#include "obvid/core/run_context.h"
#include "obvid/pipeline/fit.h"

namespace obvid {

/// A heading or curvature that the user fixed and that stands in the way, and what would do in its
/// place while all else stays.
struct FeasibleRange {
  enum class Datum { kHeading, kCurvature };
  std::size_t point = 0;  ///< index into the points of the series
  Datum datum = Datum::kHeading;
  double asked = 0.0;  ///< rad or 1/unit
  /// With each of the two `fit` forms and proves a contour; equal where it does in the middle of
  /// the range alone.
  double least = 0.0, greatest = 0.0;
  /// The range is that of the theory (`feasible_data`), rounded inwards: every value between does,
  /// and nothing beyond by more than a hundredth. False: found by trials, and those between were
  /// not all tried.
  bool exact = false;
};

/// For a job that `fit` refuses because given data contradict the points or each other (E403): the
/// first heading or curvature, from the refused place outwards, that a contour allows when it alone
/// is freed, and how far it may go on both sides: in closed form for an open series whose points
/// are met and that has no corners, else by steps and bisection to a hundredth of the range;
/// rounded inwards. Headings go at most half a turn from the asked one. Nothing when more than one
/// datum is in the way, when a series of 1,000 points or more has no such closed form, when nothing
/// is fixed, or when the search ends at its limit of work before that.
[[nodiscard]] std::optional<FeasibleRange> feasible_range(const PointSeries& series,
                                                          const FitJob& job, const Error& refusal,
                                                          const RunContext& run = {});

}  // namespace obvid
