// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "picture_axis.h"
#include "picture_panels.h"
#include "picture_region.h"
#include "picture_view.h"

namespace obvid {
namespace {

/// Room of the drawing, px.
constexpr double kMostHeight = 480.0;
constexpr double kLeastHeight = 110.0;
/// Room around the curve for symbols and the word "start", px.
constexpr double kPadding = 26.0;
/// Longest tooth of the comb as part of the box's diagonal.
constexpr double kCombPart = 0.12;
constexpr int kTeeth = 180;
/// Below this curvature times size there is no comb: the contour is straight to the eye.
constexpr double kStraightAngle = 1e-9;
/// Distance of the drawn cubics from the exact curve, px (half of what is promised).
constexpr double kDrawnWithin = 0.025;
constexpr int kDeepestSplit = 10;
/// Pieces shorter than this, px, are drawn as chords.
constexpr double kChordPx = 1.5;
/// Least distance between drawn points of a dense curve, px, and their aimed number.
constexpr double kThinStep = 0.6;
constexpr double kMostVertices = 30000.0;
/// Widest scale bar, px.
constexpr double kScaleBar = 150.0;
/// Narrower parts of the region, px, cannot be told from the curve.
constexpr double kLeastRegion = 1.0;
/// Average width of a letter in the legend, px (12 px sans-serif).
constexpr double kLetter = 6.4;

/// Comb in model units.
struct Comb {
  double per_kappa = 0.0;  // tooth length per unit of curvature; 0: none

  [[nodiscard]] Vec2 tip(const PictureSample& sample) const {
    return sample.point - (per_kappa * sample.kappa) * left_normal(sample.tangent);
  }
};

Comb make_comb(const PictureTrack& track) {
  const double diagonal = track.box.diagonal();
  if (track.largest_kappa * diagonal < kStraightAngle) return {};
  return {kCombPart * diagonal / track.largest_kappa};
}

PictureView make_view(const PictureTrack& track, const Comb& comb, double top, double& bottom) {
  PictureBox box = track.box;
  for (const PictureSample& sample : track.samples) box.add(comb.tip(sample));
  const Vec2 extent = box.high - box.low;
  const double room = kPictureWidth - 2.0 * (kPictureMargin + kPadding);
  PictureView view;
  view.scale = 1.0;
  if (extent.x > 0.0 || extent.y > 0.0) {
    view.scale = std::min(extent.x > 0.0 ? room / extent.x : HUGE_VAL,
                          extent.y > 0.0 ? kMostHeight / extent.y : HUGE_VAL);
  }
  const double height = std::max(kLeastHeight, extent.y * view.scale) + 2.0 * kPadding;
  view.centre = 0.5 * (box.low + box.high);
  view.middle = {0.5 * kPictureWidth, top + 0.5 * height};
  bottom = top + height;
  return view;
}

/// Cubic with the derivatives of the piece at both ends; split until it is close enough.
void add_cubics(PicturePath& path, const Piece& piece, const PictureView& view, const Jet& a,
                double ta, const Jet& b, double tb, int depth) {
  const double third = (tb - ta) / 3.0;
  const Vec2 p0 = view(a.point);
  const Vec2 p1 = view(a.point + third * a.d1);
  const Vec2 p2 = view(b.point - third * b.d1);
  const Vec2 p3 = view(b.point);
  double worst = 0.0;
  for (const double f : {0.25, 0.5, 0.75}) {
    const double g = 1.0 - f;
    const Vec2 drawn =
        g * g * g * p0 + 3.0 * g * g * f * p1 + 3.0 * g * f * f * p2 + f * f * f * p3;
    worst = std::max(worst, norm(drawn - view(evaluate(piece, ta + f * (tb - ta)).point)));
  }
  if (worst <= kDrawnWithin || depth == 0) {
    path.cubic(p1, p2, p3);
    return;
  }
  const double t = 0.5 * (ta + tb);
  const Jet middle = evaluate(piece, t);
  add_cubics(path, piece, view, a, ta, middle, t, depth - 1);
  add_cubics(path, piece, view, middle, t, b, tb, depth - 1);
}

void add_piece(PicturePath& path, const Piece& piece, const PictureView& view, double step) {
  const Vec2 end = view(end_point(piece));
  if (std::holds_alternative<LinePiece>(piece)) return path.thin_line(end, step);
  const Vec2 start = view(start_point(piece));
  if (norm(view(evaluate(piece, 0.5).point) - start) + norm(end - start) < kChordPx) {
    return path.thin_line(end, step);
  }
  add_cubics(path, piece, view, evaluate(piece, 0.0), 0.0, evaluate(piece, 1.0), 1.0,
             kDeepestSplit);
}

constexpr std::array<int, 4> kColours = {1, -1, 0, kNoRun};

void draw_curve(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view,
                bool coloured) {
  const double step = std::max(kThinStep, track.length * view.scale / kMostVertices);
  for (const int colour : kColours) {
    PicturePath path;
    bool pen_down = false;
    for (std::size_t i = 0; i < track.pieces.size(); ++i) {
      if (colour_of(track, i, coloured) != colour) {
        if (pen_down) path.line(view(start_point(track.pieces[i])));
        pen_down = false;
        continue;
      }
      if (!pen_down) path.move(view(start_point(track.pieces[i])));
      pen_down = true;
      add_piece(path, track.pieces[i], view, step);
    }
    if (pen_down) path.line(view(end_point(track.pieces.back())));
    if (!path.empty()) {
      canvas.add("<path class=\"curve {}\" d=\"{}\"/>\n", run_css(colour), path.text());
    }
  }
}

void draw_comb(PictureCanvas& canvas, const PictureTrack& track, const Comb& comb,
               const PictureView& view, bool coloured) {
  if (comb.per_kappa == 0.0) return;
  PicturePath teeth;
  for (const PictureTooth& tooth : comb_teeth(track, kTeeth)) {
    teeth.move(view(tooth.point));
    teeth.line(view(comb.tip(tooth)));
  }
  canvas.add("<path class=\"teeth\" d=\"{}\"/>\n", teeth.text());
  double length = 0.0;
  for (std::size_t j = 1; j < track.samples.size(); ++j) {
    length += norm(comb.tip(track.samples[j]) - comb.tip(track.samples[j - 1])) * view.scale;
  }
  const double step = std::max(kThinStep, length / kMostVertices);
  for (const int colour : kColours) {
    PicturePath path;
    bool pen_down = false;
    for (std::size_t i = 0; i < track.pieces.size(); ++i) {
      const bool mine = colour_of(track, i, coloured) == colour;
      for (std::size_t j = track.first[i]; mine && j < track.first[i + 1]; ++j) {
        const Vec2 tip = view(comb.tip(track.samples[j]));
        pen_down ? path.thin_line(tip, step) : path.move(tip);
        pen_down = true;
      }
      pen_down = mine;
    }
    if (!path.empty()) {
      canvas.add("<path class=\"envelope {}\" d=\"{}\"/>\n", run_css(colour), path.text());
    }
  }
}

/// Points-only region where it is wide enough to be seen, under everything else. Returns its
/// largest width in units, 0 when nothing was drawn.
double draw_region(PictureCanvas& canvas, const PictureTrack& track, const Contour& contour,
                   const PictureView& view, double top, double bottom) {
  PicturePath path;
  double widest = 0.0;
  for (const PictureLens& lens : points_only_region(track, contour)) {
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

/// Radius of the dots, px: smaller where points are dense, 0 where dots would hide the curve.
double dot_radius(const PictureTrack& track, const PictureView& view) {
  constexpr double kLargest = 3.4;
  constexpr double kSmallest = 0.8;
  constexpr double kOfSpacing = 0.28;
  if (track.points.empty()) return 0.0;
  if (track.pieces.empty()) return kLargest;
  const double spacing = track.length * view.scale / static_cast<double>(track.points.size());
  const double radius = std::min(kOfSpacing * spacing, kLargest);
  return radius < kSmallest ? 0.0 : radius;
}

/// Dots by round line ends: one path for all, far smaller than one element each.
void draw_points(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view) {
  const double radius = dot_radius(track, view);
  if (radius == 0.0) return;
  std::string dots;
  Vec2 last{HUGE_VAL, HUGE_VAL};
  for (const Vec2 p : track.points) {
    const Vec2 at = view(p);
    if (std::fabs(at.x - last.x) + std::fabs(at.y - last.y) < radius) continue;
    dots += fmt::format("M{} {}h.01", px(at.x), px(at.y));
    last = at;
  }
  canvas.add("<path class=\"dot\" stroke-width=\"{}\" d=\"{}\"/>\n", px(2.0 * radius), dots);
  if (radius > 2.0) {
    canvas.add("<path class=\"hole\" stroke-width=\"{}\" d=\"{}\"/>\n", px(2.0 * radius - 2.6),
               dots);
  }
}

void draw_features(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view) {
  constexpr double kApart = 4.0;  // px; nearer symbols would cover each other
  if (track.features.size() > kMostSymbols) return;
  for (const auto kind : {PictureFeature::Kind::kInflection, PictureFeature::Kind::kVertex}) {
    Vec2 last{HUGE_VAL, HUGE_VAL};
    for (const PictureFeature& feature : track.features) {
      const Vec2 at = view(feature.at.point);
      if (feature.kind != kind || norm(at - last) < kApart) continue;
      add_feature(canvas, kind, at);
      last = at;
    }
  }
}

/// Arrow along the start tangent and the word "start" behind the first point.
void draw_start(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view) {
  if (track.samples.empty()) return;
  const PictureSample& start = track.samples.front();
  const Vec2 at = view(start.point);
  const Vec2 ahead{start.tangent.x, -start.tangent.y};
  const Vec2 aside = left_normal(ahead);
  const Vec2 back = at - 7.0 * ahead;
  const Vec2 tail = back - 8.0 * ahead;
  canvas.add("<path class=\"arrow\" d=\"M{} {}L{} {}L{} {}Z\"/>\n", px(back.x), px(back.y),
             px(tail.x + 3.6 * aside.x), px(tail.y + 3.6 * aside.y), px(tail.x - 3.6 * aside.x),
             px(tail.y - 3.6 * aside.y));
  const bool sideways = std::fabs(ahead.x) > 0.5;
  const Vec2 word{tail.x - 5.0 * ahead.x, tail.y - 5.0 * ahead.y + (ahead.y < 0.0 ? 7.0 : 1.0) +
                                              (sideways ? 3.0 * (1.0 - std::fabs(ahead.y)) : 0.0)};
  canvas.label(word, !sideways ? "middle" : ahead.x > 0.0 ? "end" : "start", "note", "start");
}

void draw_scale_bar(PictureCanvas& canvas, const PictureView& view, const std::string& units,
                    double y) {
  const double length = round_down(kScaleBar / view.scale);
  const double left = kPictureMargin;
  const double right = left + length * view.scale;
  canvas.add("<path class=\"bar\" d=\"M{0} {1}v8M{0} {2}H{3}M{3} {1}v8\"/>\n", px(left), px(y - 4),
             px(y), px(right));
  canvas.label({right + 8.0, y + 4.0}, "start", "small", readable_number(length, 3) + " " + units);
}

/// Entries of the legend from left to right, broken into rows.
class Legend {
 public:
  Legend(PictureCanvas& canvas, double left, double y)
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

void legend_lines(PictureCanvas& canvas, Legend& legend, const PictureTrack& track, bool coloured) {
  static constexpr std::array<const char*, 4> kNames = {
      "curvature increasing", "curvature decreasing", "constant curvature", "contour"};
  for (std::size_t c = 0; c < kColours.size(); ++c) {
    bool present = false;
    for (std::size_t i = 0; i < track.pieces.size() && !present; ++i) {
      present = colour_of(track, i, coloured) == kColours[c];
    }
    if (!present) continue;
    const std::string name = kNames[c];
    const Vec2 at = legend.entry(name, name.size(), 22.0);
    canvas.add("<path class=\"curve {}\" d=\"M{} {}h22\"/>\n", run_css(kColours[c]),
               px(at.x - 11.0), px(at.y));
  }
}

void legend_points(PictureCanvas& canvas, Legend& legend, std::size_t unmarked) {
  const std::string text =
      unmarked == 0 ? "given point" : std::to_string(unmarked) + " given points, too dense to mark";
  const Vec2 at = legend.entry(text, text.size(), 8.0);
  canvas.add("<path class=\"dot\" stroke-width=\"6.8\" d=\"M{0} {1}h.01\"/>\n", px(at.x), px(at.y));
  canvas.add("<path class=\"hole\" stroke-width=\"4.2\" d=\"M{0} {1}h.01\"/>\n", px(at.x),
             px(at.y));
}

void legend_features(PictureCanvas& canvas, Legend& legend, const PictureTrack& track) {
  for (const auto kind : {PictureFeature::Kind::kVertex, PictureFeature::Kind::kInflection}) {
    const auto same = [kind](const PictureFeature& f) { return f.kind == kind; };
    const auto count = std::count_if(track.features.begin(), track.features.end(), same);
    if (count == 0) continue;
    const bool vertex = kind == PictureFeature::Kind::kVertex;
    std::string text = vertex ? "vertex" : "inflection";
    if (track.features.size() > kMostSymbols) {
      text = std::to_string(count) + (vertex ? " vertices" : " inflections") + ", not marked";
    }
    add_feature(canvas, kind, legend.entry(text, text.size(), 10.0));
  }
}

void legend_region(PictureCanvas& canvas, Legend& legend, double widest, const std::string& units) {
  const std::string text = "region: every monotone curve through the points, widest " +
                           readable_number(widest, 3) + " " + units;
  const Vec2 at = legend.entry(text, text.size(), 22.0);
  canvas.add("<path class=\"region\" d=\"M{} {}q11 -12 22 0q-11 6 -22 0\"/>\n", px(at.x - 11.0),
             px(at.y + 2.0));
}

double draw_legend(PictureCanvas& canvas, const PictureTrack& track, const Comb& comb,
                   const PictureView& view, const std::string& units, bool coloured, double widest,
                   double y) {
  Legend legend(canvas, kPictureMargin + kScaleBar + 90.0, y);
  legend_lines(canvas, legend, track, coloured);
  if (!track.points.empty()) {
    legend_points(canvas, legend, dot_radius(track, view) > 0.0 ? 0 : track.points.size());
  }
  legend_features(canvas, legend, track);
  if (comb.per_kappa != 0.0) {
    const std::string text =
        "curvature comb, longest tooth " + readable_number(track.largest_kappa, 3) + " /" + units;
    const Vec2 at = legend.entry(text, 38 + units.size(), 18.0);
    canvas.add("<path class=\"teeth\" d=\"M{0} {1}v-9m4.5 9v-8m4.5 8v-7m4.5 7v-6m4.5 6v-5\"/>\n",
               px(at.x - 9.0), px(at.y + 5.0));
  }
  if (widest > 0.0) legend_region(canvas, legend, widest, units);
  return legend.y();
}

}  // namespace

const char* run_css(int direction) {
  switch (direction) {
    case 1:
      return "up";
    case -1:
      return "down";
    case 0:
      return "even";
    default:
      return "plain";
  }
}

int colour_of(const PictureTrack& track, std::size_t piece, bool coloured) {
  return coloured ? track.direction[piece] : kNoRun;
}

void add_feature(PictureCanvas& canvas, PictureFeature::Kind kind, Vec2 at) {
  if (kind == PictureFeature::Kind::kVertex) {
    canvas.add("<path class=\"vertex\" d=\"M{} {}l5.5 5.5-5.5 5.5-5.5-5.5z\"/>\n", px(at.x),
               px(at.y - 5.5));
  } else {
    canvas.add("<path class=\"inflection\" d=\"M{} {}l5.2 9h-10.4z\"/>\n", px(at.x),
               px(at.y - 6.0));
  }
}

double shape_panel(PictureCanvas& canvas, const PictureTrack& track, const Contour& contour,
                   bool coloured, double top) {
  const Comb comb = make_comb(track);
  double bottom = top;
  const PictureView view = make_view(track, comb, top, bottom);
  const double widest = draw_region(canvas, track, contour, view, top, bottom);
  draw_comb(canvas, track, comb, view, coloured);
  if (widest > 0.0) canvas.add("<g class=\"fine\">\n");  // a thick curve would hide the region
  draw_curve(canvas, track, view, coloured);
  if (widest > 0.0) canvas.add("</g>\n");
  draw_points(canvas, track, view);
  draw_features(canvas, track, view);
  draw_start(canvas, track, view);
  const double strip = bottom + 22.0;
  draw_scale_bar(canvas, view, contour.units, strip);
  return draw_legend(canvas, track, comb, view, contour.units, coloured, widest, strip) + 16.0;
}

}  // namespace obvid
