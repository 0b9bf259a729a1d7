// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

struct SvgDrawingOptions {
  double tolerance = 0.01;     ///< units; of pieces that SVG cannot hold exactly
  double stroke_width = 0.25;  ///< mm on the sheet
  double margin = 2.0;         ///< mm around the contour
};

struct SvgDrawing {
  std::string text;
  double deviation = 0.0;  ///< largest distance both ways, units, as measured (`path_distance`);
                           ///< 0: exact to rounding
  std::size_t curves = 0;  ///< segments of the path
};

/// A drawing in true scale, one path: for laser cutters, plotters and drawing programs. The sheet
/// has its size in mm, user units are those of the contour, y points up (one transformation around
/// the path). Lines, arcs and polynomials of degree 2 and 3 are exact; everything else becomes
/// cubic Bezier curves with the contour's tangents within the tolerance. Errors: E203 a
/// tolerance that is not greater than 0, a unit without a length in metres; E311 no pieces; E502
/// not reached; E103 where `watch` ends it.
[[nodiscard]] Result<SvgDrawing> svg_drawing(const Contour& contour,
                                             const SvgDrawingOptions& options = {},
                                             Watch* watch = nullptr);

/// One of several curves of a drawing.
struct SvgCurve {
  const Contour& contour;
  std::string id;           ///< of its path; in the file each is there once
  std::string layer;        ///< empty: none
  double tolerance = 0.01;  ///< as in `SvgDrawingOptions`
};

/// The same of several curves: a path each, those of one layer in a group that Inkscape shows as
/// one, in the order of the first of them. Errors: as above; E203 curves of different units.
[[nodiscard]] Result<SvgDrawing> svg_drawing(const std::vector<SvgCurve>& curves,
                                             const SvgDrawingOptions& options = {},
                                             Watch* watch = nullptr);

}  // namespace obvid
