// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/report/stored_contour.h"

namespace obvid::pipeline_detail {

/// Every figure of the report that follows from the contour and its points alone. Errors as those
/// of `analyse`.
[[nodiscard]] Result<FitReport> measure(const Contour& contour, double tolerance, Watch& watch);

/// Figures of the report that the proof decides. A bound above the vertices of a proved contour is
/// taken back: that contour refutes it.
void settle_with(const Certificate& certificate, const Contour& contour, FitReport& report,
                 Watch& watch);

/// Default of the tolerance: the seeds' 0.001 mm, near enough, on their series of 280 mm
/// across.
[[nodiscard]] double default_tolerance(const std::vector<Vec2>& points);

/// Direction of a run that is proved; 0 also where nothing is.
[[nodiscard]] int direction_of(Verdict verdict);

/// The same of pieces one by one, of which runs are made where no builder knows them. That
/// `certify` proves those runs once more is no check of them (docs/methods/certify.md). Error E103.
[[nodiscard]] Result<std::vector<int>> proved_directions(const std::vector<Piece>& pieces,
                                                         Watch& watch);

}  // namespace obvid::pipeline_detail
