// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "obvid/curve/contour.h"
#include "plane/canvas.h"
#include "plane/plots.h"
#include "plane/track.h"
#include "plane/view.h"

namespace obvid {

/// Directions of runs in the order in which they are drawn.
inline constexpr std::array<int, 4> kPictureColours = {1, -1, 0, kNoRun};

/// Curvature comb in model units.
struct PictureComb {
  double per_kappa = 0.0;     ///< tooth length per unit of curvature; 0: none
  double largest = HUGE_VAL;  ///< curvatures beyond are drawn as this one

  [[nodiscard]] Vec2 tip(const PictureSample& sample) const;
};

/// Comb whose longest tooth is 12 % of the diagonal; none for straight contours.
[[nodiscard]] PictureComb make_comb(const PictureTrack& track);

/// Its teeth as long for the largest curvature that the scale shows.
[[nodiscard]] PictureComb cut_comb(PictureComb comb, const PictureScale& scale);

/// Box of the contour with its comb.
[[nodiscard]] Box2 box_with_comb(const PictureTrack& track, const PictureComb& comb);

/// CSS name of a run's colour: up, down, even or plain.
[[nodiscard]] const char* run_css(int direction);

/// Direction that decides the colour of a piece.
[[nodiscard]] int colour_of(const PictureTrack& track, std::size_t piece, bool coloured);

/// Symbol of a vertex, an inflection or a corner.
void add_feature(PictureCanvas& canvas, PictureFeature::Kind kind, Vec2 at);

void draw_curve(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view,
                bool coloured);
void draw_comb(PictureCanvas& canvas, const PictureTrack& track, const PictureComb& comb,
               const PictureView& view, bool coloured);

/// Radius of the dots, px: smaller where points are dense, 0 where dots would hide the curve.
[[nodiscard]] double dot_radius(const PictureTrack& track, const PictureView& view);
void draw_points(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view);

/// Symbols on the curve, if they are not too many.
void draw_features(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view);
/// Arrow along the start tangent and the word "start" behind the first point.
void draw_start(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view);

}  // namespace obvid
