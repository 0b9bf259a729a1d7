// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "obvid/pipeline/fit.h"

namespace obvid::pipeline_detail {

/// Contours of the least largest curvature hug the ends of what is possible: their spirals are
/// nearly arcs over parts, which no monotone parabolas follow. So many times the least are tried.
inline constexpr std::array<double, 7> kRoomsForParabolas{1.01, 1.02, 1.05, 1.1, 1.2, 1.5, 2.0};
/// The least possible is known to that part of it.
inline constexpr double kLeastIsKnownTo = 1.002;

/// Whether a refusal of parabolas may come of that.
[[nodiscard]] inline bool wants_room(const FitJob& job, const Error& error) {
  return job.prefer == Prefer::kLeastCurvature && !job.above_least &&
         error.code == ErrorCode::kToleranceNotReached;
}

/// Forms with more and more room, told in a warning about `what` has it; else the first refusal.
template <class Form>
[[nodiscard]] auto with_room(const FitJob& job, const char* what,
                             decltype(std::declval<Form>()(job)) refused, Form form)
    -> decltype(refused) {
  for (const double room : kRoomsForParabolas) {
    FitJob wider = job;
    wider.above_least = room / kLeastIsKnownTo;
    auto made = form(wider);
    if (!made && made.error().code == ErrorCode::kCancelled) return made;
    if (!made) continue;
    made->warnings.push_back(
        fmt::format("parabolas follow no contour within half a percent of the least possible "
                    "largest curvature: {} within {:.0f} % of it",
                    what, 100.0 * (room - 1.0)));
    return made;
  }
  return refused;
}

}  // namespace obvid::pipeline_detail
