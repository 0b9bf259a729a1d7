// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/io/stored_contour.h"

namespace obvid {

/// Picture of a contour for a report: contour, points, curvature comb, vertices and inflections,
/// scale bar, and below it curvature and radius over arc length. One self-contained SVG file that
/// follows the viewer's light or dark scheme.
[[nodiscard]] std::string picture_svg(const StoredContour& stored);

}  // namespace obvid
