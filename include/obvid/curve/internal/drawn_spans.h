// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/nurbs.h"

namespace obvid {

/// Spans of a curve of a drawing. Control points that only the rounding of the coordinates tells
/// from an end of their span are that end, and spans that are no more than such a point are left
/// out: where control points repeat, what is left of them would turn by any angle. Degree 1: lines.
[[nodiscard]] std::vector<Piece> drawn_spans(const NurbsCurve& curve);

}  // namespace obvid
