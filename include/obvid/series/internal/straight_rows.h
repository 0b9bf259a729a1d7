// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Whether straight pieces in a row are chords that stand for a curve, and not edges that somebody
/// drew: at three neighbouring points at least they turn by less than 27 degrees, and along them the
/// heading goes one way by two and a half of the largest of these turns. Three equal turns do, and
/// four that grow like 1, 2, 3, 4; what rounding leaves of points on one line goes to and fro and
/// never does. Rectangles, polygons up to the dodecagon and contours of edges and chamfers are
/// drawn, circles of 14 chords and more are not. Scale does not matter, nor do the lengths of the
/// chords. `closed`: the first point follows the last one, which does not repeat it. Linear time.
/// Reasons: docs/methods/series.md.
[[nodiscard]] bool chords_of_curve(std::span<const Vec2> points, bool closed);

}  // namespace obvid
