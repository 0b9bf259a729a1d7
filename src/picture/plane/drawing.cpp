// SPDX-License-Identifier: Apache-2.0
#include "plane/drawing.h"

#include <algorithm>
#include <cmath>

#include "plane/panels.h"

namespace obvid {
namespace {

/// Longest tooth of the comb as part of the box's diagonal.
constexpr double kCombPart = 0.12;
constexpr int kTeeth = 180;
/// Below this curvature times size there is no comb: the contour is straight to the eye.
constexpr double kNoCombAngle = 1e-9;
/// Distance of the drawn cubics from the exact curve, px (half of what is promised).
constexpr double kDrawnWithin = 0.025;
constexpr int kDeepestSplit = 10;
/// Pieces shorter than this, px, are drawn as chords.
constexpr double kChordPx = 1.5;
/// Least distance between drawn points of a dense curve, px, and their aimed number.
constexpr double kThinStep = 0.6;
constexpr double kMostVertices = 30000.0;

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

}  // namespace

Vec2 PictureComb::tip(const PictureSample& sample) const {
  const double kappa = std::clamp(sample.kappa, -largest, largest);
  return sample.point - (per_kappa * kappa) * left_normal(sample.tangent);
}

PictureComb make_comb(const PictureTrack& track) {
  const double diagonal = track.box.diagonal();
  if (track.largest_kappa * diagonal < kNoCombAngle) return {};
  return {kCombPart * diagonal / track.largest_kappa, HUGE_VAL};
}

PictureComb cut_comb(PictureComb comb, const PictureScale& scale) {
  const double largest = std::max(std::fabs(scale.range.low), std::fabs(scale.range.high));
  if (!scale.cut || !(largest > 0.0 && largest < scale.largest)) return comb;
  comb.per_kappa *= scale.largest / largest;
  comb.largest = largest;
  return comb;
}

Box2 box_with_comb(const PictureTrack& track, const PictureComb& comb) {
  Box2 box = track.box;
  for (const PictureSample& sample : track.samples) box.add(comb.tip(sample));
  return box;
}

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
  if (kind == PictureFeature::Kind::kCorner) {
    canvas.add("<path class=\"corner\" d=\"M{} {}h13v13h-13z\"/>\n", px(at.x - 6.5),
               px(at.y - 6.5));
  } else if (kind == PictureFeature::Kind::kVertex) {
    canvas.add("<path class=\"vertex\" d=\"M{} {}l5.5 5.5-5.5 5.5-5.5-5.5z\"/>\n", px(at.x),
               px(at.y - 5.5));
  } else {
    canvas.add("<path class=\"inflection\" d=\"M{} {}l5.2 9h-10.4z\"/>\n", px(at.x),
               px(at.y - 6.0));
  }
}

void draw_curve(PictureCanvas& canvas, const PictureTrack& track, const PictureView& view,
                bool coloured) {
  const double step = std::max(kThinStep, track.length * view.scale / kMostVertices);
  for (const int colour : kPictureColours) {
    PicturePath path;
    bool pen_down = false;
    bool whole = true;
    for (std::size_t i = 0; i < track.pieces.size(); ++i) {
      if (colour_of(track, i, coloured) != colour) {
        whole = false;
        if (pen_down) path.line(view(start_point(track.pieces[i])));
        pen_down = false;
        continue;
      }
      if (!pen_down) path.move(view(start_point(track.pieces[i])));
      pen_down = true;
      add_piece(path, track.pieces[i], view, step);
    }
    if (pen_down) {
      path.line(view(end_point(track.pieces.back())));
      if (track.closed && whole) path.close();
    }
    if (!path.empty()) {
      canvas.add("<path class=\"curve {}\" d=\"{}\"/>\n", run_css(colour), path.text());
    }
  }
}

void draw_comb(PictureCanvas& canvas, const PictureTrack& track, const PictureComb& comb,
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
  for (const int colour : kPictureColours) {
    PicturePath path;
    bool pen_down = false;
    for (std::size_t i = 0; i < track.pieces.size(); ++i) {
      const bool mine = colour_of(track, i, coloured) == colour;
      pen_down = pen_down && !track.corner[i];
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
  for (const auto kind : {PictureFeature::Kind::kCorner, PictureFeature::Kind::kInflection,
                          PictureFeature::Kind::kVertex}) {
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

}  // namespace obvid
