// SPDX-License-Identifier: Apache-2.0
#include "plane/frame.h"

#include <algorithm>
#include <cmath>

#include "plane/drawing.h"

namespace obvid {
namespace {

/// Curves are thinned to extremes of columns this wide, px.
constexpr double kCurveColumn = 0.5;
/// Ticks of joints stand at least this far apart, px.
constexpr double kJointApart = 2.5;
/// Symbols nearer than this, px, would cover each other.
constexpr double kSymbolApart = 4.0;
/// Lines at corners stand at least this far apart, px.
constexpr double kCornerApart = 4.0;

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
      column_ = std::floor(p.x / kCurveColumn);
      low_ = high_ = last_ = p;
      low_first_ = true;
      return;
    }
    if (std::floor(p.x / kCurveColumn) != column_) {
      flush();
      column_ = std::floor(p.x / kCurveColumn);
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

void draw_corners(PictureCanvas& canvas, const PictureFrame& frame, const PictureTrack& track) {
  PicturePath lines;
  double last = -HUGE_VAL;
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    if (!track.corner[i]) continue;
    const double x = frame.px_x(track.samples[track.first[i]].s);
    if (x - last < kCornerApart) continue;
    lines.move({x, frame.top});
    lines.line({x, frame.bottom});
    last = x;
  }
  if (!lines.empty()) canvas.add("<path class=\"break\" d=\"{}\"/>\n", lines.text());
}

}  // namespace

void draw_grid(PictureCanvas& canvas, const PictureFrame& frame, bool x_labels) {
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
  constexpr double kRoom = kPictureWidth - kPictureMargin - kPlotLeft;
  return static_cast<double>(track.pieces.size()) * kJointApart < kRoom;
}

void draw_joints(PictureCanvas& canvas, const PictureFrame& frame, const PictureTrack& track) {
  draw_corners(canvas, frame, track);
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

void draw_graph(PictureCanvas& canvas, const PictureFrame& frame, const PictureTrack& track,
                const PictureValue& value, bool coloured, int id) {
  canvas.add(
      "<clipPath id=\"plot{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/>"
      "</clipPath>\n<g clip-path=\"url(#plot{0})\">\n",
      id, px(frame.left), px(frame.top - 1.0), px(frame.right - frame.left + 1.0),
      px(frame.bottom - frame.top + 2.0));
  for (const int colour : kPictureColours) {
    ColumnPath graph;
    for (std::size_t i = 0; i < track.pieces.size(); ++i) {
      if (colour_of(track, i, coloured) != colour) {
        graph.start();
        continue;
      }
      if (track.corner[i]) graph.start();
      for (std::size_t j = track.first[i]; j < track.first[i + 1]; ++j) {
        const PictureSample& sample = track.samples[j];
        graph.add({frame.px_x(sample.s), frame.px_y(value(sample))});
      }
    }
    graph.start();
    if (graph.path().empty()) continue;
    canvas.add("<path class=\"graph {}\" d=\"{}\"/>\n", run_css(colour), graph.path().text());
  }
  canvas.add("</g>\n");
}

void draw_plot_features(PictureCanvas& canvas, const PictureFrame& frame,
                        const PictureTrack& track) {
  if (track.features.size() > kMostSymbols) return;
  Vec2 last{-HUGE_VAL, 0.0};
  for (const PictureFeature& feature : track.features) {
    if (feature.kind == PictureFeature::Kind::kCorner) continue;  // a line over the whole plot
    const double y = std::clamp(frame.px_y(feature.at.kappa), frame.top, frame.bottom);
    const Vec2 at{frame.px_x(feature.at.s), y};
    if (std::fabs(at.x - last.x) + std::fabs(at.y - last.y) < kSymbolApart) continue;
    add_feature(canvas, feature.kind, at);
    last = at;
  }
}

}  // namespace obvid
