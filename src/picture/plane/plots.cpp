// SPDX-License-Identifier: Apache-2.0
#include "plane/plots.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "plane/axis.h"
#include "plane/frame.h"
#include "plane/moves.h"
#include "plane/panels.h"

namespace obvid {
namespace {

constexpr double kOnePlotHeight = 150.0;
constexpr double kMovesHeight = 56.0;
constexpr double kPlotsTitleRoom = 30.0;
/// Room between two plots, px.
constexpr double kPlotsApart = 8.0;
/// Radii beyond this many sizes look straight; the axis ends there.
constexpr double kStraightSizes = 10.0;
/// ... but never closer than this many times the smallest radius.
constexpr double kRadiusSpan = 100.0;
/// Radii that differ by more than this stand on a logarithmic axis.
constexpr double kLogFrom = 30.0;
/// Room above and below on a logarithmic axis.
constexpr double kLogRoom = 1.15;
/// Clip paths of the plots.
constexpr int kCurvatureClip = 1;
constexpr int kRadiusClip = 2;
constexpr int kSlopeClip = 3;
/// Slopes below this part of 1/size^2 are flat: what rounding makes of a circle.
constexpr double kFlatSlope = 1e-9;
/// Curvatures that differ by less, rad over the diagonal: a line or its rounding.
constexpr double kFlat = 1e-9;

/// The axis leaves out curvatures of this part of the length when that makes it ...
constexpr double kLeftOut = 0.12;
/// ... shorter by this factor at least.
constexpr double kMuchLonger = 10.0;
/// Room beyond the curvatures that the axis shows, as part of them.
constexpr double kBeyondCurvatures = 0.3;
/// Of the largest curvature: what rounding makes of one at the end of the range.
constexpr double kShownRounding = 1e-9;

/// Range of the curvatures of all contours without those of the largest size on a part of the
/// length.
PictureRange usual_range(std::span<const PictureTrack* const> tracks) {
  std::vector<std::pair<double, double>> steps;  // curvature, length
  double length = 0.0;
  for (const PictureTrack* track : tracks) {
    for (std::size_t j = 1; j < track->samples.size(); ++j) {
      const PictureSample &a = track->samples[j - 1], &b = track->samples[j];
      steps.emplace_back(b.kappa, b.s - a.s);
      length += b.s - a.s;
    }
  }
  std::sort(steps.begin(), steps.end(),
            [](const auto& a, const auto& b) { return std::fabs(a.first) < std::fabs(b.first); });
  PictureRange range;
  double travelled = 0.0;
  for (const auto& [kappa, part] : steps) {
    travelled += part;
    if (travelled > (1.0 - kLeftOut) * length) break;
    range.low = std::min(range.low, kappa);
    range.high = std::max(range.high, kappa);
  }
  return range;
}

void draw_curvature(PictureCanvas& canvas, const PictureTrack& track, const PictureScale& scale,
                    PictureFrame frame, const std::string& units, bool coloured) {
  frame.y = curvature_axis(scale.range, track.box.diagonal());
  canvas.label({kPictureMargin, frame.top - 11.0}, "start", "axis-title",
               curvature_title(frame.y, scale, units));
  draw_grid(canvas, frame, false);
  draw_joints(canvas, frame, track);
  draw_graph(canvas, frame, track, curvature_of, coloured, kCurvatureClip);
  const double zero = frame.px_y(0.0);
  if (zero < frame.bottom - 1.0) canvas.line({frame.left, zero}, {frame.right, zero}, "axis");
  draw_plot_features(canvas, frame, track);
}

/// d kappa/ds: steps of a G2 contour are upright lines.
void draw_slope(PictureCanvas& canvas, const PictureTrack& track, PictureFrame frame,
                const std::string& units, bool coloured) {
  double low = 0.0, high = 0.0;
  for (const PictureSample& sample : track.samples) {
    low = std::min(low, sample.slope);
    high = std::max(high, sample.slope);
  }
  const double diagonal = track.box.diagonal();
  if (diagonal <= 0.0 || (high - low) * diagonal * diagonal < kFlatSlope) {
    const double shown = diagonal > 0.0 ? round_down(1.0 / (diagonal * diagonal)) : 1.0;
    frame.y = round_axis(-shown, shown, 4);
  } else {
    frame.y = round_axis(low, high, 4);
  }
  canvas.label({kPictureMargin, frame.top - 11.0}, "start", "axis-title",
               "Slope of the curvature, " + power_prefix(frame.y.exponent) + "1/" + units + "²");
  draw_grid(canvas, frame, false);
  draw_joints(canvas, frame, track);
  draw_graph(
      canvas, frame, track, [](const PictureSample& s) { return s.slope; }, coloured, kSlopeClip);
  const double zero = frame.px_y(0.0);
  if (zero < frame.bottom - 1.0) canvas.line({frame.left, zero}, {frame.right, zero}, "axis");
}

/// Radius that ends the axis: what is beyond looks straight.
double straight_radius(const PictureTrack& track) {
  return round_down(
      std::max(kStraightSizes * track.box.diagonal(), kRadiusSpan / track.largest_kappa));
}

PictureAxis radius_axis(const PictureTrack& track, double straight) {
  const double low = 1.0 / track.largest_kappa;
  double high = low;
  for (const PictureSample& sample : track.samples) {
    const double kappa = std::fabs(sample.kappa);
    high = std::max(high, kappa * straight > 1.0 ? 1.0 / kappa : straight);
  }
  if (high > kLogFrom * low) return log_axis(low / kLogRoom, high * kLogRoom);
  return round_axis(0.0, high, 4);
}

void draw_radius(PictureCanvas& canvas, const PictureTrack& track, PictureFrame frame,
                 const std::string& units, bool coloured) {
  if (track.largest_kappa * track.box.diagonal() < kFlat) {
    frame.y = round_axis(0.0, 1.0, 1);
    frame.y.ticks.clear();
    canvas.label({kPictureMargin, frame.top - 11.0}, "start", "axis-title", "Radius");
    draw_grid(canvas, frame, true);
    draw_joints(canvas, frame, track);
    canvas.label({0.5 * (frame.left + frame.right), 0.5 * (frame.top + frame.bottom)}, "middle",
                 "small", "straight: infinite radius everywhere");
    return;
  }
  const double straight = straight_radius(track);
  frame.y = radius_axis(track, straight);
  const bool clipped = frame.y.high >= straight;
  const double ceiling = clipped ? 2.0 * frame.y.high : frame.y.high;
  const PictureValue value = [ceiling](const PictureSample& s) {
    const double kappa = std::fabs(s.kappa);
    return kappa * ceiling > 1.0 ? 1.0 / kappa : ceiling;
  };
  std::string title = "Radius, " + power_prefix(frame.y.exponent) + units;
  if (frame.y.logarithmic) title += ", logarithmic";
  if (clipped)
    title += ", cut off at " + readable_number(straight, 2) + " " + units + " (straight)";
  canvas.label({kPictureMargin, frame.top - 11.0}, "start", "axis-title", title);
  draw_grid(canvas, frame, true);
  draw_joints(canvas, frame, track);
  draw_graph(canvas, frame, track, value, coloured, kRadiusClip);
}

}  // namespace

PictureRange curvature_range(const PictureTrack& track) {
  PictureRange range;
  for (const PictureSample& sample : track.samples) {
    range.low = std::min(range.low, sample.kappa);
    range.high = std::max(range.high, sample.kappa);
  }
  return range;
}

PictureScale curvature_scale(std::span<const PictureTrack* const> tracks,
                             const ShownCurvatures& shown) {
  PictureScale scale;
  for (const PictureTrack* track : tracks) {
    const PictureRange one = curvature_range(*track);
    scale.range.low = std::min(scale.range.low, one.low);
    scale.range.high = std::max(scale.range.high, one.high);
    scale.largest = std::max(scale.largest, track->largest_kappa);
  }
  if (shown.which == ShownCurvatures::Which::kAll) return scale;
  if (shown.which == ShownCurvatures::Which::kRange) {
    const PictureRange asked{shown.range.low, shown.range.high};
    const double rounding = kShownRounding * scale.largest;
    for (const PictureTrack* track : tracks) {
      for (const PictureSample& sample : track->samples) {
        scale.cut = scale.cut || sample.kappa < asked.low - rounding ||
                    sample.kappa > asked.high + rounding;
      }
    }
    scale.range = asked;
    return scale;
  }
  const PictureRange usual = usual_range(tracks);
  const double room = kBeyondCurvatures * (usual.high - usual.low);
  const PictureRange near{std::max(scale.range.low, usual.low - room),
                          std::min(scale.range.high, usual.high + room)};
  scale.cut =
      kMuchLonger * (near.high - near.low) < scale.range.high - scale.range.low && room > 0.0;
  if (scale.cut) scale.range = near;
  return scale;
}

PictureAxis curvature_axis(PictureRange range, double diagonal) {
  // A line (or its rounding) gets an axis that shows that it is flat.
  if (diagonal <= 0.0 || (range.high - range.low) * diagonal < kFlat) {
    const double shown = diagonal > 0.0 ? round_down(1.0 / diagonal) : 1.0;
    return round_axis(-shown, shown, 4);
  }
  return round_axis(range.low, range.high, 5);
}

std::string curvature_title(const PictureAxis& axis, const PictureScale& scale,
                            const std::string& units) {
  std::string title = "Curvature, " + power_prefix(axis.exponent) + "1/" + units + " (left turn +)";
  if (scale.cut) {
    title += ", cut off: the largest is " + readable_number(scale.largest, 2) + " 1/" + units;
  }
  return title;
}

double curvature_of(const PictureSample& sample) { return sample.kappa; }

double plot_panels(PictureCanvas& canvas, const PictureTrack& track, const PictureScale& scale,
                   const PlotsBetween& between, const std::string& units, bool coloured,
                   double top) {
  PictureFrame frame;
  frame.x = tight_axis(0.0, track.length, 8);
  frame.top = top + kPlotsTitleRoom;
  frame.bottom = frame.top + kOnePlotHeight;
  draw_curvature(canvas, track, scale, frame, units, coloured);
  if (between.slope) {
    frame.top = frame.bottom + kPlotsTitleRoom + kPlotsApart;
    frame.bottom = frame.top + kOnePlotHeight;
    draw_slope(canvas, track, frame, units, coloured);
  }
  if (!between.moves.points.empty()) {
    frame.top = frame.bottom + kPlotsTitleRoom + kPlotsApart;
    frame.bottom = frame.top + kMovesHeight;
    draw_moves(canvas, frame, track, between.moves, units, between.deviations);
  }
  frame.top = frame.bottom + kPlotsTitleRoom + kPlotsApart;
  frame.bottom = frame.top + kOnePlotHeight;
  draw_radius(canvas, track, frame, units, coloured);
  canvas.label({0.5 * (frame.left + frame.right), frame.bottom + 38.0}, "middle", "axis-title",
               "Arc length, " + power_prefix(frame.x.exponent) + units +
                   (joints_visible(track) ? " (short ticks: joints of pieces)" : ""));
  return frame.bottom + 56.0;
}

}  // namespace obvid
