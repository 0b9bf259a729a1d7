// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "obvid/report/stored_contour.h"
#include "plane/canvas.h"
#include "plane/track.h"
#include "plane/view.h"

namespace obvid {

struct PictureFrame;

/// How far the contour passes from one input point.
struct PictureMove {
  double s = 0.0;  ///< arc length where it passes
  double part =
      0.0;  ///< distance in units of the point's tolerance, or of what is allowed, positive
            ///< where the point lies left of the contour; 0 for points without either
  std::size_t sample = 0;  ///< of the track, where it passes
};

/// How far a point is off, in its tolerance or in what is allowed: the colours of a map of
/// deviations.
enum class MoveClass : std::uint8_t { kHalf, kWithin, kBeyond };
[[nodiscard]] MoveClass class_of(const PictureMove& move);
inline constexpr std::array kMoveClasses = {MoveClass::kHalf, MoveClass::kWithin,
                                            MoveClass::kBeyond};
/// CSS name of its colour.
[[nodiscard]] const char* move_css(MoveClass kind);

struct PictureMoves {
  std::vector<PictureMove> points;  ///< empty when nothing is allowed and no point has a tolerance
  std::string limit = "their tolerance";  ///< what `part` is a part of, in words
  double largest = 0.0;                   ///< distance, units
  double root_mean_square = 0.0;          ///< of the distances of all points, units
};

/// Distances are those of the report where it has them, else from the nearest sample. `allowed`
/// (units): as in `PicturePlots`. Cost O(points + samples) for points in the order of the contour.
[[nodiscard]] PictureMoves make_moves(const PictureTrack& track, const StoredContour& stored,
                                      double allowed = 0.0);

/// Strip with one tooth per point between the lines of the tolerance, in the colours of their
/// classes or in one.
void draw_moves(PictureCanvas& canvas, PictureFrame frame, const PictureTrack& track,
                const PictureMoves& moves, const std::string& units, bool coloured);

/// Teeth on the contour towards the points, in the colours of their classes, `kMoveTooth` px for a
/// tolerance and at most twice that.
inline constexpr double kMoveTooth = 12.0;
void draw_deviations(PictureCanvas& canvas, const PictureTrack& track, const PictureMoves& moves,
                     const PictureView& view);

}  // namespace obvid
