// SPDX-License-Identifier: Apache-2.0
#include "plane/legend.h"

#include <algorithm>
#include <array>

#include "plane/axis.h"
#include "plane/panels.h"

namespace obvid {
namespace {

/// Widest scale bar, px.
constexpr double kScaleBar = 150.0;
/// Average width of a letter in the legend, px (12 px sans-serif).
constexpr double kLetter = 6.4;

/// Entries of the legend from left to right, broken into rows.
class LegendRow {
 public:
  LegendRow(PictureCanvas& canvas, double left, double y)
      : canvas_(canvas), left_(left), x_(left), y_(y) {}

  /// Reserves room for a symbol and a text, returns where the symbol's centre stands.
  Vec2 entry(const std::string& text, std::size_t letters, double symbol_width) {
    const double width = symbol_width + 7.0 + kLetter * static_cast<double>(letters);
    if (x_ > left_ && x_ + width > kPictureWidth - kPictureMargin) {
      x_ = left_;
      y_ += 20.0;
    }
    canvas_.label({x_ + symbol_width + 7.0, y_ + 4.0}, "start", "small", text);
    const Vec2 centre{x_ + 0.5 * symbol_width, y_};
    x_ += width + 18.0;
    return centre;
  }
  [[nodiscard]] double y() const { return y_; }

 private:
  PictureCanvas& canvas_;
  double left_;
  double x_;
  double y_;
};

void legend_lines(PictureCanvas& canvas, LegendRow& legend, const PictureTrack& track,
                  bool coloured) {
  static constexpr std::array<const char*, 4> kNames = {
      "curvature increasing", "curvature decreasing", "constant curvature", "contour"};
  for (std::size_t c = 0; c < kPictureColours.size(); ++c) {
    bool present = false;
    for (std::size_t i = 0; i < track.pieces.size() && !present; ++i) {
      present = colour_of(track, i, coloured) == kPictureColours[c];
    }
    if (!present) continue;
    const std::string name = kNames[c];
    const Vec2 at = legend.entry(name, name.size(), 22.0);
    canvas.add("<path class=\"curve {}\" d=\"M{} {}h22\"/>\n", run_css(kPictureColours[c]),
               px(at.x - 11.0), px(at.y));
  }
}

void legend_points(PictureCanvas& canvas, LegendRow& legend, const std::string& what,
                   std::size_t unmarked) {
  const std::string text =
      unmarked == 0 ? what : std::to_string(unmarked) + " " + what + "s, too dense to mark";
  const Vec2 at = legend.entry(text, text.size(), 8.0);
  canvas.add("<path class=\"dot\" stroke-width=\"6.8\" d=\"M{0} {1}h.01\"/>\n", px(at.x), px(at.y));
  canvas.add("<path class=\"hole\" stroke-width=\"4.2\" d=\"M{0} {1}h.01\"/>\n", px(at.x),
             px(at.y));
}

struct FeatureName {
  PictureFeature::Kind kind;
  std::size_t PictureCounts::*count;
  const char* one;
  const char* many;
};

constexpr FeatureName kFeatureNames[] = {
    {PictureFeature::Kind::kVertex, &PictureCounts::vertices, "vertex", "vertices"},
    {PictureFeature::Kind::kInflection, &PictureCounts::inflections, "inflection", "inflections"},
    {PictureFeature::Kind::kCorner, &PictureCounts::corners, "corner", "corners"}};

void legend_features(PictureCanvas& canvas, LegendRow& legend, const PictureTrack& track) {
  for (const auto& [kind, count, one, many] : kFeatureNames) {
    const std::size_t marked = count_features(track, kind), all = track.counts.*count;
    if (std::max(marked, all) == 0) continue;
    std::string text = one;
    if (track.features.size() > kMostSymbols) {
      text = std::to_string(all) + " " + many + ", not marked";
    } else if (marked != all) {  // what swings by rounding alone has no place of its own
      text = fmt::format("{}, {} of {} marked", many, marked, all);
    }
    add_feature(canvas, kind, legend.entry(text, text.size(), 10.0));
  }
}

void legend_region(PictureCanvas& canvas, LegendRow& legend, double widest,
                   const std::string& units) {
  const std::string text = "region: every monotone curve through the points, widest " +
                           readable_number(widest, 3) + " " + units;
  const Vec2 at = legend.entry(text, text.size(), 22.0);
  canvas.add("<path class=\"region\" d=\"M{} {}q11 -12 22 0q-11 6 -22 0\"/>\n", px(at.x - 11.0),
             px(at.y + 2.0));
}

void legend_comb(PictureCanvas& canvas, LegendRow& legend, const PictureLegend& told) {
  const std::string number = readable_number(told.longest_tooth, 3) + " /" + told.units;
  const std::string text =
      std::string("curvature comb, ") + (told.comb_cut ? "cut off at " : "longest tooth ") + number;
  const Vec2 at = legend.entry(text, 38 + told.units.size(), 18.0);
  canvas.add("<path class=\"teeth\" d=\"M{0} {1}v-9m4.5 9v-8m4.5 8v-7m4.5 7v-6m4.5 6v-5\"/>\n",
             px(at.x - 9.0), px(at.y + 5.0));
}

void legend_deviations(PictureCanvas& canvas, LegendRow& legend, const PictureMoves& moves) {
  const std::array<std::string, 3> kinds = {"within half " + moves.limit, "up to " + moves.limit,
                                            "beyond it"};
  for (std::size_t k = 0; k < kMoveClasses.size(); ++k) {
    const auto count =
        std::count_if(moves.points.begin(), moves.points.end(),
                      [&](const PictureMove& m) { return class_of(m) == kMoveClasses[k]; });
    if (count == 0) continue;
    const std::string text =
        fmt::format("{} {} {}", count, count == 1 ? "point" : "points", kinds[k]);
    const Vec2 at = legend.entry(text, text.size(), 14.0);
    canvas.add("<path class=\"deviation {}\" d=\"M{} {}v-10m5 10v-8m5 8v-11\"/>\n",
               move_css(kMoveClasses[k]), px(at.x - 5.0), px(at.y + 5.0));
  }
}

}  // namespace

void draw_scale_bar(PictureCanvas& canvas, const PictureView& view, const std::string& units,
                    double y) {
  const double length = round_down(kScaleBar / view.scale);
  const double left = kPictureMargin;
  const double right = left + length * view.scale;
  canvas.add("<path class=\"bar\" d=\"M{0} {1}v8M{0} {2}H{3}M{3} {1}v8\"/>\n", px(left), px(y - 4),
             px(y), px(right));
  canvas.label({right + 8.0, y + 4.0}, "start", "small", readable_number(length, 3) + " " + units);
}

double draw_legend(PictureCanvas& canvas, const PictureLegend& legend, double left, double y) {
  const PictureTrack& track = legend.track;
  LegendRow row(canvas, left, y);
  legend_lines(canvas, row, track, legend.coloured);
  if (!track.points.empty()) {
    legend_points(canvas, row, legend.dots_are_joints ? "joint" : "given point",
                  legend.dots ? 0 : track.points.size());
  }
  legend_features(canvas, row, track);
  if (legend.longest_tooth != 0.0) legend_comb(canvas, row, legend);
  if (legend.deviations != nullptr) legend_deviations(canvas, row, *legend.deviations);
  if (legend.region_width > 0.0) legend_region(canvas, row, legend.region_width, legend.units);
  return row.y();
}

}  // namespace obvid
