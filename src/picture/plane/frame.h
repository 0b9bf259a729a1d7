// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "plane/axis.h"
#include "plane/canvas.h"
#include "plane/panels.h"
#include "plane/track.h"

namespace obvid {

/// Px left of a plot, room for tick labels.
inline constexpr double kPlotLeft = 92.0;

/// A plot's place on the picture and its axes.
struct PictureFrame {
  double left = kPlotLeft;
  double right = kPictureWidth - kPictureMargin;
  double top = 0.0;
  double bottom = 0.0;
  PictureAxis x;
  PictureAxis y;

  [[nodiscard]] double px_x(double s) const { return left + (right - left) * x.place(s); }
  [[nodiscard]] double px_y(double v) const { return bottom - (bottom - top) * y.place(v); }
};

using PictureValue = std::function<double(const PictureSample&)>;

/// Ticks of both axes with their lines, labels of the lower one if asked for.
void draw_grid(PictureCanvas& canvas, const PictureFrame& frame, bool x_labels);

/// Whether joints stand far enough apart, on the average, to be told apart.
[[nodiscard]] bool joints_visible(const PictureTrack& track);
/// Short ticks at joints, if they can be told apart, and lines from top to bottom at corners.
void draw_joints(PictureCanvas& canvas, const PictureFrame& frame, const PictureTrack& track);

/// A value over arc length in the runs' colours, cut off at the frame; it breaks at corners. `id`
/// differs between the plots of a picture.
void draw_graph(PictureCanvas& canvas, const PictureFrame& frame, const PictureTrack& track,
                const PictureValue& value, bool coloured, int id);

/// Symbols at their curvature, at the edge of the frame where the axis does not reach it.
void draw_plot_features(PictureCanvas& canvas, const PictureFrame& frame,
                        const PictureTrack& track);

}  // namespace obvid
