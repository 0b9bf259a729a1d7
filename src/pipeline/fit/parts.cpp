// SPDX-License-Identifier: Apache-2.0
#include "fit/parts.h"

#include <optional>

#include "obvid/core/internal/questions.h"
#include "obvid/curve/internal/nearest.h"

namespace obvid::pipeline_detail {
namespace {

/// A place of the contour that stands for a point, or a corner between two.
struct Station {
  std::size_t before = 0;  ///< the point as which a part ends there
  std::size_t piece = 0;
  double t = 0.0;
  bool between = false;
};

bool ahead(const Station& a, const Station& b) {
  return a.piece != b.piece ? a.piece < b.piece : a.t < b.t;
}

/// Stations in order; the last one lies at the end of the last piece.
class Stations {
 public:
  Stations(const Contour& contour, Watch* watch)
      : contour_(contour), questions_(watch, kFootPiecesOfQuestion) {}

  std::vector<Station> run() {
    const std::size_t n = contour_.pieces.size();
    for (std::size_t j = 0; j < n; ++j) {
      const Joint& joint = contour_.joints[j];
      if (j > 0 && !is_station(joint)) continue;
      if (questions_.end()) return std::move(stations_);
      reach(at_joint(joint, 0, j, 0.0));
    }
    const Joint& last = contour_.joints[n % contour_.joints.size()];
    const std::size_t points = contour_.points.size();
    reach(at_joint(last, points > 0 ? points - 1 : 0, n - 1, 1.0));
    return std::move(stations_);
  }

 private:
  static Station at_joint(const Joint& joint, std::size_t otherwise, std::size_t piece, double t) {
    const bool between = !joint.source && joint.after;
    return {between ? *joint.after : joint.source.value_or(otherwise), piece, t, between};
  }

  /// Adds a station, and before it those of the points between the last one and it.
  void reach(const Station& next) {
    if (info_of(contour_.carrier).between_joints && !stations_.empty()) add_feet(next);
    stations_.push_back(next);
  }

  void add_feet(const Station& next) {
    const std::size_t n = contour_.points.size();
    const std::size_t first = stations_.back().before + 1;
    std::size_t count = (next.before + (next.between ? 1 : 0) + 2 * n - first) % n;
    if (count == 0 && next.between && stations_.size() == 1) count = n;  // around to its one corner
    for (std::size_t i = first; i < first + count && !questions_.end(); ++i) {
      if (i >= n && !contour_.closed) return;
      const Station foot = foot_of(i % n, next);
      if (ahead(stations_.back(), foot) && ahead(foot, next)) stations_.push_back(foot);
    }
  }

  /// The place nearest to a point between the last station and the next one.
  [[nodiscard]] Station foot_of(std::size_t point, const Station& next) {
    const Vec2 p = contour_.points[point];
    Station best = stations_.back();
    double least = HUGE_VAL;
    const std::size_t last = next.t > 0.0 ? next.piece : next.piece - 1;
    for (std::size_t k = stations_.back().piece; k <= last && !questions_.end(); ++k) {
      const Piece near = moved(contour_.pieces[k], Vec2{} - p);  // large coordinates blur distances
      const double t = nearest_on(near);
      const double away = norm(evaluate(near, t).point);
      if (away < least) {
        least = away;
        best = {point, k, t, false};
      } else if (away > kPassed * least) {
        break;
      }
    }
    return best;
  }

  /// Where a piece comes nearest to the origin: a long one may come near it and leave it again.
  static double nearest_on(const Piece& piece) {
    double best = 0.0, least = HUGE_VAL;
    for (const double start : {0.5, 0.0, 1.0}) {
      const double t = nearest_parameter(piece, {}, start);
      const double away = norm(evaluate(piece, t).point);
      if (away >= least) continue;
      least = away;
      best = t;
    }
    return best;
  }

  static constexpr std::size_t kFootPiecesOfQuestion = 64;
  /// Pieces this much farther than the nearest one so far lead away from the point.
  static constexpr double kPassed = 8.0;

  const Contour& contour_;
  Questions questions_;
  std::vector<Station> stations_;
};

}  // namespace

std::vector<Part> parts_of(const Contour& contour, Watch* watch) {
  std::vector<Part> parts;
  if (contour.pieces.empty()) return parts;
  const std::vector<Station> stations = Stations(contour, watch).run();
  for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
    const Station &a = stations[k], &b = stations[k + 1];
    const std::size_t from = a.between ? (a.before + 1) % contour.points.size() : a.before;
    Part part{from, b.before, a.piece, b.piece, a.t, b.t};
    if (part.t1 == 0.0) {  // at the end of the piece before
      --part.last_piece;
      part.t1 = 1.0;
    }
    parts.push_back(part);
  }
  return parts;
}

}  // namespace obvid::pipeline_detail
