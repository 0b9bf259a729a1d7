// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/points/airfoil.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "obvid/core/internal/format_into.h"
#include "points/airfoil_shape.h"

namespace obvid {
namespace {

constexpr std::size_t kFewestPoints = 5, kMostPoints = 100'000;  // points that are written
/// Chords, of thickness and camber: that may be asked for; less is what rounded coordinates leave.
constexpr double kMostHeight = 0.5, kLeastHeight = 1e-5;
constexpr double kFinest = 1e-8;  // of the chord: a unit of the last digit is no larger

/// What multiplies the distance of both sides and their middle, normal to the chord.
struct SideScale {
  double thickness = 1.0, camber = 1.0;

  [[nodiscard]] bool is_none() const { return thickness == 1.0 && camber == 1.0; }
  /// Of a height or slope of a side at a place where the other side has another one.
  [[nodiscard]] double of(double own, double other) const {
    const double middle = 0.5 * (own + other);
    return camber * middle + thickness * (own - middle);
  }
};

/// The sides as they are written, along the chord: scaled, moved apart by an amount times (x /
/// chord)^2, and ended by an arc where the edge is round. Places are arc lengths from the leading
/// edge, of the sides before they are moved.
class WrittenSides {
 public:
  WrittenSides(const Airfoil& foil, const SideScale& scale, double more)
      : foil_(foil), scale_(scale), more_(more) {
    for (const bool upper : {true, false}) side(upper).ends = foil.side_length(upper);
  }
  /// Moved so that an arc of this radius touches both sides and reaches to the end of the chord.
  /// Error: E203 where none does.
  [[nodiscard]] static Result<WrittenSides> rounded(const Airfoil& foil, const SideScale& scale,
                                                    double radius);

  [[nodiscard]] double more() const { return more_; }
  [[nodiscard]] bool is_round() const { return radius_ > 0.0; }
  /// x at which the arc begins, and where along the side.
  [[nodiscard]] double arc_from(bool upper) const { return foil_.x_on(upper, side(upper).ends); }
  [[nodiscard]] double arc_place(bool upper) const { return side(upper).ends; }
  /// From the chord to the direction of the hindmost point of the arc, rad.
  [[nodiscard]] double chord_turn() const { return turn_; }

  [[nodiscard]] double length(bool upper) const {
    return side(upper).ends + radius_ * std::abs(side(upper).turn);
  }
  [[nodiscard]] Vec2 point(bool upper, double s) const;
  [[nodiscard]] double x_on(bool upper, double s) const {
    return is_round() ? dot(point(upper, s), Vec2{std::cos(turn_), std::sin(turn_)})
                      : foil_.x_on(upper, s);
  }
  [[nodiscard]] double kappa(bool upper, double s) const {
    return is_on_arc(upper, s) ? 1.0 / radius_ : std::abs(foil_.on_side(upper, s).kappa);
  }
  [[nodiscard]] double place_of(bool upper, double x) const;
  [[nodiscard]] std::size_t looks() const { return foil_.looks(); }

 private:
  struct Side {
    double ends = 0.0;  ///< where the arc begins, else the end of the side
    double turn = 0.0;  ///< of the arc, rad: from its hindmost point to where it begins
  };
  [[nodiscard]] Side& side(bool upper) { return sides_[upper ? 0 : 1]; }
  [[nodiscard]] const Side& side(bool upper) const { return sides_[upper ? 0 : 1]; }

  [[nodiscard]] bool is_on_arc(bool upper, double s) const {
    return is_round() && s > side(upper).ends;
  }

  const Airfoil& foil_;
  SideScale scale_;
  double more_ = 0.0;  ///< of the trailing edge, units
  double radius_ = 0.0, turn_ = 0.0;
  Vec2 centre_{};
  std::array<Side, 2> sides_{};
};

Vec2 WrittenSides::point(bool upper, double s) const {
  const Side& on = side(upper);
  if (is_on_arc(upper, s)) {
    const double left = 1.0 - (s - on.ends) / (radius_ * std::abs(on.turn));
    const double a = turn_ + on.turn * std::max(left, 0.0);
    return centre_ + radius_ * Vec2{std::cos(a), std::sin(a)};
  }
  Vec2 q = foil_.local(foil_.on_side(upper, s).point);
  if (!scale_.is_none()) q.y = scale_.of(q.y, foil_.height(!upper, q.x));
  const double x = q.x / foil_.chord();
  q.y += (upper ? 0.5 : -0.5) * more_ * x * x;
  return q;
}

double WrittenSides::place_of(bool upper, double x) const {
  return place_with_x(x, length(upper), [&](double s) { return x_on(upper, s); });
}

Result<WrittenSides> WrittenSides::rounded(const Airfoil& foil, const SideScale& scale,
                                           double radius) {
  constexpr int kSteps = 200;         // each gains some digits: the sides are nearly straight there
  constexpr double kSettled = 1e-15;  // of the chord
  const double c = foil.chord();
  WrittenSides out(foil, scale, 0.0);
  out.radius_ = radius;
  out.centre_.x = c - radius;
  // slopes of the moved sides where the arc touches them, and x there
  std::array<double, 2> slope{}, x{out.centre_.x, out.centre_.x};
  // height and slope of a side before it is moved
  const auto side_at = [&](bool upper, double at) {
    const auto place = foil.on_side(upper, foil.place_of(upper, at));
    const Vec2 tangent = foil.local(foil.leading() + place.tangent);
    return Vec2{foil.local(place.point).y, tangent.y / tangent.x};
  };
  const auto no_room = [&] {
    return error(ErrorCode::kBadOption, "no arc of this diameter touches both sides")
        .where("--trailing-edge-form")
        .hint("choose a thinner --trailing-edge")
        .value(2.0 * radius / c);
  };
  for (int k = 0; k < kSteps; ++k) {
    std::array<double, 2> y{}, up{};  // heights before the sides are moved; of the normals
    for (const bool upper : {true, false}) {
      const std::size_t i = upper ? 0 : 1;
      if (!(x[i] > 0.0)) return no_room();
      Vec2 here = side_at(upper, x[i]);
      if (!scale.is_none()) {
        const Vec2 other = side_at(!upper, x[i]);
        here = {scale.of(here.x, other.x), scale.of(here.y, other.y)};
      }
      y[i] = here.x;
      const double moved = (upper ? 1.0 : -1.0) * out.more_ * x[i] / (c * c);
      slope[i] = here.y + moved;
      if (!std::isfinite(slope[i])) return no_room();
      up[i] = 1.0 / std::sqrt(1.0 + slope[i] * slope[i]);
    }
    const double before = out.more_;
    const double squares = (x[0] * x[0] + x[1] * x[1]) / (c * c);
    out.more_ = 2.0 * (radius * (up[0] + up[1]) - (y[0] - y[1])) / squares;
    const double top = y[0] + 0.5 * out.more_ * x[0] * x[0] / (c * c);
    out.centre_.y = top - radius * up[0];
    // the hindmost point is the one farthest from the leading edge: a chord away
    const double along = (c - radius) * (c - radius) - out.centre_.y * out.centre_.y;
    if (!(along > 0.0)) return no_room();
    out.centre_.x = std::sqrt(along);
    x = {out.centre_.x - radius * slope[0] * up[0], out.centre_.x + radius * slope[1] * up[1]};
    if (k == 0 || std::abs(out.more_ - before) > kSettled * c) continue;
    out.turn_ = std::atan2(out.centre_.y, out.centre_.x);
    for (const bool upper : {true, false}) {
      const std::size_t i = upper ? 0 : 1;
      out.side(upper).ends = foil.place_of(upper, x[i]);
      const Vec2 to = out.point(upper, out.side(upper).ends) - out.centre_;
      out.side(upper).turn = std::atan2(to.y, to.x) - out.turn_;
    }
    return out;
  }
  return no_room();
}

/// Arc lengths from the leading edge along a side in m steps, both ends among them.
std::vector<double> places(const WrittenSides& sides, bool upper, std::size_t m,
                           AirfoilSpacing spacing) {
  const double end = sides.length(upper), all = static_cast<double>(m);
  std::vector<double> out;
  std::vector<double> sums;
  const std::size_t looks = sides.looks();
  const double step = end / static_cast<double>(looks);
  if (spacing == AirfoilSpacing::kCurvature) {
    sums.push_back(0.0);
    for (std::size_t k = 0; k < looks; ++k) {
      const double s = (static_cast<double>(k) + 0.5) * step;
      sums.push_back(sums.back() + std::sqrt(sides.kappa(upper, s)) * step);
    }
    const double sum = sums.back();
    for (std::size_t k = 0; k <= looks; ++k) {
      const double even = static_cast<double>(k) / static_cast<double>(looks);
      sums[k] = sum > 0.0 ? 0.5 * (even + sums[k] / sum) : even;
    }
  }
  for (std::size_t k = 0; k <= m; ++k) {
    const double part = static_cast<double>(k) / all;
    if (k == 0 || k == m) {
      out.push_back(k == 0 ? 0.0 : end);
    } else if (spacing == AirfoilSpacing::kUniform) {
      out.push_back(part * end);
    } else if (spacing == AirfoilSpacing::kCosine) {
      const double x = 0.5 * (1.0 - std::cos(std::numbers::pi * part));
      out.push_back(sides.place_of(upper, x * sides.x_on(upper, end)));
    } else {
      const auto above = std::upper_bound(sums.begin(), sums.end(), part);
      const auto i = static_cast<std::size_t>(above - sums.begin()) - 1;
      out.push_back((static_cast<double>(i) + (part - sums[i]) / (sums[i + 1] - sums[i])) * step);
    }
  }
  return out;
}

/// Errors: E203.
Result<SideScale> scale_of(const AirfoilOptions& options, const AirfoilFigures& figures) {
  SideScale out;
  if (options.thickness) {
    if (!(*options.thickness > 0.0 && *options.thickness < kMostHeight)) {
      return error(ErrorCode::kBadOption,
                   "a thickness above 0 and below half of the chord is expected")
          .where("--thickness")
          .hint("for example 12% or 0.12")
          .value(*options.thickness);
    }
    if (!(figures.thickness > kLeastHeight)) {
      return error(ErrorCode::kBadOption, "the section has no thickness that could be scaled")
          .where("--thickness")
          .value(figures.thickness);
    }
    out.thickness = *options.thickness / figures.thickness;
  }
  if (options.camber) {
    if (!(std::abs(*options.camber) < kMostHeight)) {
      return error(ErrorCode::kBadOption, "a camber below half of the chord is expected")
          .where("--camber")
          .hint("for example 2% or 0.02")
          .value(*options.camber);
    }
    // what rounded coordinates leave of a symmetric section has no shape that can be scaled
    if (*options.camber != 0.0 && std::abs(figures.camber) < kLeastHeight) {
      return error(ErrorCode::kBadOption, "the section has no camber that could be scaled")
          .where("--camber")
          .hint("leave it out, or give 0")
          .value(figures.camber);
    }
    out.camber = *options.camber == 0.0 ? 0.0 : *options.camber / figures.camber;
  }
  return out;
}

/// The sides as the options ask for them. Errors: E203.
Result<WrittenSides> sides_of(const Airfoil& foil, const AirfoilOptions& options,
                              const AirfoilFigures& figures) {
  const double c = foil.chord();
  const auto scale = scale_of(options, figures);
  OBVID_TRY(scale);
  const auto scaled_end = [&](bool upper) {
    Vec2 at = foil.local(foil.end(upper));
    if (!scale->is_none()) at.y = scale->of(at.y, foil.height(!upper, at.x));
    return at;
  };
  const Vec2 a = scaled_end(true), b = scaled_end(false);
  const double thick =
      options.trailing_thickness.value_or(scale->thickness * figures.trailing_thickness);
  const bool round = options.trailing_form == TrailingEdgeForm::kRound && !figures.trailing_round;
  if (figures.trailing_round && options.trailing_thickness) {
    return error(ErrorCode::kBadOption, "the trailing edge is round already")
        .where("--trailing-edge")
        .hint("leave it out, or give another one to the contour that it was made from")
        .value(figures.trailing_thickness);
  }
  if (round && !(thick > 0.0)) {
    return error(ErrorCode::kBadOption, "a round trailing edge has a thickness")
        .where("--trailing-edge-form")
        .hint("give --trailing-edge too, for example 0.002");
  }
  // ends that lie at different places along the chord are moved by different amounts
  const double squares = (a.x * a.x + b.x * b.x) / (c * c);
  const double more = options.trailing_thickness ? 2.0 * (thick * c - (a.y - b.y)) / squares : 0.0;
  Result<WrittenSides> sides = round ? WrittenSides::rounded(foil, *scale, 0.5 * thick * c)
                                     : WrittenSides(foil, *scale, more);
  OBVID_TRY(sides);
  const bool as_contour = foil.goes_on(true) == 0.0 && foil.goes_on(false) == 0.0;
  if (!(sides->more() < 0.0) && as_contour) return sides;
  constexpr int kPlaces = 1000;
  for (int k = 1; k < kPlaces; ++k) {
    const double x = c * k / kPlaces;
    if (round && x > std::min(sides->arc_from(true), sides->arc_from(false))) break;
    const double moved = sides->more() * (x / c) * (x / c);
    const double apart = scale->thickness * (foil.height(true, x) - foil.height(false, x));
    if (apart + moved > 0.0) continue;
    return error(ErrorCode::kBadOption,
                 fmt::format("with this trailing edge the sides cross at {:.3f} chords", x / c))
        .hint("choose a thicker one")
        .value(thick);
  }
  return sides;
}

/// The airfoil with ends that can become one point, where a closed edge is asked for and they can.
Airfoil to_be_closed(Airfoil foil, const AirfoilOptions& options, AirfoilText& out) {
  if (options.trailing_thickness != 0.0 || options.trailing_form != TrailingEdgeForm::kBlunt ||
      foil.edge_radius() > 0.0) {
    return foil;
  }
  const double c = foil.chord();
  const Vec2 apart = foil.local(foil.end(true)) - foil.local(foil.end(false));
  ClosedEdge closed;
  closed.gap = std::abs(apart.x) / c;
  closed.upper = apart.x < 0.0;
  Airfoil level = foil;
  if (auto done = level.level_ends(); !done) {
    closed.left_open = done.error().what;
  } else if (const AirfoilFigures figures = level.figures();
             !(level.runs_along(true) && level.runs_along(false) &&
               sides_of(level, options, figures))) {
    closed.left_open = "it would meet the other side before";
  } else {
    closed.gone_on = level.goes_on(closed.upper) / level.chord();
    const auto scale = scale_of(options, figures);
    closed.moved = 0.5 * figures.trailing_thickness * (scale ? scale->thickness : 1.0);
  }
  out.closed = closed;
  return closed.left_open.empty() ? level : foil;
}

}  // namespace

Result<AirfoilText> airfoil_text(const Contour& contour, const AirfoilOptions& options) {
  if (options.count < kFewestPoints || options.count > kMostPoints) {
    return error(ErrorCode::kBadOption, "an airfoil has 5 to 100,000 points")
        .hint("for example 161")
        .value(static_cast<double>(options.count));
  }
  auto made = airfoil_of(contour);
  OBVID_TRY(made);
  AirfoilText out;
  const Airfoil foil = to_be_closed(std::move(*made), options, out);
  out.figures = foil.figures();
  const double c = foil.chord();
  const auto scale = scale_of(options, out.figures);
  OBVID_TRY(scale);
  out.thickness_scale = scale->thickness;
  out.camber_scale = scale->camber;
  const auto written = sides_of(foil, options, out.figures);
  OBVID_TRY(written);
  if (written->is_round()) {
    const double thick =
        options.trailing_thickness.value_or(scale->thickness * out.figures.trailing_thickness);
    out.rounded = {thick, written->arc_from(true) / c, written->arc_from(false) / c, 0,
                   written->chord_turn()};
  }
  const std::size_t below = (options.count - 1) / 2, above = options.count - 1 - below;
  std::vector<Vec2> sides[2];
  const auto as_written = [&](Vec2 q) {
    if (!options.unit_chord) return foil.back(q);
    if (!out.rounded) return Vec2{q.x / c, q.y / c};
    const Vec2 along{std::cos(out.rounded->turn), std::sin(out.rounded->turn)};
    return Vec2{dot(along, q) / c, cross(along, q) / c};
  };
  for (const bool upper : {true, false}) {
    for (const double s : places(*written, upper, upper ? above : below, options.spacing)) {
      sides[upper ? 0 : 1].push_back(as_written(written->point(upper, s)));
      if (out.rounded && s >= written->arc_place(upper)) ++out.rounded->points;
    }
  }
  if (out.rounded) --out.rounded->points;             // both sides end at the same one
  if (out.closed && out.closed->left_open.empty()) {  // but for rounding they end at one point
    sides[0].back() = sides[1].back() = 0.5 * (sides[0].back() + sides[1].back());
  }
  out.upper = sides[0].size();
  out.lower = sides[1].size();
  const double size = options.unit_chord ? 1.0 : c;
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(kFinest * size))), 0, 17);
  out.last_digit = std::pow(10.0, -digits);
  const auto add = [&](Vec2 p) {
    // no "-0.000"
    const double least = 0.5 * out.last_digit;
    const double x = std::abs(p.x) < least ? 0.0 : p.x, y = std::abs(p.y) < least ? 0.0 : p.y;
    format_into(out.text, " {:.{}f} {:.{}f}\n", x, digits, y, digits);
  };
  out.text = options.name + "\n";
  if (options.layout == AirfoilLayout::kSelig) {
    std::for_each(sides[0].rbegin(), sides[0].rend(), add);
    std::for_each(sides[1].begin() + 1, sides[1].end(), add);
    return out;
  }
  format_into(out.text, " {}. {}.\n\n", out.upper, out.lower);
  std::for_each(sides[0].begin(), sides[0].end(), add);
  out.text += "\n";
  std::for_each(sides[1].begin(), sides[1].end(), add);
  return out;
}

}  // namespace obvid
