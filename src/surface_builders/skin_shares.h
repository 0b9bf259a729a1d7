// SPDX-License-Identifier: Apache-2.0
// Places of sections that belong together: by their tangents, or such that lines across bend least.
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/core/run_context.h"
#include "skin_marks.h"

namespace obvid {

/// Matched places of a stretch besides its ends.
inline constexpr std::size_t kFreeMarks = 31;

/// Arc lengths of kFreeMarks + 2 places between two of a section, ends included: equal steps of
/// half the share of length and half the share of the angle that the tangent has turned by. Of a
/// straight stretch, equal steps of length.
[[nodiscard]] std::vector<double> marks_by_angle(const MeasuredSection& section, double from,
                                                 double to);

/// As many places of all sections between two of each, such that the lines through them bend
/// little: least squares of chords between neighbouring sections first, then of second divided
/// differences over the chords, both with second differences of the shares of length along (Gauss
/// and Newton's steps, shortened until the sum falls; shares stay apart). Empty for sections that
/// are a point. The least sum that was found, not the least there is. Error: E103.
[[nodiscard]] Result<std::vector<std::vector<double>>> marks_of_least_bending(
    const std::vector<MeasuredSection>& sections, const std::vector<std::vector<double>>& ends,
    const RunContext& run);

}  // namespace obvid
