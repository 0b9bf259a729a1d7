// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/report/stored_contour.h"
#include "plane/canvas.h"
#include "plane/track.h"

namespace obvid {

struct PictureFrame;

/// How far the contour passes from one input point.
struct PictureMove {
  double s = 0.0;     ///< arc length where it passes
  double part = 0.0;  ///< distance in units of the point's tolerance, positive where the point lies
                      ///< left of the contour; 0 for points without one
};

struct PictureMoves {
  std::vector<PictureMove> points;  ///< empty when no point has a tolerance
  double largest = 0.0;             ///< distance, units
};

/// Distances are those of the report where it has them, else from the nearest sample. Cost
/// O(points + samples) for points in the order of the contour.
[[nodiscard]] PictureMoves make_moves(const PictureTrack& track, const StoredContour& stored);

/// Strip with one tooth per point between the lines of the tolerance.
void draw_moves(PictureCanvas& canvas, PictureFrame frame, const PictureTrack& track,
                const PictureMoves& moves, const std::string& units);

}  // namespace obvid
