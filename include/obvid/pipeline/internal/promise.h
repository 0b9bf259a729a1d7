// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "obvid/picture/internal/joints_claim.h"  // a part of what is promised, told alike in pictures
#include "obvid/pipeline/fit.h"

namespace obvid {

/// What a contour that was formed does not keep: E501 the promise of its carrier, E502 the
/// tolerance. Nothing when it keeps both.
[[nodiscard]] std::optional<Error> broken_promise(const Fit& made);

/// The same of a stored contour: E503 what it says wrongly comes before E501 what is not proved,
/// and that before E502, a tolerance that it says itself not to keep.
[[nodiscard]] std::optional<Error> broken_promise(const StoredContour& stored,
                                                  const Verification& found);

/// The last line of a report: what is proved, or why not.
[[nodiscard]] std::string verdict_line(Carrier carrier, const Certificate& certificate);

/// What the points force, and on which curves (docs/claims.md, `vertices_lower_bound`).
[[nodiscard]] std::string bound_text(int bound);
/// The same for vertices, with what they are: drawings call their corners so.
[[nodiscard]] std::string vertex_bound_text(int bound);

/// How far neighbouring pieces are from meeting, with the scale of each figure.
[[nodiscard]] std::string gaps_text(Carrier carrier, const Certificate& certificate);

}  // namespace obvid
