// SPDX-License-Identifier: Apache-2.0
// Points in no order that belong to no curve: docs/methods/series.md.
#include "obvid/series/internal/strays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "end_parabola.h"
#include "middle_residual.h"
#include "obvid/geom/vec2.h"
#include "obvid/numeric/internal/median.h"
#include "outlier_rules.h"
#include "spanning_tree.h"

namespace obvid {
namespace {

constexpr int kMostRounds = 4;  // of leaving out and putting back
/// Steps beyond an end, or between both ends of a closed curve, that are none of the curve.
constexpr double kFarther = 3.0;

/// Points that hang on the tree by themselves, up to three in a row: indices of the list.
std::vector<std::size_t> twigs_of(const std::vector<Vec2>& points) {
  const std::size_t n = points.size();
  std::vector<std::vector<std::size_t>> beside(n);
  std::vector<double> steps;
  for (const auto& [a, b] : shortest_tree(points)) {
    beside[a].push_back(b);
    beside[b].push_back(a);
    steps.push_back(norm(points[a] - points[b]));
  }
  const double far = kFarther * median_of(std::move(steps));
  std::vector<std::size_t> out;
  for (std::size_t leaf = 0; leaf < n; ++leaf) {
    if (beside[leaf].size() != 1) continue;
    std::vector<std::size_t> twig{leaf};
    while (twig.size() <= kMostInARow) {
      const std::size_t at = twig.back();
      const std::size_t next = twig.size() > 1 && beside[at][0] == twig[twig.size() - 2]
                                   ? beside[at].back()
                                   : beside[at].front();
      // a way that goes on, but after a step that is none of the curve, ends a twig as well
      if (beside[next].size() > 2 || norm(points[next] - points[at]) > far) {
        out.insert(out.end(), twig.begin(), twig.end());
        break;
      }
      if (beside[next].size() < 2) break;
      twig.push_back(next);
    }
  }
  return out;
}

/// The ordered curve of those that stay.
class OrderedCurve {
 public:
  OrderedCurve(const std::vector<Vec2>& points, const CurveOrder& order) : gap_(order.gap) {
    for (const std::size_t i : order.order) row_.push_back(points[i]);
    std::vector<double> steps;
    for (std::size_t i = 1; i < row_.size(); ++i) steps.push_back(norm(row_[i] - row_[i - 1]));
    step_ = median_of(std::move(steps));
    closed_ = gap_ <= kFarther * step_;
    size_.assign(row_.size(), 0.0);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < row_.size(); ++i) {
      const auto r = residual(i);
      if (!r) continue;
      size_[i] = r->in_deviations();
      sizes.push_back(size_[i]);
    }
    compared_ = sizes.size();
    if (compared_ >= kLeastCompared) deviation_ = deviation_of(std::move(sizes));
    limit_ = kClearly * bound_factor(row_.size());
    goes_on_ = row_goes_on([this](std::size_t k) { return row_[k]; }, row_.size());
  }

  [[nodiscard]] bool tells() const { return compared_ >= kLeastCompared; }
  [[nodiscard]] double deviation() const { return deviation_; }
  [[nodiscard]] double limit() const { return limit_; }

  /// As near as points of the curve are to each other, or beyond an end, from where it goes on.
  [[nodiscard]] bool may_belong(Vec2 q) const {
    const Nearest at = nearest(q);
    return at.beyond || at.distance <= kFarther * step_;
  }

  /// How far a point lies off; nothing where it may belong to the curve.
  [[nodiscard]] std::optional<double> off(Vec2 q) const {
    const auto [chord, distance, beyond] = nearest(q);
    if (beyond) {
      if (!(distance > std::max(kFarther * step_, limit_ * scale(chord)))) return std::nullopt;
      const auto one = seen_from_end(q, chord > 0);
      return one && goes_on_.is_off(*one) ? std::optional(one->off) : std::nullopt;
    }
    const auto a = place(chord, -1), b = place(chord, 0), c = place(chord, 1), d = place(chord, 2);
    if (!a || !b || !c || !d) return std::nullopt;  // ends cannot be told
    const auto r = middle_residual({*a, *b, q, *c, *d});
    const double size = r ? r->in_deviations() : distance;
    if (!(size > limit_ * scale(chord))) return std::nullopt;
    const Vec2 over = *c - *b;
    const auto turns = [&](Vec2 other) {
      return dot(over, other) < kStraight * norm(over) * norm(other);
    };
    const auto before = apart(chord, 0, -1), behind = apart(chord, 1, 1);
    if ((before && turns(*b - *before)) || (behind && turns(*behind - *c))) return std::nullopt;
    const auto along = residual_along_way({*a, *b, q, *c, *d});
    for (const long k : {-1L, 0L, 1L, 2L}) {
      const std::size_t i = *index(chord, k);
      const bool follows = size_[i] <= limit_ * scale(chord) && size_[i] <= kRest * size;
      if (!follows && !(along && follows_along_way(i, *along, scale(chord)))) return std::nullopt;
    }
    // a cubic between close points says nothing of a place that is far beyond their steps
    return r && distance <= kFarther * step_ ? std::min(r->off, distance) : distance;
  }

 private:
  struct Nearest {
    std::size_t chord = 0;  ///< from this point of the row to the next
    double distance = std::numeric_limits<double>::infinity();
    bool beyond = false;  ///< an end of an open row is nearest
  };

  [[nodiscard]] std::optional<std::size_t> index(std::size_t from, long by) const {
    const auto n = static_cast<long>(row_.size());
    long at = static_cast<long>(from) + by;
    if (closed_) at = (at + n) % n;
    if (at < 0 || at >= n) return std::nullopt;
    return static_cast<std::size_t>(at);
  }
  [[nodiscard]] std::optional<Vec2> place(std::size_t from, long by) const {
    const auto at = index(from, by);
    return at ? std::optional(row_[*at]) : std::nullopt;
  }

  /// The first point from there on that is not too near to tell a direction.
  [[nodiscard]] std::optional<Vec2> apart(std::size_t chord, long from, long by) const {
    const Vec2 here = *place(chord, from);
    for (long k = from + by; std::abs(k) < static_cast<long>(row_.size()); k += by) {
      const auto p = place(chord, k);
      if (!p || norm(*p - here) >= kApart * goes_on_.middle_step) return p;
    }
    return std::nullopt;
  }
  [[nodiscard]] std::optional<std::array<Vec2, 5>> five_around(std::size_t i) const {
    std::array<Vec2, 5> five{};
    for (long k = -2; k <= 2; ++k) {
      const auto p = place(i, k);
      if (!p) return std::nullopt;
      five[static_cast<std::size_t>(k + 2)] = *p;
    }
    return five;
  }
  [[nodiscard]] std::optional<MiddleResidual> residual(std::size_t i) const {
    const auto five = five_around(i);
    return five ? middle_residual(*five) : std::nullopt;
  }
  /// Whether a point of the row follows along the way of its neighbours, and one beside it does
  /// not: cubics over a chord miss the curve beside long steps.
  [[nodiscard]] bool follows_along_way(std::size_t i, const MiddleResidual& other,
                                       double deviation) const {
    const auto five = five_around(i);
    const auto own = five ? residual_along_way(*five) : std::nullopt;
    return own && other.in_deviations() > limit_ * deviation &&
           own->in_deviations() <= kRestAroundNose * other.in_deviations();
  }
  [[nodiscard]] std::optional<PastEnd> seen_from_end(Vec2 q, bool from_last) const {
    const std::size_t n = row_.size();
    const auto at = [&](std::size_t k) {
      return k == 0 ? q : from_last ? row_[n - k] : row_[k - 1];
    };
    return past_end_at(at, n + 1, 0, 1, goes_on_.middle_step);
  }

  [[nodiscard]] Nearest nearest(Vec2 q) const {
    Nearest out;
    const std::size_t chords = closed_ ? row_.size() : row_.size() - 1;
    for (std::size_t i = 0; i < chords; ++i) {
      const Vec2 a = row_[i], side = row_[(i + 1) % row_.size()] - a;
      const double part = dot(q - a, side) / dot(side, side);
      const double distance = norm(q - a - std::clamp(part, 0.0, 1.0) * side);
      if (distance >= out.distance) continue;
      const bool beyond = !closed_ && ((i == 0 && part < 0.0) || (i + 1 == chords && part > 1.0));
      out = {i, distance, beyond};
    }
    return out;
  }

  [[nodiscard]] double scale(std::size_t i) const {
    const std::size_t first = i - std::min(i, kAround),
                      last = std::min(row_.size() - 1, i + kAround);
    const auto at = [&](std::size_t k) { return size_.begin() + static_cast<std::ptrdiff_t>(k); };
    return std::max(deviation_, deviation_of({at(first), at(last) + 1}));
  }

  std::vector<Vec2> row_;
  double gap_, step_ = 0.0;
  bool closed_ = false;
  std::vector<double> size_;
  std::size_t compared_ = 0;
  double deviation_ = 0.0, limit_ = 0.0;
  RowGoesOn goes_on_;
};

class StraySearch {
 public:
  explicit StraySearch(const std::vector<Vec2>& points) : points_(points) {}

  std::optional<OrderBesideStrays> run() {
    const double most = kMostOfAll * static_cast<double>(points_.size());
    std::set<std::size_t> gone, stay;  // what stays was looked at and belongs to the curve
    for (int round = 0; round < kMostRounds; ++round) {
      const std::vector<std::size_t> left = without(gone);
      for (const std::size_t k : twigs_of(chosen(left))) {
        if (!stay.contains(left[k])) gone.insert(left[k]);
      }
      if (gone.empty() || static_cast<double>(gone.size()) > most) return std::nullopt;
      auto order = order_of(gone);
      if (!order) continue;
      const OrderedCurve curve(points_, *order);
      if (!curve.tells()) return std::nullopt;
      OrderBesideStrays out{std::move(*order), {{}, curve.deviation(), curve.limit()}};
      std::set<std::size_t> back;
      for (const std::size_t i : gone) {
        if (const auto off = curve.off(points_[i])) {
          out.strays.points.push_back({i, *off});
        } else if (curve.may_belong(points_[i])) {
          back.insert(i);
        }
      }
      if (out.strays.points.size() == gone.size()) return out;
      for (const std::size_t i : back) gone.erase(i);
      stay.merge(back);
      if (gone.empty()) return std::nullopt;
      order = order_of(gone);
      if (!order) continue;
      const OrderedCurve whole(points_, *order);
      out.strays = {{}, whole.deviation(), whole.limit()};
      for (const std::size_t i : gone) {
        const auto off = whole.off(points_[i]);
        if (!off) return std::nullopt;
        out.strays.points.push_back({i, *off});
      }
      out.order = std::move(*order);
      return out;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::vector<std::size_t> without(const std::set<std::size_t>& gone) const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!gone.contains(i)) out.push_back(i);
    }
    return out;
  }
  [[nodiscard]] std::vector<Vec2> chosen(const std::vector<std::size_t>& left) const {
    std::vector<Vec2> out;
    for (const std::size_t i : left) out.push_back(points_[i]);
    return out;
  }
  [[nodiscard]] std::optional<CurveOrder> order_of(const std::set<std::size_t>& gone) const {
    const std::vector<std::size_t> left = without(gone);
    auto found = order_along_curve(chosen(left));
    if (!found) return std::nullopt;
    for (std::size_t& i : found->order) i = left[i];
    return std::move(*found);
  }

  const std::vector<Vec2>& points_;
};

}  // namespace

std::optional<OrderBesideStrays> order_beside_strays(const std::vector<Vec2>& points) {
  if (points.size() < kLeastCompared || points.size() > kMostOrdered) return std::nullopt;
  return StraySearch(points).run();
}

}  // namespace obvid
