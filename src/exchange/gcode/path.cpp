// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/gcode/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "obvid/core/internal/format_into.h"
#include "obvid/exchange/internal/gcode/gcode_limits.h"
#include "obvid/numeric/internal/wide.h"

namespace obvid::exchange {
namespace {

using numeric::Wide;

std::string never_minus_zero(std::string text) {
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text[0] == '-' ? text.substr(1) : text;
}

/// What the radii of an arc may differ at its ends, mm or inches: what five decimals of the centre
/// can make of it. Where digits are missing for that it becomes a line.
constexpr double kMostMismatch = 1.6e-5;

/// A whole number of last digits as a decimal fraction.
std::string decimal(std::int64_t last_digits, int decimals) {
  std::int64_t one = 1;
  for (int i = 0; i < decimals; ++i) one *= 10;
  const std::int64_t size = std::abs(last_digits);
  return fmt::format("{}{}.{:0{}}", last_digits < 0 ? "-" : "", size / one, size % one, decimals);
}

/// A centre seen from the start of an arc, as printed.
struct Centre {
  std::string i, j;
  Vec2 ij;
  double mismatch = 0.0;  ///< of the radii at both ends
};

/// The nearest whole number; below 2^62.
std::int64_t rounded(Wide value) {
  const std::int64_t first = std::llround(static_cast<double>(value));
  return first + std::llround(static_cast<double>(value - Wide::whole(first)));
}

/// Digits of a double do not do: a centre far away has to lie on the chord's bisector in all
/// decimals that are printed, and last digits of large coordinates are more than 53 bits.
/// `above`: height of the centre over the middle of the chord (`x`, `y`).
Centre centre_over(Wide x, Wide y, double above, int decimals) {
  const double length = std::hypot(static_cast<double>(x), static_cast<double>(y));
  const double part = above / length;  // wherever it is rounded to, the bisector goes through
  const Wide places = std::pow(10.0, decimals);
  const Wide wanted_i = (0.5 * x - part * y) * places;
  const Wide wanted_j = (0.5 * y + part * x) * places;
  constexpr double kMostLastDigits = 0x1p62;
  if (!(std::hypot(static_cast<double>(wanted_i), static_cast<double>(wanted_j)) <
        kMostLastDigits)) {
    return {{}, {}, {}, HUGE_VAL};
  }
  const std::int64_t last_i = rounded(wanted_i), last_j = rounded(wanted_j);
  const Wide i = Wide::whole(last_i) / places, j = Wide::whole(last_j) / places;
  Centre out{decimal(last_i, decimals), decimal(last_j, decimals), {}, 0.0};
  out.ij = {static_cast<double>(i), static_cast<double>(j)};
  // |ij|^2 - |ij - chord|^2 over the sum of the roots
  const double squares = std::abs(static_cast<double>((2.0 * i - x) * x + (2.0 * j - y) * y));
  const double radii =
      norm(out.ij) + std::hypot(static_cast<double>(i - x), static_cast<double>(j - y));
  // what rounding of these lines hides: quotients, products and sums of `Wide`, and of the doubles
  // that tell the rest
  constexpr double kWideRoundings = 64.0 * numeric::kUnitRoundoff * numeric::kUnitRoundoff;
  constexpr double kRoundings = 16.0 * numeric::kUnitRoundoff;
  out.mismatch = (1.0 + kRoundings) * (squares / radii) + kWideRoundings * radii;
  return out;
}

}  // namespace

std::size_t blocks_of_turn(double turn) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(turn / kMostBlockTurn)));
}

std::string fixed(double value, int decimals) {
  return never_minus_zero(fmt::format("{:.{}f}", value, decimals));
}

GcodePath::GcodePath(double scale, int decimals)
    : scale_(scale), unit_(std::pow(10.0, -decimals)), decimals_(decimals) {}

GcodePath GcodePath::from_here() const {
  GcodePath out(scale_, decimals_);
  out.start_ = out.at_ = at_;
  return out;
}

bool GcodePath::holds(double coordinate) const {
  constexpr double kMostLastDigits = 0x1p60;  // of a 64-bit number, with room for differences
  return std::abs(scale_ * coordinate) < kMostLastDigits * unit_;
}

GridPlace GcodePath::printed(Vec2 machine) const {
  const double places = std::pow(10.0, decimals_);
  return {std::llround(machine.x * places), std::llround(machine.y * places)};
}

std::string GcodePath::number(std::int64_t last_digits) const {
  return decimal(last_digits, decimals_);
}

std::string GcodePath::place(GridPlace at) const {
  return fmt::format("X{} Y{}", number(at.x), number(at.y));
}

Vec2 GcodePath::between(GridPlace from, GridPlace to) const {
  const double places = std::pow(10.0, decimals_);  // exact, unlike a last digit
  return {static_cast<double>(to.x - from.x) / places, static_cast<double>(to.y - from.y) / places};
}

std::string GcodePath::start() const { return place(start_); }

void GcodePath::start_at(Vec2 point) { start_ = at_ = printed(scale_ * point); }

void GcodePath::line_to(Vec2 point) { line(printed(scale_ * point)); }

void GcodePath::line(GridPlace end) {
  if (end == at_) return;  // the next block starts where the tool stands: nothing drifts
  format_into(text_, "G1 {}{}\n", place(end), behind());
  pieces_.emplace_back(LinePiece{in_contour(at_), in_contour(end)});
  at_ = end;
}

void GcodePath::follow_arc(const ArcPiece& arc_piece) {
  const double turn = std::abs(arc_piece.kappa * arc_piece.length);
  const std::size_t blocks = blocks_of_turn(turn);
  const auto parts = static_cast<double>(blocks);
  for (std::size_t i = 1; i <= blocks; ++i) {
    const auto k = static_cast<double>(i);
    const Vec2 middle = scale_ * evaluate(arc_piece, (k - 0.5) / parts).point;
    const Vec2 end = evaluate(arc_piece, k / parts).point;
    arc(middle, printed(scale_ * end), arc_piece.kappa > 0.0);
  }
}

/// The arc over the printed chord with the height of the exact one: of all that can be kept it
/// moves the arc least.
void GcodePath::arc(Vec2 middle, GridPlace end, bool left) {
  const Vec2 chord = between(at_, end);
  const double length = norm(chord);
  if (length < kShortestChord * unit_) return line(end);
  const Vec2 across = left_normal(chord) / length;
  const double height =
      dot(middle - between({}, at_), across);  // of the middle, below the chord: negative
  const double radius = 0.5 * std::abs(height) + 0.125 * length * length / std::abs(height);
  const bool wrong_side = (height < 0.0) != left;
  if (wrong_side || std::abs(height) < kLowestArc * unit_ || radius < kSmallestRadius) {
    return line(end);
  }
  const Wide places = std::pow(10.0, decimals_);
  const Centre centre =
      centre_over(Wide::whole(end.x - at_.x) / places, Wide::whole(end.y - at_.y) / places,
                  height + (left ? radius : -radius), std::max(kLeastCentreDecimals, decimals_));
  if (!(centre.mismatch <= kMostMismatch)) {
    lost_arcs_ = true;
    return line(end);
  }
  radius_mismatch_ = std::max(radius_mismatch_, centre.mismatch / scale_);
  const Vec2 ij = centre.ij;
  format_into(text_, "{} {} I{} J{}{}\n", left ? "G3" : "G2", place(end), centre.i, centre.j,
              behind());
  // the controller's arc: it leaves square to its radius, and its chord says the rest
  const Vec2 tangent = (left ? 1.0 : -1.0) * left_normal(-ij);
  const double angle = turning(tangent, chord);
  const double own_kappa = 2.0 * std::sin(angle) / length;
  pieces_.emplace_back(ArcPiece{in_contour(at_), in_contour(end), heading(tangent),
                                own_kappa * scale_, 2.0 * angle / own_kappa / scale_});
  ++arcs_;
  at_ = end;
}

void GcodePath::follow_cubic(const RationalBezier& cubic) {
  const auto point = [&](std::size_t j) { return scale_ * (cubic.origin + cubic.offset[j]); };
  const GridPlace end = printed(point(3));
  if (end == at_) return;
  const GridPlace first = printed(point(1) - between({}, at_));
  const GridPlace second = printed(point(2) - between({}, end));
  format_into(text_, "G5 I{} J{} P{} Q{} {}{}\n", number(first.x), number(first.y),
              number(second.x), number(second.y), place(end), behind());
  RationalBezier path;
  path.degree = 3;
  path.offset = {in_contour(at_), in_contour(at_) + in_contour(first),
                 in_contour(end) + in_contour(second), in_contour(end)};
  path.weight = {1.0, 1.0, 1.0, 1.0};
  pieces_.emplace_back(path);
  at_ = end;
}

}  // namespace obvid::exchange
