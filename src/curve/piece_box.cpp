// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/piece_box.h"

#include <variant>

namespace obvid {
namespace {

template <class Speed>
double turn_back(const Speed& speed, double from, double to) {
  constexpr int kHalvings = 60;
  const bool falls = speed(from) < 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (from + to);
    ((speed(middle) < 0.0) == falls ? from : to) = middle;
  }
  return from;
}

}  // namespace

void add_piece(Box2& box, const Piece& piece) {
  constexpr int kSteps = 64;  // such places lie farther apart, but for arcs of many turns
  box.add(start_point(piece));
  box.add(end_point(piece));
  if (std::holds_alternative<LinePiece>(piece)) return;
  for (const double Vec2::*axis : {&Vec2::x, &Vec2::y}) {
    const auto speed = [&](double t) { return evaluate(piece, t).d1.*axis; };
    double before = speed(0.0);
    for (int i = 1; i <= kSteps; ++i) {
      const double t = static_cast<double>(i) / kSteps, here = speed(t);
      if ((before < 0.0) != (here < 0.0)) {
        box.add(evaluate(piece, turn_back(speed, t - 1.0 / kSteps, t)).point);
      }
      before = here;
    }
  }
}

double about_size(const std::vector<Piece>& pieces) {
  Box2 box;
  for (const Piece& piece : pieces) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) box.add(evaluate(piece, t).point);
  }
  return box.diagonal();
}

}  // namespace obvid
