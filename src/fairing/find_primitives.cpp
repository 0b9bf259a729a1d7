// SPDX-License-Identifier: Apache-2.0
#include "find_primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "node_ends.h"
#include "obvid/core/units.h"
#include "primitive_joints.h"

namespace obvid::fairing_detail {
namespace {

constexpr std::size_t kFewestPoints = 4;
/// Parts of the tolerance that a fit may use up. Noise of the tolerance's size needs nearly all;
/// the less it is, the better arcs are told from spirals, and the more room the transitions have.
constexpr std::array<double, 3> kShares = {0.99, 0.5, 0.05};
constexpr double kSharperLength = 0.7;
/// A clothoid over a length L departs from its best circle by (change of curvature) L^2 / kHidden.
constexpr double kHidden = 125.0;
/// Least quality: a stretch of a clothoid has 1, one around a vertex about 12, and up to 20 where
/// noise helps it. What is straight by chance is rarer.
constexpr double kLeastQuality = 20.0, kLeastQualityOfLines = 16.0;
constexpr double kLineShare = 0.8;  ///< of a circle's length that a line must reach to be preferred
constexpr double kSameLength = 0.25;  ///< between an arc and the chords of its points
constexpr int kJoinings = 3;  ///< times that neighbours are cut where they touch, and fitted
constexpr int kFitSteps = 8;
constexpr double kFitted = 1e-12;       ///< last step of a fit, in half lengths of the stretch
constexpr double kWorkPerPoint = 0.1;   ///< of a fit's step, against a solver's step on a point
constexpr std::size_t kFitPoints = 64;  ///< a longer stretch is fitted on so many of its points

enum class Kind { kLine, kCircle };

struct CircleFit {
  TubeNode node;
  PlacedNode placed;
};

/// Solves a symmetric positive definite system of `size` unknowns in place; lower triangle given.
bool solve(Mat3& a, Vec3& b, std::size_t size) {
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
    if (!(a[j][j] > 0.0)) return false;
    a[j][j] = std::sqrt(a[j][j]);
    for (std::size_t i = j + 1; i < size; ++i) {
      for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
      a[i][j] /= a[j][j];
    }
    for (std::size_t k = 0; k < j; ++k) b[j] -= a[j][k] * b[k];
    b[j] /= a[j][j];
  }
  for (std::size_t j = size; j-- > 0;) {
    for (std::size_t i = j + 1; i < size; ++i) b[j] -= a[i][j] * b[i];
    b[j] /= a[j][j];
  }
  return true;
}

class Finder {
 public:
  Finder(const SmoothPoints& series, Watch& watch) : s_(series), watch_(watch) {}

  std::vector<Primitive> run() {
    std::vector<Primitive> all;
    for (const double share : kShares) {  // a sharper fit takes the place of one not much longer
      share_ = share;
      const std::vector<Primitive> sharper = candidates();
      std::erase_if(all, [&](const Primitive& p) {
        return std::any_of(sharper.begin(), sharper.end(), [&](const Primitive& q) {
          return common_length(p, q) >= kSharperLength * length(p);
        });
      });
      all.insert(all.end(), sharper.begin(), sharper.end());
    }
    std::vector<Primitive> kept = best_without_overlap(std::move(all));
    join(kept);
    return kept;
  }

  std::vector<Primitive> fitted(std::vector<Primitive> known) {
    std::vector<Primitive> out;
    for (Primitive& p : known) {
      if (keep_free(p) && fit_known(p)) out.push_back(p);
    }
    join(out);
    return out;
  }

 private:
  /// Leaves points of `p` that are not free, and those between them and the nearer end. False: too
  /// few are left.
  [[nodiscard]] bool keep_free(Primitive& p) const {
    const std::size_t middle = p.first + (p.last - p.first) / 2;
    std::size_t first = p.first, last = p.last;
    for (std::size_t i = p.first; i <= p.last; ++i) {
      if (s_.free[wrapped(i)] && s_.reach[wrapped(i)] > 0.0) continue;
      if (i <= middle) first = i + 1;
      if (i > middle) last = std::min(last, i - 1);
    }
    p.first = first;
    p.last = last;
    return last + 1 >= first + kFewestPoints;
  }

  /// By least squares, with its ends at the feet of its first and last point. False: that does not
  /// pass its points.
  [[nodiscard]] bool fit_known(Primitive& p) const {
    const auto lay_ends = [&] {
      const double middle = 0.5 * norm(point(p.last) - point(p.first));
      p.before = -foot_near_by(p, point(p.first), -middle);
      p.after = foot_near_by(p, point(p.last), middle);
      return p.before > 0.0 && p.after > 0.0;
    };
    if (!lay_ends()) return false;
    refit(p);
    for (std::size_t i = p.first; i <= p.last; ++i) {
      if (!lies_within(p, i)) return false;
    }
    return lay_ends();
  }

  [[nodiscard]] double length(const Primitive& p) const { return s_.at[p.last] - s_.at[p.first]; }
  [[nodiscard]] double common_length(const Primitive& p, const Primitive& q) const {
    const std::size_t first = std::max(p.first, q.first), last = std::min(p.last, q.last);
    return first < last ? s_.at[last] - s_.at[first] : 0.0;
  }

  /// Every stretch that cannot be made longer and means a line or circle.
  [[nodiscard]] std::vector<Primitive> candidates() const {
    std::vector<Primitive> found;
    std::size_t last = 0, described = 0;
    for (std::size_t first = 0; first + kFewestPoints <= s_.points.size(); ++first) {
      last = std::max(last, first + kFewestPoints - 1);
      if (!fits(first, last, Kind::kCircle)) continue;
      while (last + 1 < s_.points.size() && fits(first, last + 1, Kind::kCircle)) ++last;
      if (last == described) continue;  // part of the one before
      described = last;
      if (auto p = describe(first, last)) found.push_back(*p);
    }
    return found;
  }

  [[nodiscard]] bool fits(std::size_t first, std::size_t last, Kind kind) const {
    for (std::size_t i = first; i <= last; ++i) {
      if (!s_.free[i] || !(s_.reach[i] > 0.0)) return false;
    }
    const auto fit = fit_circle(first, last, kind);
    return fit && passes(*fit, first, last, share_);
  }

  [[nodiscard]] bool passes(const CircleFit& fit, std::size_t first, std::size_t last,
                            double share) const {
    for (std::size_t i = first; i <= last; ++i) {
      const double d = circle_distance(fit.node, fit.placed, s_.points[i]).value;
      if (!(std::abs(d) <= share * s_.reach[i])) return false;
    }
    return true;
  }

  /// Of their tolerances, the most that points are off.
  [[nodiscard]] double share_used(const CircleFit& fit, std::size_t first, std::size_t last) const {
    double most = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      const double d = circle_distance(fit.node, fit.placed, s_.points[i]).value;
      most = std::max(most, std::abs(d) / s_.reach[i]);
    }
    return most;
  }

  /// Least squares of the distances, by Gauss-Newton from the chord.
  [[nodiscard]] std::optional<CircleFit> fit_circle(std::size_t first, std::size_t last,
                                                    Kind kind) const {
    CircleFit fit;
    TubeNode& n = fit.node;
    const Vec2 chord = s_.points[last] - s_.points[first];
    const double half = 0.5 * (s_.at[last] - s_.at[first]);
    n.point = s_.points[first + (last - first) / 2];
    n.theta = heading(chord);
    n.reach = n.length = half;
    n.normal = left_normal(unit_at(n.theta));
    n.kappa = kind == Kind::kLine ? 0.0 : mean_kappa(first, last);
    n.theta += start_turn(first, last, n.kappa);
    return refined(fit, first, last, kind);
  }

  /// Gauss-Newton from a circle near the points.
  [[nodiscard]] std::optional<CircleFit> refined(CircleFit fit, std::size_t first, std::size_t last,
                                                 Kind kind) const {
    TubeNode& n = fit.node;
    const std::size_t unknowns = kind == Kind::kLine ? 2 : 3;
    const std::size_t step = std::max<std::size_t>(1, (last - first) / kFitPoints);
    Vec3 x{};
    for (int k = 0; k < kFitSteps; ++k) {
      fit.placed = place(n, x.data());
      Mat3 a{};
      Vec3 b{};
      for (std::size_t i = first; i <= last; i += step) add(fit, point(i), a, b);
      watch_.spend(kWorkPerPoint * static_cast<double>((last - first) / step + 1));
      if (!solve(a, b, unknowns)) return std::nullopt;
      double largest = 0.0;
      for (std::size_t j = 0; j < unknowns; ++j) {
        x[j] -= b[j];
        largest = std::max(largest, std::abs(b[j]));
      }
      if (!(largest < 1.0)) return std::nullopt;  // it runs away: no circle
      if (largest < kFitted) break;
    }
    n.point = n.point + x[0] * n.reach * n.normal;
    n.theta += x[1];
    n.kappa += x[2] / n.length;
    x = {};
    fit.placed = place(n, x.data());
    return fit;
  }

  [[nodiscard]] double mean_kappa(std::size_t first, std::size_t last) const {
    const std::size_t middle = first + (last - first) / 2;
    return s_.kappa[middle];
  }

  /// From the heading of the chord to that at the middle point.
  [[nodiscard]] double start_turn(std::size_t first, std::size_t last, double kappa) const {
    const std::size_t middle = first + (last - first) / 2;
    return kappa * (s_.at[middle] - 0.5 * (s_.at[first] + s_.at[last]));
  }

  static void add(const CircleFit& fit, Vec2 point, Mat3& a, Vec3& b) {
    const CircleDistance d = circle_distance(fit.node, fit.placed, point);
    for (std::size_t r = 0; r < kPerNode; ++r) {
      b[r] += d.value * d.slope[r];
      for (std::size_t c = 0; c <= r; ++c) a[r][c] += d.slope[r] * d.slope[c];
    }
  }

  /// Largest difference of the smooth curvature from `kappa` up to half a stretch beyond both ends;
  /// nothing when the series ends there.
  [[nodiscard]] std::optional<double> change_beside(const Primitive& p) const {
    const double half = 0.5 * length(p);
    std::optional<double> largest;
    const auto look = [&](std::size_t i) {
      largest = std::max(largest.value_or(0.0), std::abs(s_.kappa[i] - p.kappa));
    };
    for (std::size_t i = p.first; i-- > 0 && s_.at[p.first] - s_.at[i] <= half;) look(i);
    for (std::size_t i = p.last + 1; i < s_.at.size() && s_.at[i] - s_.at[p.last] <= half; ++i) {
      look(i);
    }
    return largest;
  }

  [[nodiscard]] std::optional<Primitive> describe(std::size_t first, std::size_t last) const {
    Primitive p;
    p.first = first;
    p.last = last;
    p.share = share_;
    Kind kind = Kind::kCircle;
    if (const auto line = line_within(first, last)) {
      p.first = line->first;
      p.last = line->second;
      kind = Kind::kLine;
    }
    const auto fit = fit_circle(p.first, p.last, kind);
    if (!fit) return std::nullopt;
    const double length = this->length(p);
    lay(*fit, p);
    const double middle = s_.at[p.first + (p.last - p.first) / 2];
    p.before = foot_near(p, p.first, s_.at[p.first] - middle);
    p.after = foot_near(p, p.last, s_.at[p.last] - middle);
    if (!(p.before < 0.0 && p.after > 0.0)) return std::nullopt;
    if (!(std::abs(p.after - p.before - length) <= kSameLength * length)) return std::nullopt;
    p.before = -p.before;
    double reach = 0.0;
    for (std::size_t i = p.first; i <= p.last; ++i) reach = std::max(reach, s_.reach[i]);
    const auto beside = change_beside(p);
    if (kind == Kind::kCircle && share_ < kShares.front() && is_line_with_all(p, reach)) {
      return std::nullopt;
    }
    const double used = std::max(kShares.back(), share_used(*fit, p.first, p.last));
    p.quality = beside ? *beside * length * length / (kHidden * used * reach)
                       : std::numeric_limits<double>::infinity();
    const double least = kind == Kind::kLine ? kLeastQualityOfLines : kLeastQuality;
    if (!(p.quality >= least)) return std::nullopt;
    return p;
  }

  /// Of a point, from the anchor; feet beyond half a turn look as if they lay on its other side,
  /// and of some turns that one counts which is nearest to the way along the points.
  [[nodiscard]] double foot_near(const Primitive& p, std::size_t i, double along) const {
    return foot_near_by(p, s_.points[i], along);
  }
  [[nodiscard]] static double foot_near_by(const Primitive& p, Vec2 point, double along) {
    const double foot = foot_on(p, point);
    if (p.kappa == 0.0) return foot;
    const double turn = kFullTurn / std::abs(p.kappa);
    return foot + turn * std::round((along - foot) / turn);
  }

  /// Whether an arc is as flat as the tolerance and a line would do: then it is that line's.
  [[nodiscard]] bool is_line_with_all(const Primitive& p, double reach) const {
    const double length = this->length(p);
    if (!(0.125 * std::abs(p.kappa) * length * length <= reach)) return false;
    const auto line = fit_circle(p.first, p.last, Kind::kLine);
    return line && passes(*line, p.first, p.last, kShares.front());
  }

  /// The longest line inside a stretch, when it is nearly as long.
  [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> line_within(
      std::size_t first, std::size_t last) const {
    const double length = s_.at[last] - s_.at[first];
    std::optional<std::pair<std::size_t, std::size_t>> best;
    double longest = kLineShare * length;
    std::size_t to = first;
    for (std::size_t from = first; from + kFewestPoints - 1 <= last; ++from) {
      if (s_.at[last] - s_.at[from] < longest) break;
      to = std::max(to, from + kFewestPoints - 1);
      while (to < last && fits(from, to + 1, Kind::kLine)) ++to;
      if (s_.at[to] - s_.at[from] < longest || !fits(from, to, Kind::kLine)) continue;
      longest = s_.at[to] - s_.at[from];
      best = {from, to};
    }
    return best;
  }

  static void lay(const CircleFit& fit, Primitive& p) {
    p.anchor = fit.node.point;
    p.theta = fit.node.theta;
    p.kappa = fit.node.kappa;
  }

  /// The best ones whole, the others as far as they lie beside better ones.
  std::vector<Primitive> best_without_overlap(std::vector<Primitive> all) {
    std::sort(all.begin(), all.end(),
              [](const Primitive& a, const Primitive& b) { return a.quality > b.quality; });
    std::vector<Primitive> kept;
    for (const Primitive& p : all) {
      std::size_t first = p.first, last = p.last;
      for (const Primitive& k : kept) {
        if (k.first <= first && first <= k.last) first = k.last + 1;
        if (k.first <= last && last <= k.last) last = k.first > 0 ? k.first - 1 : 0;
      }
      const bool inside = std::any_of(kept.begin(), kept.end(), [&](const Primitive& k) {
        return first <= k.last && k.first <= last;
      });
      if (inside || last < first + kFewestPoints - 1) continue;
      const bool whole = first == p.first && last == p.last;
      share_ = p.share;
      if (whole) {
        kept.push_back(p);
      } else if (const auto part = describe(first, last)) {
        kept.push_back(*part);
      }
    }
    std::sort(kept.begin(), kept.end(),
              [](const Primitive& a, const Primitive& b) { return a.first < b.first; });
    return kept;
  }

  /// Points over the seam of a closed series have numbers from its size on.
  [[nodiscard]] std::size_t wrapped(std::size_t i) const { return i % s_.points.size(); }
  [[nodiscard]] Vec2 point(std::size_t i) const { return s_.points[wrapped(i)]; }

  [[nodiscard]] double reach_of(const Primitive& p) const {
    double least = s_.reach[wrapped(p.first)];
    for (std::size_t i = p.first; i <= p.last; ++i) least = std::min(least, s_.reach[wrapped(i)]);
    return least;
  }

  /// Neighbours that touch each other are cut where they do, whatever points each could have too:
  /// there is room for a transition around that place, and nowhere else.
  void join(std::vector<Primitive>& all) const {
    if (all.size() < 2) return;
    const std::size_t joints = s_.closed ? all.size() : all.size() - 1;
    for (int round = 0; round < kJoinings; ++round) {
      if (round > 0) {
        for (Primitive& p : all) refit(p);
      }
      for (std::size_t k = 0; k < joints; ++k) {
        Primitive a = all[k], b = all[(k + 1) % all.size()];
        const std::size_t turn = k + 1 == all.size() ? s_.points.size() : 0;
        b.first += turn;
        b.last += turn;
        all[k].joined = false;
        if (!meet(a, b)) continue;
        const std::size_t back = std::min(turn, b.first / s_.points.size() * s_.points.size());
        b.first -= back;
        b.last -= back;
        a.joined = true;
        all[k] = a;
        all[(k + 1) % all.size()] = b;
      }
    }
  }

  void refit(Primitive& p) const {
    CircleFit fit;
    TubeNode& n = fit.node;
    n.point = p.anchor;
    n.theta = p.theta;
    n.kappa = p.kappa;
    n.reach = n.length = 0.5 * (p.before + p.after);
    n.normal = left_normal(unit_at(n.theta));
    const auto better = refined(fit, p.first, p.last, p.kappa == 0.0 ? Kind::kLine : Kind::kCircle);
    if (!better) return;
    Primitive next = p;
    lay(*better, next);
    next.before = p.lead - foot_on(next, point(p.first));
    next.after = p.trail + foot_on(next, point(p.last));
    if (next.before > 0.0 && next.after > 0.0) p = next;
  }

  /// Cuts a and b, the next one, where they touch each other. False: they do not, or not here.
  [[nodiscard]] bool meet(Primitive& a, Primitive& b) const {
    const auto place = tangent_place(a, b);
    const double reach = std::min(reach_of(a), reach_of(b));
    if (!place || !(std::abs(place->gap) <= 2.0 * reach)) return false;
    const double most = transition_length(a.kappa, b.kappa, reach);
    const double slack = most + norm(point(b.first) - point(a.last));
    if (std::abs(place->on_first - a.after) > slack ||
        std::abs(place->on_second + b.before) > slack) {
      return false;
    }
    const double length = transition_length(a.kappa, b.kappa, s_.shift * reach);
    const double end = place->on_first - 0.5 * length, start = place->on_second + 0.5 * length;
    return end > 0.0 && start < 0.0 && take_until(a, end) && take_from(b, start) &&
           a.last < b.first;
  }

  [[nodiscard]] bool may_take(const Primitive& p, std::size_t i) const {
    return s_.free[wrapped(i)] && lies_within(p, i);
  }

  [[nodiscard]] bool lies_within(const Primitive& p, std::size_t i) const {
    CircleFit fit;
    fit.node.point = p.anchor;
    fit.node.theta = p.theta;
    fit.node.kappa = p.kappa;
    const Vec3 none{};
    fit.placed = place(fit.node, none.data());
    return std::abs(circle_distance(fit.node, fit.placed, point(i)).value) <= s_.reach[wrapped(i)];
  }

  /// The last point becomes the last one whose foot lies before `end`.
  [[nodiscard]] bool take_until(Primitive& p, double end) const {
    const std::size_t behind = s_.closed ? p.first + s_.points.size() : s_.points.size();
    while (p.last > p.first && foot_on(p, point(p.last)) > end) --p.last;
    while (p.last + 1 < behind) {
      const double foot = foot_on(p, point(p.last + 1));
      if (foot > end) break;
      if (foot <= foot_on(p, point(p.last)) || !may_take(p, p.last + 1)) return false;
      ++p.last;
    }
    p.after = end;
    p.trail = end - foot_on(p, point(p.last));
    return p.last + 1 >= p.first + kFewestPoints;
  }

  /// And the first one the first behind `start`.
  [[nodiscard]] bool take_from(Primitive& p, double start) const {
    while (p.first < p.last && foot_on(p, point(p.first)) < start) ++p.first;
    while (p.first > 0) {
      const double foot = foot_on(p, point(p.first - 1));
      if (foot < start) break;
      if (foot >= foot_on(p, point(p.first)) || !may_take(p, p.first - 1)) return false;
      --p.first;
    }
    p.before = -start;
    p.lead = foot_on(p, point(p.first)) - start;
    return p.last + 1 >= p.first + kFewestPoints;
  }

  const SmoothPoints& s_;
  Watch& watch_;
  double share_ = 1.0;  // of the tolerance that a fit may use up
};

}  // namespace

std::vector<Primitive> find_primitives(const SmoothPoints& series, Watch& watch) {
  return Finder(series, watch).run();
}

std::vector<Primitive> fitted_primitives(const SmoothPoints& series, std::vector<Primitive> known,
                                         Watch& watch) {
  return Finder(series, watch).fitted(std::move(known));
}

}  // namespace obvid::fairing_detail
