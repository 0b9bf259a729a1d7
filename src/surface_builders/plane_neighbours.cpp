// SPDX-License-Identifier: Apache-2.0
#include "plane_neighbours.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace obvid {

PlaneNeighbours::PlaneNeighbours(std::vector<Vec2> points)
    : points_(std::move(points)), order_(points_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  build(0, order_.size(), true);
}

void PlaneNeighbours::build(std::size_t from, std::size_t to, bool by_x) {
  if (to - from < 2) return;
  const std::size_t middle = from + (to - from) / 2;
  const auto place = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(place(from), place(middle), place(to), [&](std::size_t a, std::size_t b) {
    const double p = by_x ? points_[a].x : points_[a].y, q = by_x ? points_[b].x : points_[b].y;
    return p != q ? p < q : a < b;
  });
  build(from, middle, !by_x);
  build(middle + 1, to, !by_x);
}

void PlaneNeighbours::nearest(Vec2 place, std::size_t count,
                              std::vector<PlaneNeighbour>& found) const {
  found.clear();
  if (count > 0) search(0, order_.size(), true, place, count, found);
  std::sort_heap(found.begin(), found.end());
}

void PlaneNeighbours::search(std::size_t from, std::size_t to, bool by_x, Vec2 place,
                             std::size_t count, std::vector<PlaneNeighbour>& found) const {
  if (from >= to) return;
  const std::size_t middle = from + (to - from) / 2;
  const Vec2 at = points_[order_[middle]];
  const double across = by_x ? place.x - at.x : place.y - at.y;
  const bool left = across < 0.0;
  search(left ? from : middle + 1, left ? middle : to, !by_x, place, count, found);
  const Vec2 gap = place - at;
  const PlaneNeighbour here{order_[middle], dot(gap, gap)};
  if (found.size() < count) {
    found.push_back(here);
    std::push_heap(found.begin(), found.end());
  } else if (here < found.front()) {
    std::pop_heap(found.begin(), found.end());
    found.back() = here;
    std::push_heap(found.begin(), found.end());
  }
  if (found.size() < count || across * across <= found.front().square) {
    search(left ? middle + 1 : from, left ? to : middle, !by_x, place, count, found);
  }
}

}  // namespace obvid
