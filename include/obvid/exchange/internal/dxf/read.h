// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// What a DXF file draws in its model space, ASCII or binary, R9 to R2018: LINE, ARC, CIRCLE,
/// ELLIPSE, SPLINE, LWPOLYLINE and POLYLINE as curves, exactly; vertices of polylines without
/// arcs, fit points of splines without control points, and all POINTs together as series of points.
/// INSERTs are drawn as the blocks that they stand for. Open entities of one layer that meet end to
/// end, two and not more at one place, become one curve (docs/methods/dxf.md, section 3).
///
/// Warnings say what was left out (other kinds of entities, wrong radii, counts that contradict
/// each other, planes that are tilted against xy) with the handle, layer and line of the first one.
/// Heights z are dropped, with a warning where they are not constant. `name` stands in errors.
///
/// Time and memory grow with the size of the file, and with that of what blocks expand to, which
/// is bounded. Errors: E306 bytes that are no DXF file, or a truncated one, before any entity; E308
/// pairs that cannot be read (where: the line; of binary files the byte); E304 when nothing is left
/// to draw. Never throws on any input.
[[nodiscard]] Result<Drawing> parse_dxf(std::string_view bytes, std::string_view name);

}  // namespace obvid
