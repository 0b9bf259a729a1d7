// SPDX-License-Identifier: Apache-2.0
#include "find_primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "node_ends.h"

namespace obvid::fairing_detail {
namespace {

constexpr std::size_t kFewestPoints = 4;
/// Parts of the tolerance that a fit may use up. Noise of the tolerance's size needs nearly all;
/// the less it is, the better arcs are told from spirals, and the more room the transitions have.
constexpr std::array<double, 3> kShares = {0.95, 0.5, 0.05};
constexpr double kSharperLength = 0.7;
/// A clothoid over a length L departs from its best circle by (change of curvature) L^2 / kHidden.
constexpr double kHidden = 125.0;
/// Least quality: a stretch of a clothoid has 1, one around a vertex about 12.
constexpr double kLeastQuality = 16.0;
constexpr double kLineShare = 0.8;  ///< of a circle's length that a line must reach to be preferred
constexpr double kSameLength = 0.25;  ///< between an arc and the chords of its points
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
    return best_without_overlap(std::move(all));
  }

 private:
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
    if (!fit) return false;
    for (std::size_t i = first; i <= last; ++i) {
      const double d = circle_distance(fit->node, fit->placed, s_.points[i]).value;
      if (!(std::abs(d) <= share_ * s_.reach[i])) return false;
    }
    return true;
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
    const std::size_t unknowns = kind == Kind::kLine ? 2 : 3;
    const std::size_t step = std::max<std::size_t>(1, (last - first) / kFitPoints);
    Vec3 x{};
    for (int k = 0; k < kFitSteps; ++k) {
      fit.placed = place(n, x.data());
      Mat3 a{};
      Vec3 b{};
      for (std::size_t i = first; i <= last; i += step) add(fit, s_.points[i], a, b);
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
    Primitive p{first, last, {}, 0.0, 0.0, 0.0, 0.0, 0.0};
    Kind kind = Kind::kCircle;
    if (const auto line = line_within(first, last)) {
      p.first = line->first;
      p.last = line->second;
      kind = Kind::kLine;
    }
    const auto fit = fit_circle(p.first, p.last, kind);
    if (!fit) return std::nullopt;
    const double length = this->length(p);
    p.anchor = fit->node.point;
    p.theta = fit->node.theta;
    p.kappa = fit->node.kappa;
    p.before = along(*fit, s_.points[p.first]);
    p.after = along(*fit, s_.points[p.last]);
    if (!(p.before < 0.0 && p.after > 0.0)) return std::nullopt;
    // feet beyond half a turn from the anchor look as if they lay on its other side
    if (!(std::abs(p.after - p.before - length) <= kSameLength * length)) return std::nullopt;
    p.before = -p.before;
    double reach = 0.0;
    for (std::size_t i = p.first; i <= p.last; ++i) reach = std::max(reach, s_.reach[i]);
    const auto beside = change_beside(p);
    p.quality = beside ? *beside * length * length / (kHidden * share_ * reach)
                       : std::numeric_limits<double>::infinity();
    if (!(p.quality >= kLeastQuality)) return std::nullopt;
    return p;
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

  /// Arc length along a circle from its anchor to the foot of a point.
  static double along(const CircleFit& fit, Vec2 point) {
    const Vec2 q = point - fit.placed.anchor;
    const double u = dot(fit.placed.tangent, q), v = cross(fit.placed.tangent, q);
    const double k = fit.node.kappa;
    if (k == 0.0) return u;
    return std::atan2(k * u, 1.0 - k * v) / k;
  }

  /// The best ones whole, the others as far as they lie beside better ones.
  [[nodiscard]] std::vector<Primitive> best_without_overlap(std::vector<Primitive> all) const {
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

  const SmoothPoints& s_;
  Watch& watch_;
  double share_ = 1.0;  // of the tolerance that a fit may use up
};

}  // namespace

std::vector<Primitive> find_primitives(const SmoothPoints& series, Watch& watch) {
  return Finder(series, watch).run();
}

}  // namespace obvid::fairing_detail
