// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "obvid/picture/picture_svg.h"
#include "plane/axis.h"
#include "plane/canvas.h"
#include "plane/moves.h"
#include "plane/track.h"

namespace obvid {

struct PictureRange {
  double low = 0.0;
  double high = 0.0;
};

/// Curvatures of a contour, and 0.
[[nodiscard]] PictureRange curvature_range(const PictureTrack& track);
/// Curvature axis of one contour, or of several beside each other.
struct PictureScale {
  PictureRange range;
  bool cut = false;      ///< larger curvatures are left out
  double largest = 0.0;  ///< of all, by size, 1/unit
};

[[nodiscard]] PictureScale curvature_scale(std::span<const PictureTrack* const> tracks,
                                           const ShownCurvatures& shown);
/// Axis for these curvatures of a contour of this size.
[[nodiscard]] PictureAxis curvature_axis(PictureRange range, double diagonal);
[[nodiscard]] std::string curvature_title(const PictureAxis& axis, const PictureScale& scale,
                                          const std::string& units);
[[nodiscard]] double curvature_of(const PictureSample& sample);

/// What stands between the plots of curvature and of radius.
struct PlotsBetween {
  const PictureMoves& moves;  ///< shown where points have tolerances
  bool slope = false;         ///< of the curvature
  bool deviations = false;    ///< moves in the colours of their classes
};

/// Lower panels over arc length: curvature, its slope, moves, and radius. Returns the y of their
/// lower end.
double plot_panels(PictureCanvas& canvas, const PictureTrack& track, const PictureScale& scale,
                   const PlotsBetween& between, const std::string& units, bool coloured,
                   double top);

}  // namespace obvid
