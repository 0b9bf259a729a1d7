// SPDX-License-Identifier: Apache-2.0
#include "fit/parts.h"

#include <optional>

#include "obvid/core/internal/questions.h"
#include "obvid/curve/internal/nearest.h"

namespace obvid::pipeline_detail {
namespace {

/// A place of the contour that stands for a point.
struct Station {
  std::size_t point = 0;
  std::size_t piece = 0;
  double t = 0.0;
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
      const auto source = contour_.joints[j].source;
      if (j > 0 && !source) continue;
      if (questions_.end()) return std::move(stations_);
      reach({source.value_or(0), j, 0.0});
    }
    const Joint& last = contour_.joints[n % contour_.joints.size()];
    const std::size_t points = contour_.points.size();
    reach({last.source.value_or(points > 0 ? points - 1 : 0), n - 1, 1.0});
    return std::move(stations_);
  }

 private:
  /// Adds a station, and before it those of the points between the last one and it.
  void reach(const Station& next) {
    if (info_of(contour_.carrier).between_joints && !stations_.empty()) add_feet(next);
    stations_.push_back(next);
  }

  void add_feet(const Station& next) {
    const std::size_t n = contour_.points.size();
    for (std::size_t i = stations_.back().point + 1; i % n != next.point && !questions_.end();
         ++i) {
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
        best = {point, k, t};
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
    Part part{a.point, b.point, a.piece, b.piece, a.t, b.t};
    if (part.t1 == 0.0) {  // at the end of the piece before
      --part.last_piece;
      part.t1 = 1.0;
    }
    parts.push_back(part);
  }
  return parts;
}

}  // namespace obvid::pipeline_detail
