// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plane/canvas.h"
#include "plane/drawing.h"
#include "plane/moves.h"
#include "plane/track.h"
#include "plane/view.h"

namespace obvid {

/// Room for the scale bar and its length, px.
inline constexpr double kScaleBarRoom = 240.0;

void draw_scale_bar(PictureCanvas& canvas, const PictureView& view, const std::string& units,
                    double y);

/// What the legend tells besides the track.
struct PictureLegend {
  const PictureTrack& track;
  std::string units;
  bool coloured = true;
  double region_width = 0.0;     ///< of the drawn region, units; 0: none was drawn
  bool dots = true;              ///< whether points were marked
  bool dots_are_joints = false;  ///< of pieces, where another system drew the curve
  double longest_tooth = 0.0;    ///< curvature of the comb's longest tooth, 1/unit; 0: no comb
  bool comb_cut = false;         ///< whether larger curvatures have that tooth too
  const PictureMoves* deviations = nullptr;  ///< drawn in the colours of their classes
};

/// Entries from `left` on, broken into rows. Returns the y of the last row.
double draw_legend(PictureCanvas& canvas, const PictureLegend& legend, double left, double y);

}  // namespace obvid
