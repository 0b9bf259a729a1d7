// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "plane/drawing.h"
#include "plane/legend.h"
#include "plane/panels.h"
#include "plane/region.h"
#include "plane/view.h"

namespace obvid {
namespace {

/// Room of the drawing, px.
constexpr double kMostShapeHeight = 480.0;
constexpr double kLeastHeight = 110.0;
/// Room around the curve for symbols and the word "start", px.
constexpr double kShapePadding = 26.0;
/// Narrower parts of the region, px, cannot be told from the curve.
constexpr double kLeastRegion = 1.0;

PictureView make_view(const PictureTrack& track, const PictureComb& comb, double top,
                      double& bottom) {
  const Box2 box = box_with_comb(track, comb);
  const Vec2 extent = box.high - box.low;
  const double room = kPictureWidth - 2.0 * (kPictureMargin + kShapePadding);
  PictureView view;
  view.scale = 1.0;
  if (extent.x > 0.0 || extent.y > 0.0) {
    view.scale = std::min(extent.x > 0.0 ? room / extent.x : HUGE_VAL,
                          extent.y > 0.0 ? kMostShapeHeight / extent.y : HUGE_VAL);
  }
  const double height = std::max(kLeastHeight, extent.y * view.scale) + 2.0 * kShapePadding;
  view.centre = 0.5 * (box.low + box.high);
  view.middle = {0.5 * kPictureWidth, top + 0.5 * height};
  bottom = top + height;
  return view;
}

/// Points-only region where it is wide enough to be seen, under everything else. Returns its
/// largest width in units, 0 when nothing was drawn.
double draw_region(PictureCanvas& canvas, const PictureTrack& track, const StoredContour& stored,
                   const PictureView& view, double top, double bottom) {
  if (is_as_drawn(stored.contour.carrier)) return 0.0;  // nobody was asked for points
  PicturePath path;
  double widest = 0.0;
  for (const PictureLens& lens :
       points_only_region(track, stored.contour, stored.report ? &*stored.report : nullptr)) {
    if (!(lens.width * view.scale >= kLeastRegion)) continue;
    add_lens(path, lens, view);
    widest = std::max(widest, lens.width);
  }
  if (path.empty()) return 0.0;
  // Wild points have lenses larger than the drawing: they end at the edges of the panel.
  canvas.add(
      "<clipPath id=\"shape\"><rect y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n"
      "<path class=\"region\" clip-path=\"url(#shape)\" d=\"{}\"/>\n",
      px(top), px(kPictureWidth), px(bottom - top), path.text());
  return widest;
}

}  // namespace

double shape_panel(PictureCanvas& canvas, const PictureTrack& track, const StoredContour& stored,
                   const PictureScale& scale, const PictureMoves* deviations, bool coloured,
                   double top) {
  const PictureComb comb =
      deviations == nullptr ? cut_comb(make_comb(track), scale) : PictureComb{};
  double bottom = top;
  const PictureView view = make_view(track, comb, top, bottom);
  const double widest = draw_region(canvas, track, stored, view, top, bottom);
  draw_comb(canvas, track, comb, view, coloured);
  if (widest > 0.0) canvas.add("<g class=\"fine\">\n");  // a thick curve would hide the region
  draw_curve(canvas, track, view, coloured);
  if (widest > 0.0) canvas.add("</g>\n");
  if (deviations != nullptr) draw_deviations(canvas, track, *deviations, view);
  draw_points(canvas, track, view);
  draw_features(canvas, track, view);
  draw_start(canvas, track, view);
  const double strip = bottom + 22.0;
  draw_scale_bar(canvas, view, stored.contour.units.text(), strip);
  PictureLegend legend{track, stored.contour.units.text(), coloured, widest};
  legend.dots = dot_radius(track, view) > 0.0;
  legend.dots_are_joints = is_as_drawn(stored.contour.carrier);
  if (comb.per_kappa != 0.0) {
    legend.comb_cut = comb.largest < track.largest_kappa;
    legend.longest_tooth = std::min(comb.largest, track.largest_kappa);
  }
  legend.deviations = deviations;
  return draw_legend(canvas, legend, kPictureMargin + kScaleBarRoom, strip) + 16.0;
}

}  // namespace obvid
