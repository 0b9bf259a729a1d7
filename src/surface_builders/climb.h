// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "obvid/surface/nurbs_surface.h"

namespace obvid {

// Extremes of what is measured over a patch: looked for on a raster of every span, then climbed to.

/// A parameter, the part of the domain that it stands for (a step to its neighbours), and where its
/// neighbours may lie: the cells beside it in the same span.
struct Node {
  double at = 0.0;
  double weight = 0.0;
  Range reach;
};

/// About `n` nodes of Gauss's rule, two in each cell, no cell over a knot: a short span has a
/// curvature of its own, and areas are exact to the third degree.
[[nodiscard]] std::vector<Node> nodes_of(const std::vector<double>& knots, const Range& domain,
                                         std::size_t n);

/// A place of the raster and what is there; the greater the better.
struct Peak {
  double value = -std::numeric_limits<double>::infinity();
  Node u{}, v{};
};

/// The best places of the raster, from which climbing begins: of 4 x 4 parts of the patch, so that
/// a second hill beside the highest place is climbed too.
class Peaks {
 public:
  Peaks(std::size_t count_u, std::size_t count_v)
      : count_u_(count_u), count_v_(count_v), best_(kParts * kParts) {}

  /// Values that are no numbers are passed over. `i` and `j`: of the nodes.
  void look_at(double value, std::size_t i, std::size_t j, const Node& u, const Node& v) {
    Peak& best = best_[j * kParts / count_v_ * kParts + i * kParts / count_u_];
    if (value > best.value) best = {value, u, v};
  }

  /// The highest few, best first.
  [[nodiscard]] std::vector<Peak> highest() const {
    constexpr std::size_t kClimbs = 3;
    std::vector<Peak> out;
    for (const Peak& one : best_) {
      if (std::isfinite(one.value)) out.push_back(one);
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Peak& a, const Peak& b) { return a.value > b.value; });
    out.resize(std::min(out.size(), kClimbs));
    return out;
  }

 private:
  static constexpr std::size_t kParts = 4;
  std::size_t count_u_, count_v_;
  std::vector<Peak> best_;
};

/// The top near a place: compass steps through the cells around it, halved until they are far below
/// the raster. `value_at(u, v)` is not a number where nobody may go.
template <class Value>
[[nodiscard]] Peak climbed(const Value& value_at, Peak from, int most_steps = 200) {
  constexpr int kHalvings = 20;  // a millionth of the raster's step: 1e-12 of the value's rise
  double step_u = from.u.weight, step_v = from.v.weight;
  int halvings = 0;
  for (int step = 0; step < most_steps && halvings < kHalvings; ++step) {
    Peak best = from;
    for (int place = 0; place < 9; ++place) {
      Node u = from.u, v = from.v;
      u.at = std::clamp(u.at + (place / 3 - 1) * step_u, u.reach.from, u.reach.to);
      v.at = std::clamp(v.at + (place % 3 - 1) * step_v, v.reach.from, v.reach.to);
      const double value = value_at(u.at, v.at);
      if (value > best.value) best = {value, u, v};
    }
    if (best.value > from.value) {
      from = best;
    } else {
      ++halvings;
      step_u /= 2.0;
      step_v /= 2.0;
    }
  }
  return from;
}

}  // namespace obvid
