// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "obvid/picture/internal/carriers_svg.h"
#include "plane/drawing.h"
#include "plane/frame.h"
#include "plane/legend.h"
#include "plane/panels.h"
#include "plane/plots.h"
#include "plane/sheet.h"
#include "plane/side.h"

namespace obvid {
namespace {

constexpr double kCarrierPlotHeight = 104.0;
constexpr double kCarrierTitleRoom = 32.0;
constexpr double kRefusalRoom = 26.0;
constexpr double kAxisWidth = 56.0;

PictureFrame common_frame(const std::vector<PictureSide>& sides, const PictureScale& scale) {
  PictureFrame frame;
  double length = 0.0, diagonal = 0.0;
  for (const PictureSide& side : sides) {
    length = std::max(length, side.track.length);
    diagonal = std::max(diagonal, side.track.box.diagonal());
  }
  frame.x = tight_axis(0.0, length, 8);
  frame.y = curvature_axis(scale.range, diagonal);
  return frame;
}

void draw_plot(PictureCanvas& canvas, const PictureFrame& frame, const PictureSide& side,
               const PictureSide& first, int id, bool last) {
  draw_grid(canvas, frame, last);
  draw_joints(canvas, frame, side.track);
  if (&side != &first) {
    canvas.add("<g opacity=\"0.45\">\n");
    draw_graph(canvas, frame, first.track, curvature_of, false, 2 * id);
    canvas.add("</g>\n");
  }
  draw_graph(canvas, frame, side.track, curvature_of, side.coloured, 2 * id + 1);
  const double zero = frame.px_y(0.0);
  if (zero < frame.bottom - 1.0) canvas.line({frame.left, zero}, {frame.right, zero}, "axis");
  draw_plot_features(canvas, frame, side.track);
}

/// Colours and symbols of all plots.
double legend_of_all(PictureCanvas& canvas, const std::vector<PictureSide>& sides,
                     const std::string& units, double y) {
  PictureTrack all;
  for (const PictureSide& side : sides) {
    all.pieces.insert(all.pieces.end(), side.track.pieces.begin(), side.track.pieces.end());
    for (std::size_t i = 0; i < side.track.pieces.size(); ++i) {
      all.direction.push_back(colour_of(side.track, i, side.coloured));
    }
    if (side.track.features.size() > kMostSymbols) continue;
    all.features.insert(all.features.end(), side.track.features.begin(), side.track.features.end());
  }
  all.features.resize(std::min(all.features.size(), kMostSymbols));
  all.counts = counts_of_marks(all);
  return draw_legend(canvas,
                     {.track = all,
                      .units = units,
                      .coloured = true,
                      .region_width = 0.0,
                      .dots = false,
                      .longest_tooth = 0.0,
                      .comb_cut = false},
                     kPictureMargin, y);
}

}  // namespace

std::string carriers_svg(const std::vector<NamedContour>& contours, const std::string& heading,
                         const ShownCurvatures& shown) {
  std::vector<PictureSide> sides;
  std::string units, description;
  for (const NamedContour& one : contours) {
    sides.push_back(
        make_picture_side(one.contour, one.name, one.certificate ? &*one.certificate : nullptr));
    if (units.empty() && !one.contour.pieces.empty()) units = one.contour.units.text();
    description += (description.empty() ? "" : "; ") + one.name + ": " + one.remark;
  }
  const PictureScale scale = common_scale(sides, shown);
  PictureFrame frame = common_frame(sides, scale);
  PictureCanvas body;
  body.label({kPictureMargin, 40.0}, "start", "title", heading);
  double y = legend_of_all(body, sides, units, 66.0);
  body.label({kPictureMargin, y + 22.0}, "start", "axis-title",
             curvature_title(frame.y, scale, units));
  y += 22.0;
  std::size_t last_drawn = 0;
  for (std::size_t k = 0; k < contours.size(); ++k) {
    if (!contours[k].contour.pieces.empty()) last_drawn = k;
  }
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const bool refused = contours[k].contour.pieces.empty();
    const double title_y = y + 22.0;
    body.label({frame.left, title_y}, "start", "axis-title",
               refused ? contours[k].name : sides[k].caption);
    body.label({frame.right, title_y}, "end", "fact", contours[k].remark);
    if (refused) {
      y += kRefusalRoom;
      continue;
    }
    frame.top = y + kCarrierTitleRoom;
    frame.bottom = frame.top + kCarrierPlotHeight;
    draw_plot(body, frame, sides[k], sides.front(), static_cast<int>(k) + 1, k == last_drawn);
    y = frame.bottom;
  }
  body.label({0.5 * (frame.left + frame.right), frame.bottom + 38.0}, "middle", "axis-title",
             "Arc length, " + power_prefix(frame.x.exponent) + units);
  return picture_sheet(heading, description, body.take(), std::max(y, frame.bottom) + kAxisWidth);
}

}  // namespace obvid
