// SPDX-License-Identifier: Apache-2.0
#include "gcode_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "obvid/core/format_into.h"

namespace obvid::exchange {
namespace {

constexpr int kCentreDecimals = 5;
constexpr double kMostBlockTurn = 2.8;   // of one block, rad: well below half a turn
constexpr double kLowestArc = 0.5;       // last digits: height of arcs that are told as such
constexpr double kShortestChord = 20.0;  // last digits: below, rounding turns an arc too much
/// A radius that LinuxCNC takes for none (0.00127 mm), and some.
constexpr double kSmallestRadius = 0.002;

double round_to(double value, int decimals) {
  const double places = std::pow(10.0, decimals);
  return std::round(value * places) / places;
}

}  // namespace

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text[0] == '-' ? text.substr(1) : text;
}

GcodePath::GcodePath(double scale, int decimals)
    : scale_(scale), unit_(std::pow(10.0, -decimals)), decimals_(decimals) {}

Vec2 GcodePath::printed(Vec2 machine) const {
  return {round_to(machine.x, decimals_), round_to(machine.y, decimals_)};
}

std::string GcodePath::place(Vec2 machine) const {
  return "X" + fixed(machine.x, decimals_) + " Y" + fixed(machine.y, decimals_);
}

std::string GcodePath::start() const { return place(start_); }

void GcodePath::start_at(Vec2 point) { start_ = at_ = printed(scale_ * point); }

void GcodePath::line_to(Vec2 point) { line(printed(scale_ * point)); }

void GcodePath::line(Vec2 end) {
  if (end == at_) return;  // the next block starts where the tool stands: nothing drifts
  format_into(text_, "G1 {}\n", place(end));
  pieces_.emplace_back(LinePiece{at_ / scale_, end / scale_});
  at_ = end;
}

void GcodePath::follow_arc(const ArcPiece& arc_piece) {
  const double turn = std::abs(arc_piece.kappa * arc_piece.length);
  const int parts = std::max(1, static_cast<int>(std::ceil(turn / kMostBlockTurn)));
  for (int k = 1; k <= parts; ++k) {
    const Vec2 middle = evaluate(arc_piece, (k - 0.5) / parts).point;
    const Vec2 end = evaluate(arc_piece, static_cast<double>(k) / parts).point;
    arc(scale_ * middle, printed(scale_ * end), arc_piece.kappa > 0.0);
  }
}

/// The arc over the printed chord with the height of the exact one: of all that can be kept it
/// moves the arc least.
void GcodePath::arc(Vec2 middle, Vec2 end, bool left) {
  const Vec2 chord = end - at_;
  const double length = norm(chord);
  if (length < kShortestChord * unit_) return line(end);
  const Vec2 across = left_normal(chord) / length;
  const double height = dot(middle - at_, across);  // of the middle, below the chord: negative
  const double radius = 0.5 * std::abs(height) + 0.125 * length * length / std::abs(height);
  const bool wrong_side = (height < 0.0) != left;
  if (wrong_side || std::abs(height) < kLowestArc * unit_ || radius < kSmallestRadius) {
    return line(end);
  }
  const Vec2 to_centre = 0.5 * chord + (height + (left ? radius : -radius)) * across;
  const Vec2 ij = {round_to(to_centre.x, kCentreDecimals), round_to(to_centre.y, kCentreDecimals)};
  format_into(text_, "{} {} I{} J{}\n", left ? "G3" : "G2", place(end),
              fixed(ij.x, kCentreDecimals), fixed(ij.y, kCentreDecimals));
  // the controller's arc: it leaves square to its radius, and its chord says the rest
  const Vec2 tangent = (left ? 1.0 : -1.0) * left_normal(-ij);
  const double angle = turning(tangent, chord);
  const double own_kappa = 2.0 * std::sin(angle) / length;
  pieces_.emplace_back(ArcPiece{at_ / scale_, end / scale_, heading(tangent), own_kappa * scale_,
                                2.0 * angle / own_kappa / scale_});
  ++arcs_;
  at_ = end;
}

void GcodePath::follow_cubic(const RationalBezier& cubic) {
  const auto point = [&](std::size_t j) { return scale_ * (cubic.origin + cubic.offset[j]); };
  const Vec2 end = printed(point(3));
  const Vec2 first = printed(point(1) - at_), second = printed(point(2) - end);
  if (end == at_) return;
  format_into(text_, "G5 I{} J{} P{} Q{} {}\n", fixed(first.x, decimals_),
              fixed(first.y, decimals_), fixed(second.x, decimals_), fixed(second.y, decimals_),
              place(end));
  RationalBezier path;
  path.degree = 3;
  path.offset = {at_ / scale_, (at_ + first) / scale_, (end + second) / scale_, end / scale_};
  path.weight = {1.0, 1.0, 1.0, 1.0};
  pieces_.emplace_back(path);
  at_ = end;
}

}  // namespace obvid::exchange
