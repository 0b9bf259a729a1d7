// SPDX-License-Identifier: Apache-2.0
#include "counts.h"

#include <algorithm>

namespace judge {
namespace {

/// Curvatures below this part of the largest around a joint may be rounding of zero.
constexpr double kFlatEnd = 1e-9;

/// Parameters of pieces that are not monotone are told apart down to this (docs/claims.md).
constexpr double kSamePlace = 1e-12;

struct Item {
  int sign = 0;
  bool certain = true;
};

int changes(const std::vector<Item>& items, bool all, bool closed) {
  int count = 0, first = 0, last = 0;
  for (const Item& item : items) {
    if (item.sign == 0 || (!all && !item.certain)) continue;
    if (last != 0 && item.sign != last) ++count;
    if (first == 0) first = item.sign;
    last = item.sign;
  }
  if (closed && first != last) ++count;
  return count;
}

/// From its own start: of a tiny piece far away the curvature would drown in the digits.
Span seen_from_start(const Piece& piece) {
  const auto* bezier = std::get_if<Bezier>(&piece);
  if (bezier == nullptr) return Span(piece, stored_start(piece));
  std::vector<Vec> points;
  for (const Point p : bezier->offset) points.push_back(seen(p, bezier->offset.front()));
  return Span(std::move(points), {bezier->weight.begin(), bezier->weight.end()});
}

/// The curvature at a vertex, which is the only one between two parameters.
double extreme_kappa(const Span& span, const Turn& turn, bool highest) {
  const auto height = [&](Real t) { return (highest ? 1.0L : -1.0L) * span.at(t).kappa(); };
  constexpr int kThirds = 110;  // (2/3)^110 is a rounding of long double
  Real low = turn.from, high = turn.to;
  for (int i = 0; i < kThirds; ++i) {
    const Real a = low + (high - low) / 3.0L, b = high - (high - low) / 3.0L;
    const bool rises = height(a) < height(b);
    (rises ? low : high) = rises ? a : b;
  }
  return static_cast<double>(span.at(0.5L * (low + high)).kappa());
}

CountRange range_of(const std::vector<Item>& items, bool closed) {
  return {changes(items, false, closed), changes(items, true, closed), true};
}

}  // namespace

CountRange count_vertices(const Course& course) {
  std::vector<Item> items;
  for (std::size_t i = 0; i < course.laws.size(); ++i) {
    if (!course.laws[i].decided || !course.laws[i].regular) return {0, 0, false};
    const JointFacts& joint = course.joints[i];
    // at a smooth joint only a jump beyond what the gaps may be is a change of curvature
    const bool counted =
        joint.corner || joint.step || course.file.carrier == "arcs" || joint.clear_jump;
    if (counted) items.push_back({joint.jump, joint.clear_jump});
    const CurvatureLaw& law = course.laws[i];
    const auto* bezier = std::get_if<Bezier>(&course.file.pieces[i]);
    for (std::size_t k = 0; k < law.signs.size(); ++k) {
      const bool turns = bezier != nullptr && law.signs.size() > 1;
      const bool at_start = turns && k == 0 && slope_sign(*bezier, kSamePlace) != law.signs[k];
      const bool at_end = turns && k + 1 == law.signs.size() &&
                          slope_sign(*bezier, 1.0 - kSamePlace) != law.signs[k];
      items.push_back({law.signs[k], !at_start && !at_end});
    }
  }
  return range_of(items, course.file.closed);
}

CountRange count_inflections(const Course& course) {
  std::vector<Item> items;
  for (std::size_t i = 0; i < course.laws.size(); ++i) {
    if (!course.laws[i].decided) return {0, 0, false};
    const End &a = course.ends.start[i], &b = course.ends.end[i];
    const double most = std::max(abs(a.kappa).upper(), abs(b.kappa).upper());
    const auto meet = [&](double kappa) {
      items.push_back(
          {kappa > 0.0 ? 1 : (kappa < 0.0 ? -1 : 0), std::abs(kappa) > kFlatEnd * most});
    };
    meet(static_cast<double>(a.kappa.middle()));
    const CurvatureLaw& law = course.laws[i];
    for (std::size_t k = 0; k < law.turns.size(); ++k) {
      meet(extreme_kappa(seen_from_start(course.file.pieces[i]), law.turns[k], law.signs[k] > 0));
    }
    meet(static_cast<double>(b.kappa.middle()));
  }
  return range_of(items, course.file.closed);
}

}  // namespace judge
