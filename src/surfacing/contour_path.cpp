// SPDX-License-Identifier: Apache-2.0
#include "contour_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace obvid {
namespace {

/// Parts of a rational piece between entries of its table: with five points of Gauss each, the
/// arc length of a spiral is known to rounding.
constexpr std::size_t kParts = 16;
constexpr double kPart = 1.0 / static_cast<double>(kParts);

double speed(const RationalBezier& piece, double t) { return norm(evaluate(piece, t).d1); }

/// Arc length of [a, b], a short part of a piece: Gauss and Legendre, five points.
double length_between(const RationalBezier& piece, double a, double b) {
  constexpr std::array<double, 3> node = {0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weight = {0.5688888888888889, 0.4786286704993665,
                                            0.2369268850561891};
  const double half = (b - a) / 2.0, middle = (a + b) / 2.0;
  double sum = weight[0] * speed(piece, middle);
  for (std::size_t i = 1; i < 3; ++i) {
    sum +=
        weight[i] * (speed(piece, middle - half * node[i]) + speed(piece, middle + half * node[i]));
  }
  return half * sum;
}

double stored_length(const Piece& piece) {
  if (const auto* line = std::get_if<LinePiece>(&piece)) return norm(line->end - line->start);
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return arc->length;
  if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) return clothoid->length;
  return 0.0;
}

}  // namespace

ContourPath::ContourPath(const Contour& contour) : pieces_(contour.pieces) {
  start_.reserve(pieces_.size() + 1);
  start_.push_back(0.0);
  for (const Piece& piece : pieces_) {
    Table table;
    double length = stored_length(piece);
    if (const auto* rational = std::get_if<RationalBezier>(&piece)) {
      length = 0.0;
      for (std::size_t i = 0; i <= kParts; ++i) {
        const double t = static_cast<double>(i) * kPart;
        if (i > 0) length += length_between(*rational, t - kPart, t);
        table.length.push_back(length);
        table.speed.push_back(speed(*rational, t));
      }
    }
    table_.push_back(std::move(table));
    start_.push_back(start_.back() + length);
  }
}

double ContourPath::parameter(std::size_t piece, double s) const {
  const auto& [length, speeds] = table_[piece];
  const auto above = std::upper_bound(length.begin() + 1, length.end() - 1, s);
  const auto part = static_cast<std::size_t>(above - length.begin()) - 1;
  const auto& curve = std::get<RationalBezier>(pieces_[piece]);
  const double from = static_cast<double>(part) * kPart, wanted = s - length[part];
  // The inverse function's cubic by values and slopes at the ends of the part is good to some 1e-7
  // of the part where the speed is even: mostly one step of Newton leaves rounding.
  const double all = length[part + 1] - length[part], x = wanted / all, y = 1.0 - x;
  double t = from + kPart * x * x * (3.0 - 2.0 * x) + all * x * y * y / speeds[part] -
             all * x * x * y / speeds[part + 1];
  constexpr int kMostSteps = 10;
  constexpr double kEnough = 1e-9;  // of the parameter: the next step would be the square of it
  for (int step = 0; step < kMostSteps; ++step) {
    t = std::clamp(t, from, from + kPart);
    const double move = (length_between(curve, from, t) - wanted) / speed(curve, t);
    t -= move;
    if (std::abs(move) < kEnough) break;
  }
  return std::clamp(t, 0.0, 1.0);
}

ContourPath::Place ContourPath::at(double s, bool before_joint) const {
  const auto first = start_.begin() + 1, last = start_.end() - 1;
  const auto above =
      before_joint ? std::lower_bound(first, last, s) : std::upper_bound(first, last, s);
  const auto k = static_cast<std::size_t>(above - start_.begin()) - 1;
  const double inside = std::clamp(s - start_[k], 0.0, start_[k + 1] - start_[k]);
  const double all = start_[k + 1] - start_[k];
  const double t = !table_[k].length.empty() ? parameter(k, inside)
                   : all > 0.0               ? inside / all
                                             : 0.0;
  const Jet jet = evaluate(pieces_[k], t);
  return {jet.point, jet.d1 / norm(jet.d1), curvature(jet)};
}

double ContourPath::nearest(Vec2 p, double guess, double from, double to) const {
  double s = std::clamp(guess, from, to);
  const double settled = 1e-14 * length();  // arc lengths are not known better
  for (int step = 0; step < 50; ++step) {
    const Place place = at(s);
    const Vec2 away = p - place.point;
    // Newton for the foot of the perpendicular; where the point lies beyond the centre of
    // curvature the plain step goes downhill all the same
    const double bend = 1.0 - place.kappa * dot(away, left_normal(place.tangent));
    const double move = dot(away, place.tangent) / std::max(bend, 0.5);
    const double next = std::clamp(s + move, from, to);
    if (std::abs(next - s) <= settled) return next;
    s = next;
  }
  return s;
}

}  // namespace obvid
