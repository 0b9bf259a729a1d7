// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/exchange/drawing.h"
#include "obvid/pipeline/import.h"
#include "obvid/series/point_series.h"

namespace obvid::pipeline_detail {

/// A curve of a drawing as a series (docs/methods/drawings.md): lines, arcs, arcs of ellipses and
/// clothoids stay as they are, everything else becomes points with chords no farther than `chord`
/// from it [1e-4 of the size of the curve]. Corners of the drawing are marked, and where a curve
/// goes on from a piece that stays, its heading is fixed. A warning where pieces do not meet, and so
/// all of them became points.
[[nodiscard]] PointSeries series_of(const DrawnCurve& curve, DrawnUse use,
                                    std::optional<double> chord);

}  // namespace obvid::pipeline_detail
