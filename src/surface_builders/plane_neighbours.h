// SPDX-License-Identifier: Apache-2.0
// Nearest points of a plane.
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

struct PlaneNeighbour {
  std::size_t point = 0;
  double square = 0.0;  ///< of the distance

  friend bool operator<(const PlaneNeighbour& a, const PlaneNeighbour& b) {
    return a.square != b.square ? a.square < b.square : a.point < b.point;
  }
};

/// Tree of medians (Bentley 1975): memory linear, a search of k points O(k + log n) as a rule, also
/// where points lie in clusters. Equally distant ones go by their numbers.
class PlaneNeighbours {
 public:
  explicit PlaneNeighbours(std::vector<Vec2> points);

  /// The `count` nearest points (all, when there are fewer), nearest first.
  void nearest(Vec2 place, std::size_t count, std::vector<PlaneNeighbour>& found) const;

 private:
  void build(std::size_t from, std::size_t to, bool by_x);
  void search(std::size_t from, std::size_t to, bool by_x, Vec2 place, std::size_t count,
              std::vector<PlaneNeighbour>& found) const;

  std::vector<Vec2> points_;
  std::vector<std::size_t> order_;
};

}  // namespace obvid
