// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/region_table.h"

namespace obvid {

/// A construction of the papers as a contour, with report and certificate like any other. It
/// promises nothing beyond its points and tangents: the certificate says what it is. Steps of the
/// curvature between its pieces are marked at their joints. Inserted points are joints without a
/// source. `job.construction` is set.
/// Errors: those of `region_table`; E401 where a conic would be no ellipse; E406 where it does not
/// meet what was given (curvatures, with most of them).
[[nodiscard]] Result<Fit> fit_construction(const PointSeries& series, const RegionJob& job,
                                           const RunContext& run = {});

}  // namespace obvid
