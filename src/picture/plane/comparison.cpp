// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "obvid/picture/picture_svg.h"
#include "plane/axis.h"
#include "plane/drawing.h"
#include "plane/frame.h"
#include "plane/legend.h"
#include "plane/panels.h"
#include "plane/plots.h"
#include "plane/sheet.h"
#include "plane/side.h"

namespace obvid {
namespace {

/// Shapes at least this much wider than high stand above each other, others side by side.
constexpr double kWideShape = 2.2;
constexpr double kMostComparedHeight = 300.0;  // of one shape, px
constexpr double kComparedPadding = 18.0;      // around a shape, px
constexpr double kCaptionRoom = 26.0;          // px
constexpr double kComparedPlotHeight = 170.0;
constexpr double kPlotTitleRoom = 34.0;

using Sides = std::array<PictureSide, 2>;

PictureComb common_comb(const Sides& sides, const PictureScale& scale) {
  PictureComb comb = make_comb(sides[0].track);
  const PictureComb other = make_comb(sides[1].track);
  if (comb.per_kappa == 0.0 || (other.per_kappa != 0.0 && other.per_kappa < comb.per_kappa)) {
    comb = other;
  }
  return cut_comb(comb, scale);
}

/// Place and scale of both shapes: the same px per unit, above each other or side by side.
struct Shapes {
  std::array<PictureView, 2> views;
  std::array<Vec2, 2> captions;
  double bottom = 0.0;
};

Shapes place_shapes(const Sides& sides, const PictureComb& comb, double top) {
  std::array<Box2, 2> boxes;
  Vec2 extent;
  for (std::size_t k = 0; k < 2; ++k) {
    boxes[k] = box_with_comb(sides[k].track, comb);
    const Vec2 one = boxes[k].high - boxes[k].low;
    extent = {std::max(extent.x, one.x), std::max(extent.y, one.y)};
  }
  const bool stacked = extent.x > kWideShape * extent.y;
  const double column = kPictureWidth - 2.0 * kPictureMargin;
  const double width = (stacked ? column : 0.5 * column) - 2.0 * kComparedPadding;
  double scale = 1.0;
  if (extent.x > 0.0 || extent.y > 0.0) {
    scale = std::min(extent.x > 0.0 ? width / extent.x : HUGE_VAL,
                     extent.y > 0.0 ? kMostComparedHeight / extent.y : HUGE_VAL);
  }
  const double height = extent.y * scale + 2.0 * kComparedPadding;
  Shapes shapes;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto index = static_cast<double>(k);
    const double y = top + (stacked ? index * (height + kCaptionRoom) : 0.0);
    const double left = kPictureMargin + (stacked ? 0.0 : index * 0.5 * column);
    shapes.captions[k] = {left, y + 14.0};
    shapes.views[k].scale = scale;
    shapes.views[k].centre = 0.5 * (boxes[k].low + boxes[k].high);
    shapes.views[k].middle = {left + 0.5 * width + kComparedPadding,
                              y + kCaptionRoom + 0.5 * height};
    shapes.bottom = y + kCaptionRoom + height;
  }
  return shapes;
}

double draw_shapes(PictureCanvas& canvas, const Sides& sides, const PictureComb& comb,
                   const std::string& units, double top) {
  const Shapes shapes = place_shapes(sides, comb, top);
  for (std::size_t k = 0; k < 2; ++k) {
    const PictureSide& side = sides[k];
    canvas.label(shapes.captions[k], "start", "axis-title", side.caption);
    if (side.track.samples.empty()) continue;
    draw_comb(canvas, side.track, comb, shapes.views[k], side.coloured);
    canvas.add("<g class=\"fine\">\n");  // the combs are the subject
    draw_curve(canvas, side.track, shapes.views[k], side.coloured);
    canvas.add("</g>\n");
    draw_features(canvas, side.track, shapes.views[k]);
  }
  draw_scale_bar(canvas, shapes.views[0], units, shapes.bottom + 14.0);
  return shapes.bottom + 14.0;
}

double draw_plots(PictureCanvas& canvas, const Sides& sides, const PictureScale& scale,
                  const std::string& units, double top) {
  PictureFrame frame;
  frame.x = tight_axis(0.0, std::max(sides[0].track.length, sides[1].track.length), 8);
  const double diagonal = std::max(sides[0].track.box.diagonal(), sides[1].track.box.diagonal());
  frame.y = curvature_axis(scale.range, diagonal);
  const std::string title = curvature_title(frame.y, scale, units);
  frame.bottom = top;
  for (std::size_t k = 0; k < 2; ++k) {
    const PictureSide& side = sides[k];
    frame.top = frame.bottom + kPlotTitleRoom;
    frame.bottom = frame.top + kComparedPlotHeight;
    canvas.label({kPictureMargin, frame.top - 11.0}, "start", "axis-title", title);
    canvas.label({frame.right, frame.top - 11.0}, "end", "fact", side.caption);
    draw_grid(canvas, frame, k == 1);
    draw_joints(canvas, frame, side.track);
    draw_graph(canvas, frame, side.track, curvature_of, side.coloured, static_cast<int>(k) + 1);
    const double zero = frame.px_y(0.0);
    if (zero < frame.bottom - 1.0) canvas.line({frame.left, zero}, {frame.right, zero}, "axis");
    draw_plot_features(canvas, frame, side.track);
  }
  canvas.label({0.5 * (frame.left + frame.right), frame.bottom + 38.0}, "middle", "axis-title",
               "Arc length, " + power_prefix(frame.x.exponent) + units);
  return frame.bottom + 56.0;
}

/// Legend of both sides: what only one of them has is in it too.
double draw_common_legend(PictureCanvas& canvas, const Sides& sides, const PictureComb& comb,
                          const std::string& units, double y) {
  PictureTrack both;
  for (const PictureSide& side : sides) {
    both.pieces.insert(both.pieces.end(), side.track.pieces.begin(), side.track.pieces.end());
    for (std::size_t i = 0; i < side.track.pieces.size(); ++i) {
      both.direction.push_back(colour_of(side.track, i, side.coloured));
    }
    const auto& features = side.track.features;
    if (features.size() > kMostSymbols) continue;
    both.features.insert(both.features.end(), features.begin(), features.end());
  }
  both.features.resize(std::min(both.features.size(), kMostSymbols));
  both.counts = counts_of_marks(both);
  PictureLegend legend{both, units};
  if (comb.per_kappa != 0.0) {
    const double all = std::max(sides[0].track.largest_kappa, sides[1].track.largest_kappa);
    legend.comb_cut = comb.largest < all;
    legend.longest_tooth = std::min(comb.largest, all);
  }
  return draw_legend(canvas, legend, kPictureMargin + kScaleBarRoom, y) + 12.0;
}

}  // namespace

std::string comparison_svg(const Contour& before, const Contour& after,
                           const ComparisonTitles& titles, const ShownCurvatures& shown) {
  const Sides sides = {make_picture_side(before, titles.before),
                       make_picture_side(after, titles.after)};
  const PictureScale scale = common_scale(sides, shown);
  const PictureComb comb = common_comb(sides, scale);
  PictureCanvas body;
  body.label({kPictureMargin, 40.0}, "start", "title", titles.heading);
  double y = draw_shapes(body, sides, comb, before.units.text(), 64.0);
  y = draw_common_legend(body, sides, comb, before.units.text(), y);
  y = draw_plots(body, sides, scale, before.units.text(), y);
  return picture_sheet(titles.heading, sides[0].caption + "; " + sides[1].caption, body.take(), y);
}

}  // namespace obvid
