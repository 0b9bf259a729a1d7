// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "obvid/core/result.h"
#include "obvid/series/point_series.h"

namespace obvid::pipeline_detail {

/// Who fixed a heading or a curvature.
enum class FixedBy { kSeries, kPoint, kStart, kEnd };

/// What is fixed at a point, and by whom.
struct FixedOnce {
  FixedData data;
  FixedBy theta_by = FixedBy::kSeries, kappa_by = FixedBy::kSeries;
};

/// A heading and a curvature that one source fixes.
[[nodiscard]] FixedOnce fixed_by(FixedBy by, std::optional<double> theta,
                                 std::optional<double> kappa);

/// Adds what else is fixed at a point: the smaller tolerance holds, and what is a corner for one is
/// one. `point` names it in errors, counted from 0. A heading or a curvature that is fixed already
/// stays; where the other one differs by more than rounding, nobody knows which is meant.
/// Errors: E203, or E403 when the series contradicts itself.
[[nodiscard]] Result<void> add_fixed(FixedOnce& into, const FixedOnce& more, std::size_t point);

}  // namespace obvid::pipeline_detail
