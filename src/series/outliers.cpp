// SPDX-License-Identifier: Apache-2.0
// Derivation: docs/methods/series.md.
#include "obvid/series/internal/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "middle_residual.h"
#include "obvid/geom/internal/chord.h"
#include "obvid/series/internal/strays.h"
#include "outlier_rules.h"

namespace obvid {
namespace {

constexpr std::size_t kSide = 2;  ///< neighbours of a cubic on each side

class Search {
 public:
  Search(const std::vector<Vec2>& points, const std::vector<bool>& kept)
      : points_(points),
        kept_(kept),
        before_(points.size()),
        behind_(points.size()),
        gone_(points.size(), false) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      before_[i] = i - 1;  // beyond all of the first
      behind_[i] = i + 1;
    }
  }

  Result<Outliers> run() {
    OBVID_TRY(measure());
    std::priority_queue<std::pair<double, std::size_t>> worst;
    for (std::size_t i = 0; i < size_.size(); ++i) {
      if (size_[i] > limit_ * scale_[i]) worst.emplace(size_[i] / scale_[i], i);
    }
    while (!worst.empty()) {
      const std::size_t i = worst.top().second;
      worst.pop();
      if (gone_[i] || !is_off(i)) continue;
      drop_row_around(i);
      if (static_cast<double>(out_.points.size()) >
          kMostOfAll * static_cast<double>(points_.size())) {
        return error(ErrorCode::kNothingThere,
                     "more than a tenth of the points lie off the curve of their neighbours: that "
                     "is no matter of single points")
            .hint("say how far they may move")
            .value(static_cast<double>(out_.points.size()));
      }
    }
    drop_at_ends();
    std::sort(out_.points.begin(), out_.points.end(),
              [](const Outlier& a, const Outlier& b) { return a.index < b.index; });
    out_.limit = limit_;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (gone_[i]) continue;
      const auto r = residual(i);
      if (!r) {
        out_.untold.push_back(i);
        continue;
      }
      const double off = off_neighbours(i, *r);
      if (off > limit_ * out_.deviation) out_.staying.push_back({i, off});
    }
    return std::move(out_);
  }

 private:
  Result<void> measure() {
    const std::size_t n = points_.size();
    size_.assign(n, 0.0);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < n; ++i) {
      const auto r = residual(i);
      if (!r) continue;
      size_[i] = r->in_deviations();
      sizes.push_back(size_[i]);
    }
    if (sizes.size() < kLeastCompared) {
      return error(ErrorCode::kTooFewPoints, "too few points to find outliers among")
          .hint("leave out what is wrong by hand")
          .value(static_cast<double>(sizes.size()));
    }
    limit_ = kClearly * bound_factor(n);
    out_.deviation = deviation_of(sizes);
    scale_.assign(n, out_.deviation);
    for (std::size_t i = 0; i < n; ++i) {
      if (size_[i] <= limit_ * out_.deviation) continue;
      const std::size_t first = i - std::min(i, kAround), last = std::min(n - 1, i + kAround);
      scale_[i] = std::max(scale_[i],
                           deviation_of({size_.begin() + at(first), size_.begin() + at(last) + 1}));
    }
    return {};
  }
  static std::ptrdiff_t at(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  /// Cubics pass over the ends of a row: points there are told from what is left behind them.
  void drop_at_ends() {
    std::vector<std::size_t> left;
    std::vector<Vec2> row;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (gone_[i]) continue;
      left.push_back(i);
      row.push_back(points_[i]);
    }
    CurveOrder as_it_is;
    as_it_is.order.resize(row.size());
    std::iota(as_it_is.order.begin(), as_it_is.order.end(), std::size_t{0});
    as_it_is.gap = norm(row.back() - row.front());
    const auto shorter = without_end_strays(row, as_it_is);
    if (!shorter) return;
    const auto& strays = shorter->strays.points;
    if (!std::all_of(strays.begin(), strays.end(),
                     [&](const Outlier& one) { return may_go(left[one.index]); })) {
      return;
    }
    for (const Outlier& one : strays) {
      gone_[left[one.index]] = true;
      out_.points.push_back({left[one.index], one.off});
    }
    before_[left[shorter->order.order.front()]] = points_.size();
    behind_[left[shorter->order.order.back()]] = points_.size();
  }

  /// Of a point among those that are left.
  [[nodiscard]] std::optional<MiddleResidual> residual(std::size_t i) const {
    const auto five = five_around(i);
    return five ? middle_residual(*five) : std::nullopt;
  }
  [[nodiscard]] std::optional<std::array<Vec2, 2 * kSide + 1>> five_around(std::size_t i) const {
    std::array<Vec2, 2 * kSide + 1> five{};
    five[kSide] = points_[i];
    std::size_t left = i, right = i;
    for (std::size_t k = 1; k <= kSide; ++k) {
      left = before_[left];
      right = behind_[right];
      if (left >= points_.size() || right >= points_.size()) return std::nullopt;
      five[kSide - k] = points_[left];
      five[kSide + k] = points_[right];
    }
    return five;
  }
  /// Distance from what lies nearest of all that neighbours say: the cubic over their chord, the
  /// one along their way, the line between them. Beside long steps the cubics may swing far out.
  [[nodiscard]] double off_neighbours(std::size_t i, const MiddleResidual& r) const {
    const auto five = *five_around(i);
    double off = std::min(r.off, distance_from_chord(points_[i], five[kSide - 1], five[kSide + 1]));
    if (const auto along = residual_along_way(five)) off = std::min(off, along->off);
    return off;
  }
  [[nodiscard]] bool is_beyond(const MiddleResidual& r, double deviations, std::size_t i) const {
    return r.in_deviations() > deviations * scale_[i];
  }
  [[nodiscard]] bool is_off(std::size_t i) const {
    const auto r = residual(i);
    return r && is_beyond(*r, limit_, i);
  }
  [[nodiscard]] bool may_go(std::size_t i) const { return i >= kept_.size() || !kept_[i]; }

  /// The shortest row with the point without which all that is left follows.
  void drop_row_around(std::size_t i) {
    for (std::size_t length = 1; length <= kMostInARow; ++length) {
      std::size_t first = i;
      for (std::size_t back = 0; back < length; ++back) {
        if (first < points_.size() && follows_without(first, length)) return take(first, length);
        if (first < points_.size()) first = before_[first];
      }
    }
  }

  [[nodiscard]] bool follows_without(std::size_t first, std::size_t length) {
    std::size_t end = first;
    for (std::size_t k = 0; k < length; ++k) {
      if (end >= points_.size() || !may_go(end)) return false;
      end = behind_[end];
    }
    const std::size_t left = before_[first];
    if (left >= points_.size() || end >= points_.size()) return false;  // ends cannot be told
    link(left, end);
    bool good = goes_straight_on(left, end);
    double least = std::numeric_limits<double>::infinity();  // of those that would go
    std::size_t one = first;
    for (std::size_t k = 0; k < length; ++k, one = behind_[one]) {
      const auto r = between(left, one, end);
      good = good && r && is_beyond(*r, limit_, one);
      if (r) least = std::min(least, r->in_deviations());
    }
    const auto follows = [&](std::size_t i) {
      const auto r = residual(i);
      return !r || (!is_beyond(*r, limit_ / kClearly, i) && r->in_deviations() <= kRest * least) ||
             (good && length == 1 && follows_around_nose(i, first, end));
    };
    std::size_t i = left;
    for (std::size_t k = 0; k < kSide && i < points_.size(); ++k, i = before_[i]) {
      good = good && follows(i);
    }
    i = end;
    for (std::size_t k = 0; k < kSide && i < points_.size(); ++k, i = behind_[i]) {
      good = good && follows(i);
    }
    if (!good) {
      behind_[left] = first;
      before_[end] = last_of(first, length);
    }
    return good;
  }
  /// Whether a point that is left follows along the way of its neighbours, and a single one that
  /// would go does not.
  [[nodiscard]] bool follows_around_nose(std::size_t i, std::size_t gone, std::size_t end) {
    const double scale = scale_along_way(gone);
    const auto five = five_around(i);
    const auto r = five ? residual_along_way(*five) : std::nullopt;
    const auto off = residual_along_way(five_with(before_[end], gone, end));
    return r && off && off->in_deviations() > limit_ * scale &&
           r->in_deviations() <= kRestAroundNose * off->in_deviations();
  }
  /// Deviation along the way, of the points around.
  [[nodiscard]] double scale_along_way(std::size_t i) {
    if (along_.empty()) along_.resize(points_.size());
    const std::size_t last = std::min(points_.size() - kSide, i + kAround + 1);
    std::vector<double> sizes;
    for (std::size_t k = std::max(i, kAround + kSide) - kAround; k < last; ++k) {
      if (!along_[k]) {
        const auto r = residual_along_way(
            {points_[k - 2], points_[k - 1], points_[k], points_[k + 1], points_[k + 2]});
        along_[k] = r ? r->in_deviations() : 0.0;
      }
      sizes.push_back(*along_[k]);
    }
    return std::max(scale_[i], deviation_of(std::move(sizes)));
  }
  /// Whether the curve hardly turns over a gap: at a nose or a corner it does.
  [[nodiscard]] bool goes_straight_on(std::size_t left, std::size_t right) const {
    const std::size_t more_left = before_[left], more_right = behind_[right];
    const Vec2 over = points_[right] - points_[left];
    const auto turns = [&](Vec2 other) {
      return dot(over, other) < kStraight * norm(over) * norm(other);
    };
    return !(more_left < points_.size() && turns(points_[left] - points_[more_left])) &&
           !(more_right < points_.size() && turns(points_[more_right] - points_[right]));
  }
  [[nodiscard]] std::size_t last_of(std::size_t first, std::size_t length) const {
    for (; length > 1; --length) first = behind_[first];
    return first;
  }
  void link(std::size_t left, std::size_t right) {
    behind_[left] = right;
    before_[right] = left;
  }

  /// Out of the row already; each is told from the curve of those that are left.
  void take(std::size_t first, std::size_t length) {
    const std::size_t left = before_[first], right = behind_[last_of(first, length)];
    for (std::size_t k = 0; k < length; ++k, first = behind_[first]) {
      gone_[first] = true;
      out_.points.push_back({first, distance_between(left, first, right)});
    }
  }
  /// Of a point that was left out between two that are neighbours now.
  [[nodiscard]] std::optional<MiddleResidual> between(std::size_t left, std::size_t i,
                                                      std::size_t right) const {
    const bool inside = before_[left] < points_.size() && behind_[right] < points_.size();
    return inside ? middle_residual(five_with(left, i, right)) : std::nullopt;
  }
  [[nodiscard]] std::array<Vec2, 2 * kSide + 1> five_with(std::size_t left, std::size_t i,
                                                          std::size_t right) const {
    return {points_[before_[left]], points_[left], points_[i], points_[right],
            points_[behind_[right]]};
  }
  [[nodiscard]] double distance_between(std::size_t left, std::size_t i, std::size_t right) const {
    if (const auto r = between(left, i, right)) return r->off;
    const Vec2 chord = points_[right] - points_[left];
    return std::abs(cross(chord, points_[i] - points_[left])) / norm(chord);
  }

  const std::vector<Vec2>& points_;
  const std::vector<bool>& kept_;
  std::vector<std::size_t> before_, behind_;  ///< of those that are left
  std::vector<bool> gone_;
  std::vector<double> size_, scale_;
  std::vector<std::optional<double>> along_;  ///< sizes along the way, where they were asked for
  double limit_ = 0.0;
  Outliers out_;
};

}  // namespace

Result<Outliers> outliers_of(const std::vector<Vec2>& points, const std::vector<bool>& kept) {
  return Search(points, kept).run();
}

}  // namespace obvid
