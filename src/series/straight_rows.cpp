// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/straight_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "obvid/core/units.h"

namespace obvid {
namespace {

/// Turns from here on are corners of what is drawn with straight lines: a dodecagon turns by 30
/// degrees, and nobody draws a curve with fewer than 14 chords to the turn (25.7 degrees).
constexpr double kLargestTurn = 27.0 * kOneDegree;
/// Fewer turns do not tell a curve from a bend.
constexpr int kFewestTurns = 3;
/// Of the largest turn in the row. Turns that come from errors of the points are differences of
/// neighbouring headings: their sums stay below two of the largest, however long the row is.
constexpr double kProgress = 2.5;
/// Of a turn: three equal ones come out unequal in their last digits.
constexpr double kRounding = 1e-9;

/// Turns at the points between chords, in order; around a closed series at every point.
std::vector<double> turns_of(std::span<const Vec2> points, bool closed) {
  std::vector<double> out;
  const std::size_t n = points.size();
  if (n < 3) return out;
  const std::size_t first = closed ? 0 : 1, last = closed ? n : n - 1;
  for (std::size_t i = first; i < last; ++i) {
    const Vec2 before = points[(i + n - 1) % n], after = points[(i + 1) % n];
    out.push_back(turning(points[i] - before, after - points[i]));
  }
  return out;
}

/// Whether the heading goes one way along a row of turns.
class Row {
 public:
  void add(double turn) {
    if (turn != 0.0) ++turns_;
    largest_ = std::max(largest_, std::abs(turn));
    heading_ += turn;
    low_ = std::min(low_, heading_);
    high_ = std::max(high_, heading_);
    climb_ = std::max({climb_, heading_ - low_, high_ - heading_});
  }
  [[nodiscard]] bool is_curve() const {
    return turns_ >= kFewestTurns && climb_ >= (kProgress - kRounding) * largest_;
  }

 private:
  int turns_ = 0;
  double largest_ = 0.0, heading_ = 0.0, low_ = 0.0, high_ = 0.0, climb_ = 0.0;
};

}  // namespace

bool chords_of_curve(std::span<const Vec2> points, bool closed) {
  std::vector<double> turns = turns_of(points, closed);
  if (closed) {  // begin behind a corner, so that no row is cut
    const auto corner = std::find_if(turns.begin(), turns.end(),
                                     [](double t) { return std::abs(t) >= kLargestTurn; });
    if (corner != turns.end()) std::rotate(turns.begin(), corner, turns.end());
  }
  Row row;
  for (const double turn : turns) {
    if (std::abs(turn) < kLargestTurn) {
      row.add(turn);
      continue;
    }
    if (row.is_curve()) return true;
    row = {};
  }
  return row.is_curve();
}

}  // namespace obvid
