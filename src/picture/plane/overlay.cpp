// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/flatten.h"
#include "obvid/geom/internal/box.h"
#include "obvid/picture/internal/overlay_svg.h"
#include "plane/axis.h"
#include "plane/canvas.h"
#include "plane/frame.h"
#include "plane/legend.h"
#include "plane/panels.h"
#include "plane/sheet.h"
#include "plane/view.h"

namespace obvid {
namespace {

constexpr double kLongestPart = 0.12;           // of the diagonal: the largest deviation as drawn
constexpr double kMostOverlayHeight = 360.0;    // px
constexpr double kOverlayPadding = 18.0;        // px
constexpr double kDeviationPlotHeight = 170.0;  // px
constexpr double kDeviationPlotHead = 34.0;     // px
constexpr double kLineApart = 22.0;             // of lines of text, px
constexpr double kToothApart = 4.0;             // px
constexpr int kFewestDrawn = 2, kMostDrawn = 400;  // of a piece
constexpr double kDrawnChord = 5e-5;               // of the size: a twentieth of a px
constexpr double kOverlayThin = 0.3;               // px: shorter steps are left out
constexpr std::array kOverlayColours = {"up", "down", "even"};

/// Colour of a curve that is compared, and dashes where colours are used again.
std::string style_of(const char* kind, std::size_t curve) {
  const std::size_t k = curve - 1;
  return fmt::format("class=\"{} {}\"{}", kind, kOverlayColours[k % kOverlayColours.size()],
                     k < kOverlayColours.size() ? "" : " stroke-dasharray=\"7 3\"");
}

/// What is shown of the comparison, and where.
struct Overlay {
  const CurveComparison& compared;
  const std::vector<CurveDeviation>& deviations;
  bool aligned = false;
  double enlarged = 1.0;

  [[nodiscard]] const ComparedCurve& first() const { return compared.curves.front(); }
  /// Where a point of another curve is drawn, in coordinates of the first.
  [[nodiscard]] Vec2 placed(std::size_t curve, Vec2 p) const {
    if (!aligned || curve == 0) return p;
    const AirfoilFigures &to = *first().airfoil, &from = *compared.curves[curve].airfoil;
    return to.leading_edge + (to.chord / from.chord) * complex_product(unit_at(to.turn - from.turn),
                                                                       p - from.leading_edge);
  }
  [[nodiscard]] Vec2 tip(const DeviationPlace& place) const {
    return place.point + enlarged * place.deviation.value_or(0.0) * place.normal;
  }
};

double largest_of(const std::vector<CurveDeviation>& deviations) {
  double out = 0.0;
  for (const CurveDeviation& one : deviations) {
    if (one.largest) out = std::max(out, std::abs(*one.largest->deviation));
  }
  return out;
}

/// Points along a curve, with chords within `tolerance` of it.
template <class Visit>
void along_curve(const Contour& contour, double tolerance, const Visit& visit) {
  for (const Piece& piece : contour.pieces) {
    const int steps = chord_steps(piece, tolerance, kFewestDrawn, kMostDrawn);
    for (int k = 0; k <= steps; ++k) visit(evaluate(piece, double(k) / steps).point);
  }
}

/// Largest distance of a chord from its curve, a small part of a px of the picture.
double drawn_tolerance(const Contour& contour) {
  Box2 box;
  for (const Piece& piece : contour.pieces) {
    for (const double t : {0.0, 0.5, 1.0}) box.add(evaluate(piece, t).point);
  }
  return kDrawnChord * box.diagonal();
}

Box2 box_of(const Overlay& overlay, bool with_deviations) {
  Box2 box;
  for (std::size_t k = 0; k < overlay.compared.curves.size(); ++k) {
    along_curve(overlay.compared.curves[k].contour,
                drawn_tolerance(overlay.compared.curves[k].contour),
                [&](Vec2 p) { box.add(overlay.placed(k, p)); });
  }
  if (!with_deviations) return box;
  for (const CurveDeviation& one : overlay.deviations) {
    for (const DeviationPlace& place : one.places) box.add(overlay.tip(place));
  }
  return box;
}

void draw_true_curve(PictureCanvas& canvas, const Overlay& overlay, std::size_t curve,
                     const PictureView& view) {
  PicturePath path;
  bool open = false;
  along_curve(overlay.compared.curves[curve].contour,
              drawn_tolerance(overlay.compared.curves[curve].contour), [&](Vec2 p) {
                const Vec2 at = view(overlay.placed(curve, p));
                open ? path.thin_line(at, kOverlayThin) : path.move(at);
                open = true;
              });
  const std::string style = curve == 0 ? "class=\"curve plain\"" : style_of("graph", curve);
  canvas.add("<path {} d=\"{}\"/>\n", style, path.text());
}

/// Teeth along the normals of the first curve, and the line through their tips.
void draw_enlarged(PictureCanvas& canvas, const Overlay& overlay, const CurveDeviation& one,
                   const PictureView& view) {
  PicturePath teeth, envelope;
  bool open = false, toothed = false;
  Vec2 last;
  for (const DeviationPlace& place : one.places) {
    if (!place.deviation) {
      open = false;
      continue;
    }
    const Vec2 foot = view(place.point), tip = view(overlay.tip(place));
    open ? envelope.thin_line(tip, kOverlayThin) : envelope.move(tip);
    open = true;
    if (toothed && norm(foot - last) < kToothApart) continue;
    teeth.move(foot);
    teeth.line(tip);
    last = foot;
    toothed = true;
  }
  canvas.add("<path {} stroke-width=\".6\" d=\"{}\"/>\n", style_of("tooth", one.curve),
             teeth.text());
  canvas.add("<path {} d=\"{}\"/>\n", style_of("envelope", one.curve), envelope.text());
}

double draw_overlay(PictureCanvas& canvas, const Overlay& overlay, double top) {
  const Box2 box = box_of(overlay, true);
  const Vec2 size = box.size();
  const double width = kPictureWidth - 2.0 * (kPictureMargin + kOverlayPadding);
  PictureView view;
  if (size.x > 0.0 || size.y > 0.0) {
    view.scale = std::min(size.x > 0.0 ? width / size.x : HUGE_VAL,
                          size.y > 0.0 ? kMostOverlayHeight / size.y : HUGE_VAL);
  }
  const double height = size.y * view.scale + 2.0 * kOverlayPadding;
  view.centre = 0.5 * (box.low + box.high);
  view.middle = {0.5 * kPictureWidth, top + 0.5 * height};
  for (const CurveDeviation& one : overlay.deviations) draw_enlarged(canvas, overlay, one, view);
  for (std::size_t k = 0; k < overlay.compared.curves.size(); ++k) {
    draw_true_curve(canvas, overlay, k, view);
  }
  const double bottom = top + height + 18.0;
  draw_scale_bar(canvas, view, overlay.compared.units.text(), bottom);
  return bottom + kLineApart + 4.0;
}

/// A line for each curve: its colour, its name, what was measured.
double draw_names(PictureCanvas& canvas, const Overlay& overlay, double y) {
  constexpr double kLine = 30.0;
  const std::string units = overlay.aligned ? "% of the chord" : overlay.compared.units.text();
  const double unit = overlay.aligned ? 100.0 / overlay.first().airfoil->chord : 1.0;
  for (std::size_t k = 0; k < overlay.compared.curves.size(); ++k) {
    const std::string style = k == 0 ? "class=\"curve plain\"" : style_of("graph", k);
    canvas.add("<path {} d=\"M{} {}h{}\"/>\n", style, px(kPictureMargin), px(y - 4.0), px(kLine));
    std::string text = overlay.compared.curves[k].name;
    if (k == 0) {
      text += ": what the deviations are from";
    } else if (const CurveDeviation& one = overlay.deviations[k - 1]; one.largest) {
      text += fmt::format(": largest deviation {} {}, root mean square {}",
                          readable_number(unit * *one.largest->deviation, 3), units,
                          readable_number(unit * one.root_mean_square, 3));
      constexpr double kAll = 0.9995;  // prints as 100 %
      if (one.measured < kAll) {
        text += fmt::format(", measured on {:.1f} % of the length", 100.0 * one.measured);
      }
    } else {
      text += ": nothing to measure, no normal of the first curve meets it";
    }
    canvas.label({kPictureMargin + kLine + 10.0, y}, "start", "small", text);
    y += kLineApart;
  }
  return y;
}

/// Deviations of one side of airfoils, or of whole curves, over `x_of`.
template <class Taken, class Along>
void draw_deviation_graphs(PictureCanvas& canvas, const PictureFrame& frame, const Overlay& overlay,
                           double unit, const Taken& taken, const Along& x_of) {
  for (const CurveDeviation& one : overlay.deviations) {
    PicturePath path;
    bool open = false;
    for (const DeviationPlace& place : one.places) {
      if (!place.deviation || !taken(place)) {
        open = false;
        continue;
      }
      const Vec2 at{frame.px_x(x_of(place)), frame.px_y(unit * *place.deviation)};
      open ? path.thin_line(at, kOverlayThin) : path.move(at);
      open = true;
    }
    if (!path.empty()) {
      canvas.add("<path {} d=\"{}\"/>\n", style_of("graph", one.curve), path.text());
    }
  }
}

double draw_deviation_plots(PictureCanvas& canvas, const Overlay& overlay, double top) {
  const bool foil = overlay.compared.airfoils;
  const double unit = overlay.aligned ? 100.0 / overlay.first().airfoil->chord : 1.0;
  double low = 0.0, high = 0.0;
  for (const CurveDeviation& one : overlay.deviations) {
    for (const DeviationPlace& place : one.places) {
      low = std::min(low, unit * place.deviation.value_or(0.0));
      high = std::max(high, unit * place.deviation.value_or(0.0));
    }
  }
  PictureFrame frame;
  frame.x = foil ? tight_axis(0.0, 100.0, 10) : tight_axis(0.0, overlay.first().length, 8);
  frame.y = high > low ? round_axis(low, high, 5) : round_axis(-1.0, 1.0, 2);
  frame.bottom = top;
  const char* positive = overlay.compared.outward ? "outward" : "to the left";
  const std::string of = power_prefix(frame.y.exponent) +
                         (overlay.aligned ? "% of the chord" : overlay.compared.units.text());
  for (int k = 0; k < (foil ? 2 : 1); ++k) {
    frame.top = frame.bottom + kDeviationPlotHead;
    frame.bottom = frame.top + kDeviationPlotHeight;
    const bool upper = k == 0;
    const char* side = !foil ? "" : upper ? "Upper side: deviation" : "Lower side: deviation";
    canvas.label({kPictureMargin, frame.top - 11.0}, "start", "axis-title",
                 fmt::format("{}, {}, {} positive", foil ? side : "Deviation", of, positive));
    draw_grid(canvas, frame, !foil || !upper);
    if (foil) {
      draw_deviation_graphs(
          canvas, frame, overlay, unit,
          [&](const DeviationPlace& place) { return place.upper == upper; },
          [](const DeviationPlace& place) {
            return std::clamp(100.0 * place.along.value_or(0.0), 0.0, 100.0);
          });
    } else {
      draw_deviation_graphs(
          canvas, frame, overlay, unit, [](const DeviationPlace&) { return true; },
          [](const DeviationPlace& place) { return place.s; });
    }
    const double zero = frame.px_y(0.0);
    canvas.line({frame.left, zero}, {frame.right, zero}, "axis");
  }
  const std::string x = foil ? "Along the chord of " + overlay.first().name + ", %"
                             : "Arc length of " + overlay.first().name + ", " +
                                   power_prefix(frame.x.exponent) + overlay.compared.units.text();
  canvas.label({0.5 * (frame.left + frame.right), frame.bottom + 38.0}, "middle", "axis-title", x);
  return frame.bottom + 56.0;
}

}  // namespace

std::string overlay_svg(const CurveComparison& compared, std::optional<double> enlarge) {
  const bool aligned = !compared.on_one_chord.empty();
  Overlay overlay{compared, aligned ? compared.on_one_chord : compared.as_they_lie, aligned};
  const double most = largest_of(overlay.deviations);
  if (enlarge) {
    overlay.enlarged = *enlarge;
  } else if (most > 0.0) {
    const double diagonal = box_of(overlay, false).diagonal();
    overlay.enlarged = std::max(1.0, round_down(kLongestPart * diagonal / most));
  }
  std::string names;
  for (const ComparedCurve& curve : compared.curves)
    names += (names.empty() ? "" : ", ") + curve.name;
  const std::string title = "Over each other: " + names;
  const std::string fact =
      fmt::format("teeth and thin lines: deviation along the normals of {}, enlarged {} times{}",
                  compared.curves.front().name, readable_number(overlay.enlarged, 6),
                  aligned ? "; all on the chord of that" : "");
  PictureCanvas body;
  body.label({kPictureMargin, 40.0}, "start", "title", title);
  body.label({kPictureMargin, 62.0}, "start", "fact", fact);
  double y = draw_overlay(body, overlay, 78.0);
  y = draw_names(body, overlay, y);
  y = draw_deviation_plots(body, overlay, y);
  return picture_sheet(title, fact, body.take(), y);
}

}  // namespace obvid
