// SPDX-License-Identifier: Apache-2.0
#include "heading_ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "node_ends.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::fairing_detail {
namespace {

/// A node's heading may leave the circles' by so many of their widths. On public data contours do
/// so by up to about one; where an open series ends, circles lie on one side only.
constexpr double kBeside = 1.0, kBeyondEnds = 3.0;
/// Moves of the points turn a circle's tangent by a few times reach over chord.
constexpr double kPerReach = 4.0;
constexpr double kLeast = 0.02;  ///< rad, room for what lies on one circle

class Ranges {
 public:
  Ranges(Tube& tube, const State& x) : tube_(tube), x_(x), range_(tube.nodes.size()) {
    const std::size_t n = tube.nodes.size();
    for (std::size_t i = 0; i < n; ++i) {
      const PlacedNode p = place(tube.nodes[i], &x[kPerNode * i]);
      stations_.push_back({p.in.position, i});
      if (!tube.nodes[i].is_primitive()) continue;
      stations_.push_back({p.anchor, i});
      stations_.push_back({p.out.position, i});
    }
  }

  void run() {
    const std::size_t n = stations_.size();
    if (n < 3) return;
    for (std::size_t k = 0; k < n; ++k) {
      if (!tube_.closed && k + 2 >= n) break;
      take_circle(stations_[k], stations_[(k + 1) % n], stations_[(k + 2) % n]);
    }
    for (std::size_t i = 0; i < tube_.nodes.size(); ++i) give(i);
  }

 private:
  struct Station {
    Vec2 point;
    std::size_t node = 0;
  };

  void take(std::size_t node, Vec2 chord, double turn) {
    const double reference = tube_.nodes[node].theta + x_[kPerNode * node + 1];
    range_[node].take(turning(unit_at(reference), complex_product(chord, unit_at(turn))));
  }

  /// The circle's tangents at its three points.
  void take_circle(const Station& p, const Station& q, const Station& r) {
    const Vec2 a = q.point - p.point, b = r.point - q.point, c = r.point - p.point;
    const double over_a = turning(c, b), over_b = turning(a, c);  // inscribed angles
    take(p.node, a, -over_a);
    take(q.node, a, over_a);
    take(r.node, b, over_b);
  }

  /// Widest range of a node and those beside it: at the ends of the series, and where three circles
  /// agree by accident, the neighbours know more.
  [[nodiscard]] double width_around(std::size_t i) const {
    const std::size_t n = range_.size();
    double width = range_[i].width();
    if (i > 0 || tube_.closed) width = std::max(width, range_[(i + n - 1) % n].width());
    if (i + 1 < n || tube_.closed) width = std::max(width, range_[(i + 1) % n].width());
    return width;
  }

  /// Turn of the tangents that the reaches around a node can cause.
  [[nodiscard]] double blur(std::size_t i) const {
    const std::size_t n = range_.size();
    double least = std::numeric_limits<double>::infinity(), reach = tube_.nodes[i].reach;
    for (const std::size_t j : {(i + n - 1) % n, (i + 1) % n}) {
      if (!tube_.closed && (i > j ? i - j : j - i) != 1) continue;
      least = std::min(least, norm(tube_.nodes[j].point - tube_.nodes[i].point));
      reach = std::max(reach, tube_.nodes[j].reach);
    }
    return kPerReach * reach / least;
  }

  void give(std::size_t i) {
    TubeNode& node = tube_.nodes[i];
    if (node.is_primitive() || node.fix_theta || range_[i].empty()) return;
    const bool end = !tube_.closed && (i == 0 || i + 1 == range_.size());
    const double more = (end ? kBeyondEnds : kBeside) * width_around(i) + blur(i) + kLeast;
    const double now = x_[kPerNode * i + 1];
    node.turn_low = now + std::min(range_[i].low, 0.0) - more;
    node.turn_high = now + std::max(range_[i].high, 0.0) + more;
  }

  Tube& tube_;
  const State& x_;
  std::vector<Station> stations_;
  std::vector<AngleRange> range_;
};

}  // namespace

void set_heading_ranges(Tube& tube, const State& x) { Ranges(tube, x).run(); }

}  // namespace obvid::fairing_detail
