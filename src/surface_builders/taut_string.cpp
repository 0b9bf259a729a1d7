// SPDX-License-Identifier: Apache-2.0
// Fewest changes of bending within bounds: docs/methods/skin.md.
#include "obvid/surface_builders/internal/taut_string.h"

#include <algorithm>
#include <array>
#include <deque>
#include <optional>

namespace obvid {
namespace {

struct StringNode {
  std::size_t index = 0;
  double x = 0.0, y = 0.0;
};

double slope(const StringNode& a, const StringNode& b) { return (b.y - a.y) / (b.x - a.x); }

/// Nodes of a bound from where the string stands on: a hull whose slopes rise (`side` 1, under the
/// upper bound) or fall (-1, over the lower one).
class Hull {
 public:
  explicit Hull(int side) : side_(side) {}

  void add(const StringNode& node) {
    while (nodes_.size() > 1 &&
           side_ * (slope(nodes_.back(), node) - slope(nodes_[nodes_.size() - 2], nodes_.back())) <=
               0.0) {
      nodes_.pop_back();
    }
    nodes_.push_back(node);
  }
  void restart(const StringNode& node) { nodes_.assign(1, node); }
  void drop_first() { nodes_.pop_front(); }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] const StringNode& operator[](std::size_t i) const { return nodes_[i]; }

 private:
  int side_;
  std::deque<StringNode> nodes_;
};

class Funnel {
 public:
  explicit Funnel(const Tube& tube) : tube_(tube) {}

  std::vector<StringContact> contacts() {
    std::size_t next = begin();
    for (; next < tube_.at.size(); ++next) {
      add(next, 1);
      add(next, -1);
    }
    return std::move(contacts_);
  }

 private:
  [[nodiscard]] StringNode high(std::size_t i) const { return {i, tube_.at[i], tube_.high[i]}; }
  [[nodiscard]] StringNode low(std::size_t i) const { return {i, tube_.at[i], tube_.low[i]}; }
  [[nodiscard]] StringNode bound(std::size_t i, int side) const {
    return side > 0 ? high(i) : low(i);
  }

  /// Both hulls begin where the string was held last.
  void stand_at(const StringNode& node, int bend) {
    contacts_.push_back({node.index, bend});
    upper_.restart(node);
    lower_.restart(node);
  }

  /// Straight lines through all bounds so far: the steepest one and the flattest one, held by a
  /// node of one bound and a later one of the other. Ends at the first node that none reaches:
  /// there the string has to bend at the later of the two. Returns the node to go on with.
  std::size_t begin() {
    const std::size_t n = tube_.at.size();
    if (n < 3) return n;
    upper_.restart(high(0));
    lower_.restart(low(0));
    std::array<Line, 2> limit = {Line{low(0), high(1)}, Line{high(0), low(1)}};
    upper_.add(high(1));
    lower_.add(low(1));
    for (std::size_t j = 2; j < n; ++j) {
      for (const int side : {1, -1}) {
        const Line& line = limit[side > 0 ? 0 : 1];
        // the lower bound over the steepest line, or the upper bound under the flattest one
        const StringNode here = bound(j, -side);
        if (side * (slope(line.to, here) - slope(line.from, line.to)) <= 0.0) continue;
        const StringNode held = line.to;
        stand_at(held, side);
        for (std::size_t i = held.index + 1; i < j; ++i) {
          upper_.add(high(i));
          lower_.add(low(i));
        }
        return j;
      }
      for (const int side : {1, -1}) {
        Line& line = limit[side > 0 ? 0 : 1];
        Hull& across = side > 0 ? lower_ : upper_;  // which the line leaves from
        const StringNode here = bound(j, side);
        if (side * (slope(line.to, here) - slope(line.from, line.to)) < 0.0) {
          while (across.size() > 1 &&
                 side * (slope(across[1], here) - slope(across[0], here)) <= 0.0) {
            across.drop_first();
          }
          line = {across[0], here};
        }
      }
      upper_.add(high(j));
      lower_.add(low(j));
    }
    return n;
  }

  /// The next node of one bound: its hull grows; where that would cross the other hull, the string
  /// is held there.
  void add(std::size_t j, int side) {
    Hull& own = side > 0 ? upper_ : lower_;
    Hull& other = side > 0 ? lower_ : upper_;
    const StringNode here = bound(j, side);
    bool moved = false;
    while (other.size() > 1 && other[1].index < j &&
           side * (slope(other[0], here) - slope(other[0], other[1])) < 0.0) {
      other.drop_first();
      contacts_.push_back({other[0].index, -side});
      moved = true;
    }
    if (moved) own.restart(other[0]);
    own.add(here);
  }

  struct Line {
    StringNode from, to;
  };

  const Tube& tube_;
  Hull upper_{1}, lower_{-1};
  std::vector<StringContact> contacts_;
};

/// The first node from which on no heights do without a second difference of this sign between it
/// and `from`; none: all heights to the end may do without.
std::optional<std::size_t> forced_by(const Tube& tube, std::size_t from, int bend) {
  // bend 1: the hull over the lower bound, which the upper one must not go under
  const auto over = [&](std::size_t i) {
    return StringNode{i, tube.at[i], bend > 0 ? tube.low[i] : -tube.high[i]};
  };
  const auto under = [&](std::size_t i) { return bend > 0 ? tube.high[i] : -tube.low[i]; };
  Hull hull(-1);
  hull.restart(over(from));
  for (std::size_t c = from + 1; c < tube.at.size(); ++c) {
    hull.add(over(c));
    const StringNode a = hull[hull.size() - 2], end = hull[hull.size() - 1];
    for (std::size_t b = a.index + 1; b < c; ++b) {
      if (under(b) < a.y + slope(a, end) * (tube.at[b] - a.x)) return c;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<StringContact> taut_string(const Tube& tube) { return Funnel(tube).contacts(); }

std::size_t changes_of(const std::vector<StringContact>& contacts) {
  std::size_t changes = 0;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    changes += contacts[i].bend != contacts[i - 1].bend ? 1 : 0;
  }
  return changes;
}

std::size_t changes_certified(const Tube& tube) {
  if (tube.at.empty()) return 0;
  std::size_t most = 0;
  for (const int first : {1, -1}) {
    std::size_t forced = 0, from = 0;
    int bend = first;
    while (const auto end = forced_by(tube, from, bend)) {
      ++forced;
      from = *end - 1;
      bend = -bend;
    }
    most = std::max(most, forced);
  }
  return most > 0 ? most - 1 : 0;
}

}  // namespace obvid
