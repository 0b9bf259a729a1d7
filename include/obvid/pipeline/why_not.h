// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/run_context.h"
#include "obvid/pipeline/fit.h"

namespace obvid {

/// How far the points of a refused job would have to move for its contour to exist.
struct WhyNot {
  Error refusal;           ///< what `fit` says to the job as it was asked
  bool found = false;      ///< whether a tolerance that does was found
  bool stopped = false;    ///< the search ended at its limit of work, not because it was done
  double tolerance = 0.0;  ///< units, of three digits: `fit` with it as noise keeps all promises
  bool next_to_nothing = false;  ///< `tolerance` is the least that is tried (1e-9 of the size, or
                                 ///< the rounding): it is not the points that are in the way, but
                                 ///< the vertices that exact points do not allow
  bool rounding_does = false;    ///< `tolerance` is below the rounding of the file's digits, within
                                 ///< which `fit` keeps all promises too (`noise_from_rounding`)
  double advised = 0.0;  ///< units: `tolerance`; where it is next to nothing the width that the
                         ///< region may have, or a tenth, a hundredth of it, whatever does first
  double refused = 0.0;  ///< largest smaller tolerance that was tried in vain; 0: none was
  Fit fit;               ///< the contour that the advice leads to, when one was found
  std::vector<std::size_t> moved;  ///< the points that `fit` moves, the farthest first; how far:
                                   ///< `fit.report.moves`
};

/// The largest tolerance that `why_not` tries, units: a tenth of the diagonal of the points, of
/// three digits.
[[nodiscard]] double largest_tolerance_tried(const PointSeries& series);

/// For a job that `fit` refuses because no such contour exists (E401 to E405): the smallest
/// tolerance, the same for all points, within which one does, every demand of the job kept. Points
/// with larger tolerances of their own keep those; an open series stays open. Found by long steps
/// and bisection, to 2 %; between the tolerances that were tried feasibility is taken as
/// monotone. The search ends after some 15 calls of `fit`, or earlier after a number of steps that
/// grows with the points: then it says what it knows. Nothing when `fit` does not refuse, refuses
/// for another reason, or when moves of a tenth of the size do not help either.
[[nodiscard]] std::optional<WhyNot> why_not(const PointSeries& series, const FitJob& job,
                                            const RunContext& run = {});
/// The same when the refusal is known already.
[[nodiscard]] std::optional<WhyNot> why_not(const PointSeries& series, const FitJob& job,
                                            const Error& refusal, const RunContext& run = {});

}  // namespace obvid
