// SPDX-License-Identifier: Apache-2.0
#include "svg/path_builder.h"
#include "obvid/core/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obvid::exchange {
namespace {

// A rotation of decimal numbers, or several of them in a row, is one up to this (part of its
// scale): twelve digits, which is what most programs print at least.
constexpr double kSimilarity = 1e-12;

// Relative commands add up roundings: a path that ends so close to its start, as part of its
// largest coordinate, is closed.
constexpr double kClosedWithin = 1e-12;

// A quarter of an ellipse is one piece in spite of rounding.
constexpr double kQuarterSlack = 1e-9;  // of a quarter

void move_end(Piece& piece, Vec2 end) {
  if (auto* line = std::get_if<LinePiece>(&piece)) line->end = end;
  if (auto* arc = std::get_if<ArcPiece>(&piece)) arc->end = end;
  if (auto* bezier = std::get_if<RationalBezier>(&piece)) {
    bezier->offset[static_cast<std::size_t>(bezier->degree)] = end;
  }
}

}  // namespace

bool Affine::is_similarity() const {
  const double scale = std::hypot(a, b) + std::hypot(c, d);
  const double turned = std::hypot(a - d, b + c), mirrored = std::hypot(a + d, b - c);
  return std::min(turned, mirrored) <= kSimilarity * scale;
}

bool Affine::is_finite() const {
  return std::isfinite(a) && std::isfinite(b) && std::isfinite(c) && std::isfinite(d) &&
         std::isfinite(e) && std::isfinite(f);
}

Affine operator*(const Affine& outer, const Affine& inner) {
  return {outer.a * inner.a + outer.c * inner.b,
          outer.b * inner.a + outer.d * inner.b,
          outer.a * inner.c + outer.c * inner.d,
          outer.b * inner.c + outer.d * inner.d,
          outer.a * inner.e + outer.c * inner.f + outer.e,
          outer.b * inner.e + outer.d * inner.f + outer.f};
}

void SvgPathBuilder::move_to(Vec2 p) {
  end_part();
  here_ = start_ = p;
  extent_ = std::max(std::abs(p.x), std::abs(p.y));
}

void SvgPathBuilder::add(Piece piece, Vec2 end) {
  here_ = end;
  extent_ = std::max({extent_, std::abs(end.x), std::abs(end.y)});
  part_.pieces.push_back(std::move(piece));
}

void SvgPathBuilder::line_to(Vec2 p) {
  const Vec2 from = to_sheet_.point(here_), to = to_sheet_.point(p);
  if (!is_finite(from) || !is_finite(to)) finite_ = false;
  if (from == to) {
    ++empty_;
    here_ = p;
    return;
  }
  add(LinePiece{from, to}, p);
}

void SvgPathBuilder::bezier(const std::vector<Vec2>& points, Vec2 end) {
  RationalBezier piece;
  piece.degree = static_cast<int>(points.size()) - 1;
  bool single = true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    piece.offset[i] = to_sheet_.point(points[i]);
    piece.weight[i] = 1.0;
    if (!is_finite(piece.offset[i])) finite_ = false;
    if (piece.offset[i] != piece.offset[0]) single = false;
  }
  if (single) {
    ++empty_;
    here_ = end;
    return;
  }
  add(piece, end);
}

void SvgPathBuilder::quadratic_to(Vec2 q, Vec2 p) { bezier({here_, q, p}, p); }

void SvgPathBuilder::cubic_to(Vec2 q1, Vec2 q2, Vec2 p) { bezier({here_, q1, q2, p}, p); }

/// Centre and angles as in SVG 1.1, F.6.5; radii that are too small are scaled up (F.6.6).
void SvgPathBuilder::arc_to(const SvgArc& arc) {
  double rx = std::abs(arc.rx), ry = std::abs(arc.ry);
  if (arc.end == here_) {
    ++empty_;
    return;
  }
  if (!(rx > 0.0) || !(ry > 0.0)) return line_to(arc.end);
  const double rotation = arc.rotation_deg * kOneDegree;
  const Vec2 axis = unit_at(rotation);
  const Vec2 half = 0.5 * (here_ - arc.end);
  const Vec2 turned = {dot(axis, half) / rx, cross(axis, half) / ry};  // in the unit circle
  const double reach = norm(turned);
  if (reach > 1.0) {
    rx *= reach;
    ry *= reach;
  }
  const Vec2 chord = reach > 1.0 ? turned / reach : turned;
  // The middle between the ends where the radii just reach: no root of a rounding.
  const double square = dot(chord, chord);
  const double away = reach >= 1.0 ? 0.0 : std::sqrt(std::max(0.0, (1.0 - square) / square));
  const double side = arc.large == arc.sweep ? -1.0 : 1.0;
  const Vec2 centre = side * away * Vec2{chord.y, -chord.x};
  const double from = heading(chord - centre);
  double sweep = turning(chord - centre, -chord - centre);
  // Half a turn has either sign there; the flag decides.
  if (arc.sweep && sweep < 0.0) sweep += kFullTurn;
  if (!arc.sweep && sweep > 0.0) sweep -= kFullTurn;
  const Affine from_circle = {rx * axis.x, rx * axis.y, -ry * axis.y, ry * axis.x, 0.0, 0.0};
  const Vec2 middle = 0.5 * (here_ + arc.end) + from_circle.point(centre);
  ellipse_arc(middle, from_circle, from, sweep, arc.end);
}

void SvgPathBuilder::ellipse_arc(Vec2 centre, const Affine& from_circle, double from, double sweep,
                                 Vec2 end) {
  Affine placed = from_circle;
  placed.e = centre.x;
  placed.f = centre.y;
  const Affine whole = to_sheet_ * placed;
  if (!whole.is_finite() || !is_finite(to_sheet_.point(end))) {
    finite_ = false;
    here_ = end;
    return;
  }
  if (whole.is_similarity()) return circle_arc(to_sheet_.point(centre), sweep, end);
  const double quarters = std::abs(sweep) / (0.5 * std::numbers::pi);
  const int count = std::max(1, static_cast<int>(std::ceil(quarters - kQuarterSlack)));
  const double step = sweep / count, weight = std::cos(0.5 * step);
  Vec2 start = to_sheet_.point(here_);
  for (int k = 0; k < count; ++k) {
    const double a = from + k * step;
    RationalBezier piece;
    piece.degree = 2;
    piece.offset[0] = start;
    piece.offset[1] = whole.point(unit_at(a + 0.5 * step) / weight);
    start = k + 1 == count ? to_sheet_.point(end) : whole.point(unit_at(a + step));
    piece.offset[2] = start;
    piece.weight[0] = piece.weight[2] = 1.0;
    piece.weight[1] = weight;
    add(piece, end);
  }
}

void SvgPathBuilder::circle_arc(Vec2 centre, double sweep, Vec2 end) {
  ArcPiece arc;
  arc.start = to_sheet_.point(here_);
  arc.end = to_sheet_.point(end);
  const Vec2 outward = arc.start - centre;
  const double radius = 0.5 * (norm(outward) + norm(arc.end - centre));
  const double side = sweep * to_sheet_.determinant() > 0.0 ? 1.0 : -1.0;
  arc.theta0 = heading(side * left_normal(outward));
  arc.kappa = side / radius;
  arc.length = std::abs(sweep) * radius;
  if (!std::isfinite(arc.kappa) || !std::isfinite(arc.length)) finite_ = false;
  add(arc, end);
}

/// A line back to the start, unless the path is there already but for rounding.
void SvgPathBuilder::close() {
  if (!part_.pieces.empty()) {
    if (norm(here_ - start_) <= kClosedWithin * extent_) {
      move_end(part_.pieces.back(), to_sheet_.point(start_));
    } else {
      line_to(start_);
    }
    part_.closed = true;
  }
  end_part();
  here_ = start_;
  extent_ = std::max(std::abs(start_.x), std::abs(start_.y));
}

void SvgPathBuilder::end_part() {
  if (!part_.pieces.empty()) {
    if (start_point(part_.pieces.front()) == end_point(part_.pieces.back())) part_.closed = true;
    parts_.push_back(std::move(part_));
  }
  part_ = {};
}

std::vector<DrawnCurve> SvgPathBuilder::take() {
  end_part();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    parts_[i].label = parts_.size() == 1 ? label_ : fmt::format("{}, part {}", label_, i + 1);
  }
  return std::move(parts_);
}

}  // namespace obvid::exchange
