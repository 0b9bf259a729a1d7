// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "obvid/certify/certify.h"

namespace obvid {
namespace {

/// Places on a piece from which the nearest point is refined, and steps of the refinement.
constexpr int kPlaces = 8;
constexpr int kSteps = 8;
/// Pieces beside the ones in question that are looked at too, when a point is not met there.
constexpr std::size_t kBeside = 4;
/// Points for which every piece is looked at; more of them make the contour a bad one anyhow.
constexpr std::size_t kMostDesperate = 64;
/// Rounding of an evaluated point and of its distance: ulps of the coordinates.
constexpr double kEvaluation = 8.0 * 0x1p-53;

/// Any point of the contour bounds a distance from above: the smallest of those tried.
class Distances {
 public:
  explicit Distances(const Contour& contour) : contour_(contour) {}

  std::vector<double> run() {
    const std::size_t n = contour_.points.size();
    std::vector<double> out(n, std::numeric_limits<double>::infinity());
    if (contour_.pieces.empty()) return out;
    find_pieces();
    for (std::size_t i = 0; i < n; ++i) out[i] = distance(i);
    return out;
  }

 private:
  struct Range {
    std::size_t first = 0, last = 0;  ///< pieces, both included
  };

  /// Pieces around every point: next to the joint that stands on it, or between the joints of its
  /// neighbours.
  void find_pieces() {
    const std::size_t n = contour_.points.size(), pieces = contour_.pieces.size();
    range_.assign(n, Range{0, pieces - 1});
    own_.assign(n, contour_.joints.size());
    std::vector<std::pair<std::size_t, std::size_t>> known;  // point, joint; in order of joints
    for (std::size_t j = 0; j < contour_.joints.size(); ++j) {
      const auto source = contour_.joints[j].source;
      if (!source || *source >= n) continue;
      own_[*source] = j;
      range_[*source] = {j > 0 ? j - 1 : 0, std::min(j, pieces - 1)};
      known.emplace_back(*source, j);
    }
    for (std::size_t k = 0; k + 1 < known.size(); ++k) {
      between(known[k].first, known[k + 1].first, {known[k].second, known[k + 1].second - 1});
    }
    if (contour_.closed && !known.empty()) {
      between(known.back().first, known.front().first, {known.back().second, pieces - 1});
    }
  }

  /// Points after `from` and before `to`, around the end of the list in a closed contour.
  void between(std::size_t from, std::size_t to, Range range) {
    const std::size_t n = contour_.points.size();
    if (to < from && !contour_.closed) return;
    for (std::size_t i = (from + 1) % n; i != to; i = (i + 1) % n) {
      if (own_[i] < contour_.joints.size()) break;
      range_[i] = range;
    }
  }

  double distance(std::size_t i) {
    const Vec2 p = contour_.points[i];
    const double wanted = contour_.point_tolerance.empty() ? 0.0 : contour_.point_tolerance[i];
    double best = std::numeric_limits<double>::infinity();
    if (own_[i] < contour_.joints.size()) {
      const Vec2 joint = contour_.joints[own_[i]].element.point;
      if (joint == p) return 0.0;
      best = norm(joint - p) + rounding(p, joint);
      if (best <= wanted) return best;
    }
    const Range range = range_[i];
    look(range, p, best);
    if (best <= wanted) return best;
    look({range.first > kBeside ? range.first - kBeside : 0,
          std::min(contour_.pieces.size() - 1, range.last + kBeside)},
         p, best);
    if (best <= wanted || desperate_ >= kMostDesperate) return best;
    ++desperate_;
    look({0, contour_.pieces.size() - 1}, p, best);
    return best;
  }

  void look(Range range, Vec2 p, double& best) const {
    for (std::size_t k = range.first; k <= range.last; ++k) {
      best = std::min(best, nearest(contour_.pieces[k], p));
    }
  }

  static double rounding(Vec2 a, Vec2 b) {
    return kEvaluation * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y));
  }

  static double nearest(const Piece& piece, Vec2 p) {
    double t = 0.0, least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kPlaces; ++k) {
      const double at = static_cast<double>(k) / kPlaces;
      const double d = norm(evaluate(piece, at).point - p);
      if (!(d < least)) continue;
      least = d;
      t = at;
    }
    Vec2 foot = evaluate(piece, t).point;
    for (int k = 0; k < kSteps; ++k) {
      const Jet jet = evaluate(piece, t);
      const Vec2 away = jet.point - p;
      if (norm(away) < least) {
        least = norm(away);
        foot = jet.point;
      }
      const double slope = dot(away, jet.d1), speed = dot(jet.d1, jet.d1);
      const double bend = speed + dot(away, jet.d2);
      const double next = std::clamp(t - slope / (bend > 0.0 ? bend : speed), 0.0, 1.0);
      if (next == t) break;
      t = next;
    }
    return least + rounding(p, foot);
  }

  const Contour& contour_;
  std::vector<Range> range_;
  std::vector<std::size_t> own_;  // joint on each point, or the number of joints
  std::size_t desperate_ = 0;
};

}  // namespace

std::vector<double> point_distances(const Contour& contour) { return Distances(contour).run(); }

}  // namespace obvid
