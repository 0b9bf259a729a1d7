// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "obvid/certify/certify.h"
#include "point_places.h"

namespace obvid {
namespace {

/// Any point of the contour bounds a distance from above: the smallest of those tried.
class Distances {
 public:
  Distances(const Contour& contour, Watch& watch) : contour_(contour), watch_(watch) {}

  std::vector<Nearest> run() {
    const std::size_t n = contour_.points.size();
    std::vector<Nearest> out(n);
    if (contour_.pieces.empty()) return out;
    find_pieces();
    for (std::size_t i = 0; i < n && !watch_.cancelled(); ++i) out[i] = nearest(i);
    return out;
  }

 private:
  struct Range {
    std::size_t first = 0, last = 0;  ///< pieces, both included
    bool known = false;
  };

  /// Pieces around every point: next to the joint that stands on it, or between the joints of its
  /// neighbours. Each point is visited once, also where joints claim their points out of order.
  void find_pieces() {
    const std::size_t n = contour_.points.size(), pieces = contour_.pieces.size();
    range_.assign(n, Range{0, pieces - 1, false});
    own_.assign(n, contour_.joints.size());
    std::vector<std::size_t> standing;  // joints on points
    for (std::size_t j = 0; j < std::min(contour_.joints.size(), pieces + 1); ++j) {
      const auto source = contour_.joints[j].source, after = contour_.joints[j].after;
      if (!source && after && *after < n) standing.push_back(j);
      if (!source || *source >= n || range_[*source].known) continue;
      own_[*source] = j;
      range_[*source] = {j > 0 ? j - 1 : 0, std::min(j, pieces - 1), true};
      standing.push_back(j);
    }
    for (std::size_t k = 0; k + 1 < standing.size(); ++k) {
      fill_after(standing[k], standing[k + 1], {standing[k], standing[k + 1] - 1, true});
    }
    if (contour_.closed && !standing.empty()) {
      fill_after(standing.back(), standing.front(), {standing.back(), pieces - 1, true});
    }
  }

  /// The point that a joint is, or that lies behind a corner between two.
  [[nodiscard]] std::size_t first_behind(std::size_t joint, bool itself) const {
    const Joint& one = contour_.joints[joint];
    return one.source ? *one.source + (itself ? 0 : 1) : *one.after + 1;
  }

  /// Gives the points after a joint's own one the pieces after that joint, up to the next joint's.
  void fill_after(std::size_t joint, std::size_t next, Range range) {
    const std::size_t n = contour_.points.size();
    range.first = std::min(range.first, range.last);
    const std::size_t first = first_behind(joint, false), end = first_behind(next, true) % n;
    const bool to_corner = !contour_.joints[next].source;
    for (std::size_t i = first; i < n || contour_.closed; ++i) {
      if (range_[i % n].known || (to_corner && i % n == end && (i > first || joint != next)))
        return;
      range_[i % n] = range;
    }
  }

  /// What the joint on the point gives; infinite without one. Taken from the piece: only its points
  /// are points of the contour, the joint's own element is a claim.
  [[nodiscard]] Nearest at_joint(std::size_t i) const {
    const std::size_t joint = own_[i];
    if (joint >= contour_.joints.size()) return {};
    const bool last = joint >= contour_.pieces.size();
    const Vec2 end = last ? end_point(contour_.pieces.back()) : start_point(contour_.pieces[joint]);
    return {distance_bound(end, contour_.points[i]), last ? joint - 1 : joint, last ? 1.0 : 0.0};
  }

  Nearest nearest(std::size_t i) {
    const bool tolerant = i < contour_.point_tolerance.size();
    const double wanted = tolerant ? contour_.point_tolerance[i] : 0.0;
    Nearest best = at_joint(i);
    if (best.distance <= wanted) return best;
    if (!tree_) tree_.emplace(contour_.pieces);
    const Vec2 p = contour_.points[i];
    tree_->improve(p, range_[i].first, range_[i].last, best);
    if (!(best.distance <= wanted)) tree_->improve(p, 0, contour_.pieces.size() - 1, best);
    return best;
  }

  const Contour& contour_;
  Watch& watch_;
  std::vector<Range> range_;
  std::vector<std::size_t> own_;  // joint on each point, or the number of joints
  std::optional<PieceTree> tree_;
};

}  // namespace

std::vector<Nearest> nearest_places(const Contour& contour, Watch& watch) {
  return Distances(contour, watch).run();
}

std::vector<double> point_distances(const Contour& contour) {
  Watch nobody;
  return point_distances(contour, nobody);
}

std::vector<double> point_distances(const Contour& contour, Watch& watch) {
  std::vector<double> out;
  out.reserve(contour.points.size());
  for (const Nearest& place : nearest_places(contour, watch)) out.push_back(place.distance);
  return out;
}

}  // namespace obvid
