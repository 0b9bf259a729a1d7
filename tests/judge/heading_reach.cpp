// SPDX-License-Identifier: Apache-2.0
#include "heading_reach.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "region.h"

namespace judge {
namespace {

constexpr Real kQuarterTurn = 0.5L * kStraightAngle;
/// Headings looked at of each point: towards both ends of its range ever closer together, down to
/// 1e-7 of it.
constexpr int kHeadingsToEachEnd = 48;
constexpr Real kNearestToEnd = 1e-7L;
/// Then around those of the best curve so far.
constexpr int kHeadingsAround = 16, kRounds = 12;
constexpr Real kCloser = 0.4L;

/// A heading of a point with the curvatures that can be reached with it from one side.
struct ReachedPlace {
  Real theta = 0.0L;
  bool reached = false;
  Limits kappas;
  std::size_t before = 0;  ///< the place of the point before that leaves most
};
using ReachedPlaces = std::vector<ReachedPlace>;

/// The way from one end of a section to point `i`.
class Way {
 public:
  /// Rows in the order of the way; `ahead` when that is the order of the points.
  Way(const SheetPart& part, const Input& input, std::vector<std::size_t> rows, bool ahead,
      Real theta)
      : part_(part), input_(input), rows_(std::move(rows)), ahead_(ahead), theta_(theta) {}

  /// What is left at its end. Nothing: no way was found.
  std::optional<Limits> run() {
    std::vector<std::vector<Real>> headings;
    for (std::size_t k = 0; k <= rows_.size(); ++k) headings.push_back(looked_at(k));
    std::optional<Limits> best;
    Real window = 1.0L;
    for (int round = 0; round < kRounds; ++round, window *= kCloser) {
      const std::vector<ReachedPlaces> way = walk(headings);
      const ReachedPlace& end = way.back().front();
      if (!end.reached) return best;
      if (!best || more(end.kappas, *best)) best = end.kappas;
      std::size_t at = 0;
      for (std::size_t k = way.size(); k-- > 0;) {
        headings[k] = around(headings[k], way[k][at].theta, round == 0);
        at = way[k][at].before;
      }
    }
    return best;
  }

  [[nodiscard]] Limits own(std::size_t point) const {
    const SheetPoint& p = part_.points[point];
    Limits out;
    if (point < part_.kappas.size() && part_.kappas[point] > 0.0) out.low = 0.0L;
    if (point < part_.kappas.size() && part_.kappas[point] < 0.0) out.high = 0.0L;
    if (p.inserted > 0 || p.index >= input_.points.size()) return out;
    const GivenPoint& given = input_.points[p.index];
    if (given.kappas) {
      out.low = std::max<Real>(out.low, given.kappas->least);
      out.high = std::min<Real>(out.high, given.kappas->greatest);
    }
    if (given.kappa) out = {*given.kappa, *given.kappa};
    return out;
  }

 private:
  [[nodiscard]] std::size_t start_of(std::size_t k) const {
    return ahead_ ? part_.rows[rows_[k]].from : part_.rows[rows_[k]].to;
  }
  [[nodiscard]] std::size_t point(std::size_t k) const {
    if (k < rows_.size()) return start_of(k);
    return ahead_ ? part_.rows[rows_.back()].to : part_.rows[rows_.back()].from;
  }

  [[nodiscard]] std::vector<Real> looked_at(std::size_t k) const {
    if (k == rows_.size()) return {theta_};
    const SheetPoint& p = part_.points[point(k)];
    if (p.heading_given || !p.headings || p.headings->empty() || beside_an_arc(point(k))) {
      return {p.heading};
    }
    std::vector<Real> out{p.heading};
    const auto look = [&out](Real low, Real high) {
      for (int j = 0; j <= kHeadingsToEachEnd; ++j) {
        const Real part =
            0.5L * std::pow(2.0L * kNearestToEnd, static_cast<Real>(j) / kHeadingsToEachEnd);
        out.push_back(low + part * (high - low));
        out.push_back(high - part * (high - low));
      }
    };
    look(p.headings->low, p.headings->high);
    // at an end of the series the range is told up to a right angle from the chord alone
    if (k == 0 && p.low_is_open) look(p.headings->low - kQuarterTurn, p.headings->low);
    if (k == 0 && p.high_is_open) look(p.headings->high, p.headings->high + kQuarterTurn);
    std::sort(out.begin(), out.end());
    return out;
  }

  [[nodiscard]] bool beside_an_arc(std::size_t i) const {
    return std::any_of(part_.rows.begin(), part_.rows.end(), [&](const SheetRow& row) {
      return part_.touches(row, i) && part_.direction(row) == 0;
    });
  }

  /// Ever closer around one of them, as far as its neighbours at first.
  [[nodiscard]] static std::vector<Real> around(const std::vector<Real>& all, Real theta,
                                                bool first) {
    if (all.size() == 1) return all;
    const auto at = std::find(all.begin(), all.end(), theta);
    const Real below = at == all.begin() ? theta : *(at - 1);
    const Real above = at + 1 == all.end() ? theta : *(at + 1);
    const Real reach = first ? 1.0L : 2.0L;
    std::vector<Real> out;
    for (int j = -kHeadingsAround; j <= kHeadingsAround; ++j) {
      const Real part = reach * static_cast<Real>(j) / kHeadingsAround;
      out.push_back(theta + (j < 0 ? theta - below : above - theta) * part);
    }
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  [[nodiscard]] std::vector<ReachedPlaces> walk(const std::vector<std::vector<Real>>& headings) const {
    std::vector<ReachedPlaces> out(headings.size());
    for (std::size_t k = 0; k < headings.size(); ++k) {
      for (const Real theta : headings[k]) {
        ReachedPlace place;
        place.theta = theta;
        place.reached = k == 0;
        if (k > 0) {
          for (std::size_t j = 0; j < out[k - 1].size(); ++j) step(k - 1, out[k - 1][j], j, place);
        }
        out[k].push_back(place);
      }
    }
    return out;
  }

  /// Whether one of two open ranges leaves more than another one on this way.
  static bool more(const Limits& a, const Limits& b) { return a.low < b.low || a.high > b.high; }

  void step(std::size_t k, const ReachedPlace& from, std::size_t which, ReachedPlace& to) const {
    if (!from.reached) return;
    const Limits mine = own(point(k));
    const Limits all{std::max(from.kappas.low, mine.low), std::min(from.kappas.high, mine.high)};
    const bool fixed = mine.low == mine.high || from.kappas.low == from.kappas.high;
    if (fixed ? all.empty() : !(all.low < all.high)) return;
    const std::optional<Limits> next = over(rows_[k], from.theta, to.theta, all);
    if (!next) return;
    if (to.reached && !more(*next, to.kappas)) return;
    to.reached = true;
    to.kappas = *next;
    to.before = which;
  }

  /// The curvature of the arc over a chord, where the table says one.
  [[nodiscard]] Limits of_arc(const SheetRow& row) const {
    if (row.start && row.start->low == row.start->high) return *row.start;
    return {};
  }

  /// Curvatures behind a chord; nothing where no spiral has these headings.
  [[nodiscard]] std::optional<Limits> over(std::size_t row, Real before, Real behind,
                                           const Limits& from) const {
    const SheetRow& r = part_.rows[row];
    const int direction = part_.direction(r).value_or(0);
    if (direction == 0) return of_arc(r);
    const Vec chord = part_.chord(r);
    const Real omega = std::atan2(chord.y, chord.x), h = norm(chord), d = direction;
    const auto angle = [&](Real theta) {
      return d * std::remainder(theta - omega, 2.0L * kStraightAngle);
    };
    const Real alpha = angle(ahead_ ? before : behind), beta = angle(ahead_ ? behind : before);
    if (!(alpha + beta > 0.0L)) return std::nullopt;
    const Real q = std::pow(std::sin(0.5L * (alpha + beta)), 2);
    // in the mirror image where curvature grows along the points
    const Real low = d > 0.0L ? from.low : -from.high, high = d > 0.0L ? from.high : -from.low;
    Limits out;
    if (ahead_) {
      const Real a = 0.5L * low * h + std::sin(alpha);
      if (!(a < 0.0L)) return std::nullopt;
      out.low = 2.0L / h * (std::sin(beta) + q / -a);
    } else {
      const Real b = 0.5L * high * h - std::sin(beta);
      if (!(b > 0.0L)) return std::nullopt;
      out.high = 2.0L / h * (-std::sin(alpha) - q / b);
    }
    return d > 0.0L ? out : Limits{-out.high, -out.low};
  }

  const SheetPart& part_;
  const Input& input_;
  std::vector<std::size_t> rows_;
  bool ahead_;
  Real theta_;
};

}  // namespace

bool found_with_heading(const SheetPart& part, const Input& input, std::size_t i, Real theta) {
  std::vector<std::size_t> before, behind;
  std::size_t first = part.rows.size();
  for (std::size_t k = 0; k < part.rows.size(); ++k) {
    if (part.rows[k].from == i || part.rows[k].to == i) first = std::min(first, k);
  }
  const auto [from, end] = part.section(first);
  for (std::size_t k = from; k < end && part.rows[k].to <= i; ++k) before.push_back(k);
  for (std::size_t k = end; k-- > from && part.rows[k].from >= i;) behind.push_back(k);
  Limits all = Way(part, input, {}, true, theta).own(i);
  const bool fixed = all.low == all.high;
  for (const auto& [rows, ahead] : {std::pair{before, true}, std::pair{behind, false}}) {
    if (rows.empty()) continue;
    const auto left = Way(part, input, rows, ahead, theta).run();
    if (!left) return false;
    all = {std::max(all.low, left->low), std::min(all.high, left->high)};
  }
  return fixed ? !all.empty() : all.low < all.high;
}

}  // namespace judge
