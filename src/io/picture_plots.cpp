// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "picture_axis.h"
#include "picture_panels.h"

namespace obvid {
namespace {

constexpr double kLeft = 92.0;  // px, room for tick labels
constexpr double kHeight = 150.0;
constexpr double kTitleRoom = 30.0;
/// Radii beyond this many sizes look straight; the axis ends there.
constexpr double kStraightSizes = 10.0;
/// ... but never closer than this many times the smallest radius.
constexpr double kRadiusSpan = 100.0;
/// Radii that differ by more than this stand on a logarithmic axis.
constexpr double kLogFrom = 30.0;
/// Room above and below on a logarithmic axis.
constexpr double kLogRoom = 1.15;
/// Curves are thinned to extremes of columns this wide, px.
constexpr double kColumn = 0.5;
/// Ticks of joints stand at least this far apart, px.
constexpr double kJointApart = 2.5;
/// Symbols nearer than this, px, would cover each other.
constexpr double kSymbolApart = 4.0;

struct Frame {
  double left = kLeft;
  double right = kPictureWidth - kPictureMargin;
  double top = 0.0;
  double bottom = 0.0;
  PictureAxis x;
  PictureAxis y;

  [[nodiscard]] double px_x(double s) const { return left + (right - left) * x.place(s); }
  [[nodiscard]] double px_y(double v) const { return bottom - (bottom - top) * y.place(v); }
};

/// Polyline that keeps first, lowest, highest and last point of each column.
class ColumnPath {
 public:
  void start() {
    flush();
    started_ = false;
  }
  void add(Vec2 p) {
    if (!started_) {
      path_.move(p);
      started_ = true;
      column_ = std::floor(p.x / kColumn);
      low_ = high_ = last_ = p;
      low_first_ = true;
      return;
    }
    if (std::floor(p.x / kColumn) != column_) {
      flush();
      column_ = std::floor(p.x / kColumn);
      low_ = high_ = p;
    }
    if (p.y < low_.y) {
      low_ = p;
      low_first_ = false;
    }
    if (p.y > high_.y) {
      high_ = p;
      low_first_ = true;
    }
    last_ = p;
  }
  void flush() {
    if (!started_) return;
    put(low_first_ ? low_ : high_);
    put(low_first_ ? high_ : low_);
    put(last_);
  }
  [[nodiscard]] const PicturePath& path() const { return path_; }

 private:
  void put(Vec2 p) { path_.thin_line(p, 0.05); }

  PicturePath path_;
  bool started_ = false;
  bool low_first_ = true;
  double column_ = 0.0;
  Vec2 low_, high_, last_;
};

using Value = std::function<double(const PictureSample&)>;

void draw_grid(PictureCanvas& canvas, const Frame& frame, bool x_labels) {
  for (const PictureTick& tick : frame.y.ticks) {
    const double y = frame.px_y(tick.value);
    canvas.line({frame.left, y}, {frame.right, y}, tick.label.empty() ? "faint" : "grid");
    canvas.label({frame.left - 8.0, y + 4.0}, "end", "small", tick.label);
  }
  for (const PictureTick& tick : frame.x.ticks) {
    const double x = frame.px_x(tick.value);
    canvas.line({x, frame.top}, {x, frame.bottom}, "grid");
    if (x_labels) canvas.label({x, frame.bottom + 18.0}, "middle", "small", tick.label);
  }
  canvas.line({frame.left, frame.bottom}, {frame.right, frame.bottom}, "axis");
  canvas.line({frame.left, frame.top}, {frame.left, frame.bottom}, "axis");
}

/// Whether joints stand far enough apart, on the average, to be told apart.
bool joints_visible(const PictureTrack& track) {
  constexpr double kRoom = kPictureWidth - kPictureMargin - kLeft;
  return static_cast<double>(track.pieces.size()) * kJointApart < kRoom;
}

void draw_joints(PictureCanvas& canvas, const Frame& frame, const PictureTrack& track) {
  if (!joints_visible(track)) return;
  PicturePath ticks;
  double last = -HUGE_VAL;
  for (std::size_t i = 0; i <= track.pieces.size() && !track.samples.empty(); ++i) {
    const double s = i < track.pieces.size() ? track.samples[track.first[i]].s : track.length;
    const double x = frame.px_x(s);
    if (x - last < kJointApart) continue;
    ticks.move({x, frame.bottom});
    ticks.line({x, frame.bottom - 6.0});
    last = x;
  }
  if (!ticks.empty()) canvas.add("<path class=\"joint\" d=\"{}\"/>\n", ticks.text());
}

void draw_graph(PictureCanvas& canvas, const Frame& frame, const PictureTrack& track,
                const Value& value, bool coloured) {
  for (const int colour : {1, -1, 0, kNoRun}) {
    ColumnPath graph;
    for (std::size_t i = 0; i < track.pieces.size(); ++i) {
      if (colour_of(track, i, coloured) != colour) {
        graph.start();
        continue;
      }
      for (std::size_t j = track.first[i]; j < track.first[i + 1]; ++j) {
        const PictureSample& sample = track.samples[j];
        graph.add({frame.px_x(sample.s), frame.px_y(value(sample))});
      }
    }
    graph.start();
    if (graph.path().empty()) continue;
    canvas.add("<path class=\"graph {}\" d=\"{}\"/>\n", run_css(colour), graph.path().text());
  }
}

void draw_panel(PictureCanvas& canvas, const Frame& frame, const PictureTrack& track,
                const Value& value, bool coloured, const std::string& title, bool x_labels) {
  canvas.label({kPictureMargin, frame.top - 11.0}, "start", "axis-title", title);
  draw_grid(canvas, frame, x_labels);
  draw_joints(canvas, frame, track);
  canvas.add(
      "<clipPath id=\"plot{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/>"
      "</clipPath>\n<g clip-path=\"url(#plot{0})\">\n",
      x_labels ? 2 : 1, px(frame.left), px(frame.top - 1.0), px(frame.right - frame.left + 1.0),
      px(frame.bottom - frame.top + 2.0));
  draw_graph(canvas, frame, track, value, coloured);
  canvas.add("</g>\n");
}

PictureAxis curvature_axis(const PictureTrack& track) {
  double low = 0.0;
  double high = 0.0;
  for (const PictureSample& sample : track.samples) {
    low = std::min(low, sample.kappa);
    high = std::max(high, sample.kappa);
  }
  const double diagonal = track.box.diagonal();
  // A line (or its rounding) gets an axis that shows that it is flat.
  constexpr double kFlat = 1e-9;
  if (diagonal <= 0.0 || (high - low) * diagonal < kFlat) {
    const double shown = diagonal > 0.0 ? round_down(1.0 / diagonal) : 1.0;
    return round_axis(-shown, shown, 4);
  }
  return round_axis(low, high, 5);
}

void draw_curvature(PictureCanvas& canvas, const PictureTrack& track, Frame frame,
                    const std::string& units, bool coloured) {
  frame.y = curvature_axis(track);
  const Value value = [](const PictureSample& s) { return s.kappa; };
  draw_panel(canvas, frame, track, value, coloured,
             "Curvature, " + power_prefix(frame.y.exponent) + "1/" + units + " (left turn +)",
             false);
  const double zero = frame.px_y(0.0);
  if (zero < frame.bottom - 1.0) canvas.line({frame.left, zero}, {frame.right, zero}, "axis");
  if (track.features.size() > kMostSymbols) return;
  Vec2 last{-HUGE_VAL, 0.0};
  for (const PictureFeature& feature : track.features) {
    const Vec2 at{frame.px_x(feature.at.s), frame.px_y(feature.at.kappa)};
    if (std::fabs(at.x - last.x) + std::fabs(at.y - last.y) < kSymbolApart) continue;
    add_feature(canvas, feature.kind, at);
    last = at;
  }
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

void draw_radius(PictureCanvas& canvas, const PictureTrack& track, Frame frame,
                 const std::string& units, bool coloured) {
  constexpr double kFlat = 1e-9;
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
  const Value value = [ceiling](const PictureSample& s) {
    const double kappa = std::fabs(s.kappa);
    return kappa * ceiling > 1.0 ? 1.0 / kappa : ceiling;
  };
  std::string title = "Radius, " + power_prefix(frame.y.exponent) + units;
  if (frame.y.logarithmic) title += ", logarithmic";
  if (clipped)
    title += ", cut off at " + readable_number(straight, 2) + " " + units + " (straight)";
  draw_panel(canvas, frame, track, value, coloured, title, true);
}

}  // namespace

double plot_panels(PictureCanvas& canvas, const PictureTrack& track, const std::string& units,
                   bool coloured, double top) {
  Frame frame;
  frame.x = tight_axis(0.0, track.length, 8);
  frame.top = top + kTitleRoom;
  frame.bottom = frame.top + kHeight;
  draw_curvature(canvas, track, frame, units, coloured);
  frame.top = frame.bottom + kTitleRoom + 8.0;
  frame.bottom = frame.top + kHeight;
  draw_radius(canvas, track, frame, units, coloured);
  canvas.label({0.5 * (frame.left + frame.right), frame.bottom + 38.0}, "middle", "axis-title",
               "Arc length, " + power_prefix(frame.x.exponent) + units +
                   (joints_visible(track) ? " (short ticks: joints of pieces)" : ""));
  return frame.bottom + 56.0;
}

}  // namespace obvid
