// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/report/stored_contour.h"
#include "plane/canvas.h"
#include "plane/moves.h"
#include "plane/plots.h"
#include "plane/track.h"

namespace obvid {

/// Left, right and width of the whole picture, px.
inline constexpr double kPictureWidth = 1000.0;
inline constexpr double kPictureMargin = 40.0;

/// Beyond this many runs colours would be noise, and the file large: one neutral colour then.
inline constexpr std::size_t kMostColouredRuns = 2000;

/// Beyond this many vertices and inflections symbols would hide the curve: none is drawn, and the
/// legend says how many there are.
inline constexpr std::size_t kMostSymbols = 400;

/// Upper panel: shape, comb or deviations of the points, points, symbols, scale bar, legend. Returns
/// the y of its lower end. `deviations`: null for the comb.
double shape_panel(PictureCanvas& canvas, const PictureTrack& track, const StoredContour& stored,
                   const PictureScale& scale, const PictureMoves* deviations, bool coloured,
                   double top);

}  // namespace obvid
