// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "double_double.h"
#include "obvid/certify/certify.h"
#include "obvid/curve/pieces.h"
#include "point_places.h"

namespace obvid {
namespace {

/// Steps of the search for the place where a piece enters the reach of a point.
constexpr int kEntrySteps = 30;
/// Places of the first point on a closed contour that are tried.
constexpr int kMostStarts = 32;
/// From a start: to the first point, from there around, and how far the last point may be beyond.
constexpr std::size_t kRoundsLooked = 3;

/// A place along the contour, counted on around a closed one.
struct Along {
  std::size_t piece = 0;
  double t = 0.0;

  friend bool operator<(const Along& a, const Along& b) {
    return a.piece != b.piece ? a.piece < b.piece : a.t < b.t;
  }
};

/// Follows the contour once and meets the points on the way.
class Passage {
 public:
  /// Of a closed contour so many times around.
  Passage(const Contour& contour, Along from, std::size_t rounds = 1)
      : contour_(contour), here_(from), last_(from) {
    const std::size_t n = contour.pieces.size();
    last_ = contour.closed ? Along{from.piece + rounds * n, from.t} : Along{n - 1, 1.0};
  }

  [[nodiscard]] Along here() const { return here_; }
  /// From here on once around.
  void end_around() { last_ = {here_.piece + contour_.pieces.size(), here_.t}; }

  /// Goes on to the place, or stays where it is when that is near enough.
  bool meet_at(std::size_t i, Along place) {
    if (place < here_ || last_ < place) return in_reach(i, here_);
    here_ = place;
    return true;
  }

  /// Goes on to the first place that is near enough.
  bool meet_first(std::size_t i) {
    for (Along at = here_; at < last_ || at.piece == here_.piece; at = {at.piece + 1, 0.0}) {
      if (const auto entry = enters(i, at); entry && !(last_ < *entry)) {
        here_ = *entry;
        return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] const Piece& piece(std::size_t k) const {
    return contour_.pieces[k % contour_.pieces.size()];
  }

  [[nodiscard]] bool in_reach(std::size_t i, Along at) const {
    return distance_at(piece(at.piece), at.t, contour_.points[i]) <= allowed_distance(contour_, i);
  }

  /// The first place of one piece, from `at` on, that is near enough.
  [[nodiscard]] std::optional<Along> enters(std::size_t i, Along at) const {
    if (in_reach(i, at)) return at;
    const Nearest nearest = nearest_on(piece(at.piece), contour_.points[i], at.t);
    Along inside{at.piece, nearest.t};
    if (!in_reach(i, inside)) return std::nullopt;
    double outside = at.t;
    for (int k = 0; k < kEntrySteps; ++k) {
      const Along middle{at.piece, 0.5 * (outside + inside.t)};
      if (in_reach(i, middle)) {
        inside = middle;
      } else {
        outside = middle.t;
      }
    }
    return inside;
  }

  const Contour& contour_;
  Along here_;
  Along last_;
};

/// The place as one that is not before the start.
Along counted_on(const Contour& contour, const Nearest& place, Along start) {
  Along out{place.piece, place.t};
  if (contour.closed && out < start) out.piece += contour.pieces.size();
  return out;
}

/// Points near the seam of a closed contour may be met before the place that is nearest to the
/// first one: the passage begins with a piece that comes within reach of it.
Along before_reach(const Contour& contour, const Nearest& place) {
  const double allowed = allowed_distance(contour, 0);
  const std::size_t n = contour.pieces.size();
  std::size_t k = place.piece;
  for (std::size_t steps = 0; steps < n; ++steps) {
    if (!(distance_at(contour.pieces[k], 0.0, contour.points[0]) <= allowed)) break;
    k = k > 0 ? k - 1 : n - 1;
  }
  return {k, 0.0};
}

}  // namespace

double allowed_distance(const Contour& contour, std::size_t i) {
  constexpr double kRoundings = 32.0 * kUnitRoundoff;
  const Vec2 p = contour.points[i];
  const double tolerance = i < contour.point_tolerance.size() ? contour.point_tolerance[i] : 0.0;
  return tolerance + kRoundings * (std::abs(p.x) + std::abs(p.y));
}

namespace {

/// The points that are not met once around from where the first one is.
std::vector<std::size_t> missed_once_around(const Contour& contour, Along start,
                                            std::size_t points) {
  Passage careful(contour, start, contour.closed ? 2 : 1);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < points; ++i) {
    if (!careful.meet_first(i)) out.push_back(i);
    if (i == 0 && contour.closed) careful.end_around();
  }
  return out;
}

/// Whether a closed contour meets all points once around from some place of the first one. Where
/// the last one is met behind a whole round from there, no place of the first one will do that is
/// farther before it: the next to try lies a round before the last.
bool goes_around(const Contour& contour, const Along begin, std::size_t points) {
  const std::size_t n = contour.pieces.size();
  Along start = begin;
  for (int k = 0; k < kMostStarts; ++k) {
    Passage passage(contour, start, kRoundsLooked);
    if (!passage.meet_first(0)) return false;
    const Along first = passage.here();
    if (Along{begin.piece + n, begin.t} < first) return false;
    for (std::size_t i = 1; i < points; ++i) {
      if (!passage.meet_first(i)) return false;
    }
    const Along last = passage.here();
    if (last.piece < n) return true;
    start = {last.piece - n, last.t};
    if (!(first < start)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::size_t> out_of_order(const Contour& contour, const std::vector<Nearest>& places) {
  if (places.empty() || contour.pieces.empty()) return {};
  const Along first = contour.closed ? Along{places[0].piece, places[0].t} : Along{};
  Passage quick(contour, first);
  std::size_t met = 0;
  while (met < places.size() && quick.meet_at(met, counted_on(contour, places[met], first))) ++met;
  if (met == places.size()) return {};
  // the nearest places may stand against the order where tolerances are wide: take the first ones
  const Along begin = contour.closed ? before_reach(contour, places[0]) : first;
  if (contour.closed && goes_around(contour, begin, places.size())) return {};
  return missed_once_around(contour, begin, places.size());
}

std::vector<std::size_t> points_out_of_order(const Contour& contour, Watch& watch) {
  if (contour.point_tolerance.empty()) return {};
  return out_of_order(contour, nearest_places(contour, watch));
}

}  // namespace obvid
