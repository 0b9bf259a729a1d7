// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// What an SVG file draws: paths, lines, polylines, polygons, rectangles, circles and ellipses,
/// each connected part one curve; polylines and polygons also as series of points. Lengths are real
/// ones in millimetres, 1 px = 1/96 in; y points up, the origin is the lower left corner of the
/// sheet.
///
/// Exactly: circle arcs that stay circles are `ArcPiece`s, other ellipse arcs rational quadratics
/// of at most 90 degrees, quadratic and cubic Beziers polynomials. Transforms, viewBox, nested svg,
/// symbol and use are followed; clip paths, masks, markers, text and images are not drawn. Data
/// with an error are drawn up to it, as SVG says, with a warning; so is everything else that is
/// left out.
///
/// Linear time and memory: nesting is bounded by 200, what `use` draws by 16 times the file (and
/// 4 MB). Errors: E308 XML that is not well-formed (truncated files), E310 another kind of XML, E304
/// a file that draws nothing. Never throws on any input. `name` stands in errors. Source: SVG 2 (W3C
/// 2018), 8, 9, 10 and F.6 of SVG 1.1 for the arcs.
[[nodiscard]] Result<Drawing> parse_svg(std::string_view text, std::string_view name);

}  // namespace obvid
