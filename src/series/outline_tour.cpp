// SPDX-License-Identifier: Apache-2.0
#include "outline_tour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "obvid/core/units.h"
#include "obvid/numeric/internal/disjoint_sets.h"

namespace obvid {
namespace {

using Index = std::size_t;
using Order = std::vector<Index>;

constexpr Index kNear = 10;                        // neighbours that edges are looked for among
constexpr Index kMostMoved = 3;                    // points of a move
constexpr double kGain = 1e-12;                    // of a length: less is rounding
constexpr double kRivalPart = 1.7;                 // a join that is this much longer is no rival
constexpr double kClearTurn = 100.0 * kOneDegree;  // a rival that turns more is none
constexpr double kSmallTurn = 10.0 * kOneDegree;   // nor one that turns twice and this

double between(const std::vector<Vec2>& p, Index a, Index b) { return norm(p[a] - p[b]); }

std::vector<Order> nearest_of_all(const std::vector<Vec2>& points) {
  const Index n = points.size(), kept = std::min(kNear, n - 1);
  std::vector<Order> out(n);
  std::vector<std::pair<double, Index>> all;
  for (Index i = 0; i < n; ++i) {
    all.clear();
    for (Index j = 0; j < n; ++j) {
      if (j != i) all.emplace_back(between(points, i, j), j);
    }
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end());
    for (Index k = 0; k < kept; ++k) out[i].push_back(all[k].second);
  }
  return out;
}

/// Shortest edges first, none that would make a third at a point or close a ring.
class GreedyRow {
 public:
  explicit GreedyRow(const std::vector<Vec2>& points)
      : points_(points), beside_(points.size()), rows_(points.size()) {}

  void add(Index a, Index b) {
    if (beside_[a].size() == 2 || beside_[b].size() == 2 || !rows_.join(a, b)) return;
    beside_[a].push_back(b);
    beside_[b].push_back(a);
    ++edges_;
  }

  /// Joins the rows that are left, the nearest ends first.
  Order whole() {
    while (edges_ + 1 < points_.size()) {
      std::tuple<double, Index, Index> best{std::numeric_limits<double>::infinity(), 0, 0};
      const Order ends = open_ends();
      for (const Index a : ends) {
        for (const Index b : ends) {
          if (a < b && rows_.find(a) != rows_.find(b))
            best = std::min(best, {between(points_, a, b), a, b});
        }
      }
      add(std::get<1>(best), std::get<2>(best));
    }
    Order out{open_ends().front()};
    Index before = points_.size();
    while (out.size() < points_.size()) {
      const auto& next = beside_[out.back()];
      const Index at = next[0] == before ? next[1] : next[0];
      before = out.back();
      out.push_back(at);
    }
    return out;
  }

 private:
  [[nodiscard]] Order open_ends() const {
    Order out;
    for (Index i = 0; i < points_.size(); ++i) {
      if (beside_[i].size() < 2) out.push_back(i);
    }
    return out;
  }

  const std::vector<Vec2>& points_;
  std::vector<Order> beside_;
  numeric::DisjointSets rows_;  // what belongs to one
  Index edges_ = 0;
};

Order greedy_row(const std::vector<Vec2>& points, const std::vector<Order>& near) {
  std::vector<std::tuple<double, Index, Index>> edges;
  for (Index i = 0; i < points.size(); ++i) {
    for (const Index j : near[i]) {
      edges.emplace_back(between(points, i, j), std::min(i, j), std::max(i, j));
    }
  }
  std::sort(edges.begin(), edges.end());
  GreedyRow row(points);
  for (const auto& [length, a, b] : edges) row.add(a, b);
  return row.whole();
}

/// A closed way that is made shorter.
class Tour {
 public:
  Tour(const std::vector<Vec2>& points, const std::vector<Order>& near, Order order)
      : points_(points), near_(near), order_(std::move(order)), place_(order_.size()) {
    number();
  }

  Order shortened() {
    bool better = true;
    while (better) {
      better = false;
      for (Index i = 0; i < order_.size(); ++i) better = exchange_at(order_[i]) || better;
      for (Index length = 1; length <= kMostMoved; ++length) {
        for (Index i = 0; i < order_.size(); ++i) better = move_from(i, length) || better;
      }
    }
    return order_;
  }

 private:
  [[nodiscard]] Index at(Index i) const { return order_[i % order_.size()]; }
  [[nodiscard]] Index after(Index point) const { return at(place_[point] + 1); }
  [[nodiscard]] Index before(Index point) const { return at(place_[point] + order_.size() - 1); }
  [[nodiscard]] double d(Index a, Index b) const { return between(points_, a, b); }
  void number() {
    for (Index i = 0; i < order_.size(); ++i) place_[order_[i]] = i;
  }

  /// Edges a-b and c-d become a-c and b-d where that is shorter; b and d are behind, or before.
  bool exchange_at(Index a) {
    for (const bool forward : {true, false}) {
      const Index b = forward ? after(a) : before(a);
      const double old = d(a, b);
      for (const Index c : near_[a]) {
        if (d(a, c) >= old) break;
        const Index e = forward ? after(c) : before(c);
        if (e == a || c == b) continue;
        const double gone = old + d(c, e);
        if (gone - d(a, c) - d(b, e) <= kGain * gone) continue;
        turn_round(forward ? b : a, forward ? c : e);
        return true;
      }
    }
    return false;
  }

  /// Points from `first` to `last` the other way round.
  void turn_round(Index first, Index last) {
    const Index n = order_.size();
    Index i = place_[first], j = place_[last];
    for (Index swaps = ((j + n - i) % n + 1) / 2; swaps > 0; --swaps) {
      std::swap(order_[i], order_[j]);
      i = (i + 1) % n;
      j = (j + n - 1) % n;
    }
    number();
  }

  /// The points from place i on go to where the way becomes shortest by it.
  bool move_from(Index i, Index length) {
    const Index n = order_.size();
    if (n < length + kMostMoved) return false;
    const Index a = at(i + n - 1), s = at(i), e = at(i + length - 1), b = at(i + length);
    const double gain = d(a, s) + d(e, b) - d(a, b);
    for (const bool turned : {false, true}) {
      const Index head = turned ? e : s, tail = turned ? s : e;
      for (const Index c : near_[head]) {
        for (const bool forward : {true, false}) {
          const Index next = forward ? after(c) : before(c);
          if (is_moved(c, i, length) || is_moved(next, i, length)) continue;
          const double added = d(c, head) + d(tail, next) - d(c, next);
          if (gain - added <= kGain * (d(a, s) + d(e, b) + d(c, next))) continue;
          put_between(i, length, turned == forward, forward ? c : next);
          return true;
        }
      }
    }
    return false;
  }

  [[nodiscard]] bool is_moved(Index point, Index i, Index length) const {
    const Index n = order_.size();
    return (place_[point] + n - i) % n < length;
  }

  void put_between(Index i, Index length, bool turned, Index behind) {
    Order part, rest;
    for (Index k = 0; k < length; ++k) part.push_back(at(i + k));
    if (turned) std::reverse(part.begin(), part.end());
    for (Index k = length; k < order_.size(); ++k) {
      rest.push_back(at(i + k));
      if (rest.back() == behind) rest.insert(rest.end(), part.begin(), part.end());
    }
    order_ = std::move(rest);
    number();
  }

  const std::vector<Vec2>& points_;
  const std::vector<Order>& near_;
  Order order_, place_;
};

/// Length of a piece of the way, and by how much it turns at its inner points.
struct Way {
  double length = 0.0, turn = 0.0;

  template <std::size_t n>
  void add(const std::vector<Vec2>& points, const std::array<Index, n>& way, Index count = n) {
    for (Index i = 0; i + 1 < count; ++i) {
      const Vec2 step = points[way[i + 1]] - points[way[i]];
      length += norm(step);
      if (i == 0) continue;
      const Vec2 last = points[way[i]] - points[way[i - 1]];
      turn += std::abs(turning(last, step));
    }
  }
};

/// Looks for other joins.
class Rivals {
 public:
  Rivals(const std::vector<Vec2>& points, const Order& tour) : points_(points), tour_(tour) {}

  /// Whether the edges behind places i and j may as well be joined the other way.
  [[nodiscard]] bool exchange(Index i, Index j) const {
    const Index a = at(i), b = at(i + 1), c = at(j), d = at(j + 1);
    const double old = step(a, b) + step(c, d);
    if (step(a, c) + step(b, d) - old > (kRivalPart - 1.0) * old) return false;
    const Index a0 = at(i + size() - 1), b1 = at(i + 2), c0 = at(j + size() - 1), d1 = at(j + 2);
    Way now, then;
    now.add<4>(points_, {a0, a, b, b1});
    now.add<4>(points_, {c0, c, d, d1});
    then.add<4>(points_, {a0, a, c, c0});
    then.add<4>(points_, {b1, b, d, d1});
    return hardly_more(now, then);
  }

  /// Whether `length` points from place i on may as well lie behind place i + j.
  [[nodiscard]] bool move(Index i, Index length, Index j) const {
    const Index a = at(i + size() - 1), s = at(i), e = at(i + length - 1), b = at(i + length);
    const Index c = at(i + j), d = at(i + j + 1);
    const double old = step(a, s) + step(e, b) + step(c, d);
    for (const bool turned : {false, true}) {
      const double made = step(c, turned ? e : s) + step(turned ? s : e, d) + step(a, b);
      if (made - old > (kRivalPart - 1.0) * old) continue;
      const Index c0 = at(i + j + size() - 1), d1 = at(i + j + 2);
      const Index a0 = at(i + size() - 2), b1 = at(i + length + 1);
      std::array<Index, kMostMoved + 4> here{a0, a}, there{c0, c};
      for (Index k = 0; k < length; ++k) {
        here[2 + k] = at(i + k);
        there[2 + k] = at(turned ? i + length - 1 - k : i + k);
      }
      here[2 + length] = b;
      here[3 + length] = b1;
      there[2 + length] = d;
      there[3 + length] = d1;
      Way now, then;
      now.add(points_, here, length + 4);
      now.add<4>(points_, {c0, c, d, d1});
      then.add<4>(points_, {a0, a, b, b1});
      then.add(points_, there, length + 4);
      if (hardly_more(now, then)) return true;
    }
    return false;
  }

  [[nodiscard]] Index size() const { return tour_.size(); }
  [[nodiscard]] Index at(Index i) const { return tour_[i % size()]; }

 private:
  [[nodiscard]] double step(Index a, Index b) const { return between(points_, a, b); }
  static bool hardly_more(const Way& now, const Way& then) {
    return then.turn - now.turn < std::min(kClearTurn, now.turn + kSmallTurn);
  }

  const std::vector<Vec2>& points_;
  const Order& tour_;
};

}  // namespace

Order short_tour(const std::vector<Vec2>& points) {
  const auto near = nearest_of_all(points);
  return Tour(points, near, greedy_row(points, near)).shortened();
}

bool same_neighbours(const Order& row, const Order& tour) {
  const Index n = row.size();
  Order place(n);
  for (Index i = 0; i < n; ++i) place[row[i]] = i;
  Index others = 0;
  for (Index i = 0; i < n; ++i) {
    const Index a = place[tour[i]], b = place[tour[(i + 1) % n]];
    if (std::max(a, b) - std::min(a, b) != 1) ++others;
  }
  return others <= 1;
}

std::optional<Index> sharp_turn(const std::vector<Vec2>& points, const Order& row) {
  for (Index i = 1; i + 1 < row.size(); ++i) {
    const Vec2 last = points[row[i]] - points[row[i - 1]],
               next = points[row[i + 1]] - points[row[i]];
    if (dot(last, next) < 0.0) return row[i];
  }
  return std::nullopt;
}

std::optional<Index> uncertain_end(const std::vector<Vec2>& points, const Order& row) {
  const Index n = row.size();
  for (const bool back : {false, true}) {
    const auto at = [&](Index i) { return row[back ? n - 1 - i : i]; };
    for (Index i = 2; i + 1 < n; ++i) {
      const double now = between(points, at(0), at(1)) + between(points, at(i), at(i + 1));
      const double then = between(points, at(0), at(i)) + between(points, at(0), at(i + 1));
      if (then < kRivalPart * now) return at(0);
    }
  }
  return std::nullopt;
}

std::optional<Index> uncertain_place(const std::vector<Vec2>& points, const Order& way,
                                     bool closed) {
  const Rivals rivals(points, way);
  const Index n = way.size(), begin = closed ? 0 : 1, end = closed ? n : n - 2;
  for (Index i = begin; i < end; ++i) {
    for (Index j = i + 2; j < end; ++j) {
      if (!(i == 0 && j + 1 == n) && rivals.exchange(i, j)) return way[i];
    }
  }
  for (Index length = 1; length <= kMostMoved; ++length) {
    for (Index i = closed ? 0 : 2; i + (closed ? 0 : length + 1) < n; ++i) {
      // where it goes has a point more on either side that is not of the place it leaves
      for (Index j = length + 1; j + 4 <= n; ++j) {
        const Index to = (i + j) % n;
        if (to < begin || to >= end) continue;
        if (rivals.move(i, length, j)) return way[i];
      }
    }
  }
  return std::nullopt;
}

}  // namespace obvid
