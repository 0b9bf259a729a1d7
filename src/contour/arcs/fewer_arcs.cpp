// SPDX-License-Identifier: Apache-2.0
// The least number of pairs: docs/methods/gcode.md.
#include "fewer_arcs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "obvid/numeric/internal/banded.h"

namespace obvid::arcs {
namespace {

/// An arc of length l that meets a curve at its ends and its middle leaves it by r l^3 / kBestArc
/// where the curvature changes at the rate r: 216/sqrt(3).
constexpr double kBestArc = 124.707658144959;
constexpr std::size_t kSamplesOfPair = 16;   // distances that the fit sees
constexpr std::size_t kLooksAtPair = 48;     // at which the tolerance is looked at
constexpr double kBetweenLooks = 0.995;      // of the tolerance: what these may miss
constexpr std::size_t kLooksAtDensity = 16;  // of the curvature, beside a pair, and a piece
/// Powers of the distances whose sum is made least, one after another; steps for each.
constexpr std::array kPowers = {2.0, 4.0, 8.0, 16.0, 32.0};
constexpr int kSteps = 12;
constexpr double kSettledSum = 1e-3;  // of the sum: what a step that ends a power still gains
constexpr double kDampingFirst = 1e-3, kDampingLeast = 1e-9, kDampingLast = 1e6;
constexpr double kMostOfPair = 0.3;  // that a node may move along in one step, of a pair
constexpr double kMostRatio = 4.0;   // of legs
/// Of whatever unit: sums and pivots of a curve that bends nowhere stay what can be divided by.
constexpr double kNotNothing = 1e-300;
/// Of the density: what straight and round places have all the same, so that nodes are apart.
constexpr double kLeastDensity = 0.02;

/// Unknowns of a node, and of the pair behind it.
struct State {
  double s = 0.0;       ///< arc length along the contour
  double offset = 0.0;  ///< off the contour, to its left
  double lean = 0.0;    ///< heading off the contour's
  double legs = 0.0;    ///< logarithm of their ratio
};
constexpr std::size_t kUnknowns = 4;

double& unknown(State& state, std::size_t k) {
  return k == 0 ? state.s : k == 1 ? state.offset : k == 2 ? state.lean : state.legs;
}

class PairFit {
 public:
  PairFit(const PairsAlong& along, std::size_t pairs, Watch* watch)
      : along_(along), n_(pairs), watch_(watch) {}

  std::optional<std::vector<Node>> run() {
    begin();
    distances_ = all_distances(states_);
    for (std::size_t p = 0; p < kPowers.size(); ++p) {
      if (!lower_sum(kPowers[p])) break;
      if (is_to_end(watch_)) return std::nullopt;
      if (is_within()) return nodes();
      // no largest distance is below the least of means
      const double count = static_cast<double>(n_ * (kSamplesOfPair + 1));
      if (sum_of(distances_, kPowers[p]) > count) break;
    }
    return std::nullopt;
  }

 private:
  using Samples = std::array<double, kSamplesOfPair + 1>;

  /// Nodes with equal integrals of the density of the best arcs between them.
  void begin() {
    const std::size_t looks = kLooksAtDensity * n_;
    std::vector<double> sum(looks + 1, 0.0);
    const double step = (along_.to - along_.from) / static_cast<double>(looks);
    std::vector<double> density(looks);
    for (std::size_t k = 0; k < looks; ++k) {
      const Jet jet = along_.track.jet(along_.from + (static_cast<double>(k) + 0.5) * step, false);
      density[k] = std::cbrt(std::abs(curvature_rate(jet)));
    }
    const double mean =
        std::accumulate(density.begin(), density.end(), 0.0) / static_cast<double>(looks);
    for (std::size_t k = 0; k < looks; ++k) {
      sum[k + 1] = sum[k] + density[k] + kLeastDensity * mean + kNotNothing;
    }
    states_.assign(n_ + (along_.closed ? 0 : 1), {});
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const double part = sum.back() * static_cast<double>(i) / static_cast<double>(n_);
      const auto above = std::upper_bound(sum.begin() + 1, sum.end() - 1, part);
      const auto k = static_cast<std::size_t>(above - sum.begin()) - 1;
      const double within = std::clamp((part - sum[k]) / (sum[k + 1] - sum[k]), 0.0, 1.0);
      states_[i].s = along_.from + (static_cast<double>(k) + within) * step;
    }
    if (!along_.closed) states_.back().s = along_.to;
  }

  [[nodiscard]] Jet jet(double s, bool from_left) const {
    if (along_.closed && s > along_.to) s -= along_.to - along_.from;
    return along_.track.jet(s, from_left || s >= along_.to);
  }

  [[nodiscard]] Node node_of(const State& state) const {
    const Jet at = jet(state.s, state.s >= along_.to);
    const double theta = heading(at.d1);
    Node out{state.s, at.point, theta + state.lean};
    if (state.offset != 0.0) out.point = at.point + state.offset * left_normal(unit_at(theta));
    return out;
  }

  /// State of the node behind pair i; around a closed contour the first one, a lap on.
  [[nodiscard]] State behind(const std::vector<State>& states, std::size_t i) const {
    if (i + 1 < states.size()) return states[i + 1];
    State out = states.front();
    out.s += along_.to - along_.from;
    return out;
  }

  template <class Found>
  void along_pair(const State& a, const State& b, std::size_t looks, const Found& found) const {
    const Node from = node_of(a);
    Node to = node_of(b);
    to.ratio = std::exp(a.legs);
    const CirclePair circles = circles_between(from, to);
    // as many places beside each of the arcs, whose lengths may differ a lot
    const double before = norm(circles.second.start - from.point);
    const double share = before / (before + norm(to.point - circles.second.start));
    for (std::size_t k = 0; k <= looks; ++k) {
      const double even = 2.0 * static_cast<double>(k) / static_cast<double>(looks);
      const double part = even <= 1.0  ? share * even
                          : even < 2.0 ? share + (1.0 - share) * (even - 1.0)
                                       : 1.0;
      const Vec2 p = jet(a.s + part * (b.s - a.s), k == looks).point;
      const bool first = dot(p - circles.second.start, circles.second.tangent) <= 0.0;
      found(k, signed_distance(first ? circles.first : circles.second, p));
    }
  }

  [[nodiscard]] Samples distances(const State& a, const State& b) const {
    Samples out{};
    along_pair(a, b, kSamplesOfPair, [&](std::size_t k, double off) { out[k] = off; });
    return out;
  }
  [[nodiscard]] std::vector<Samples> all_distances(const std::vector<State>& states) const {
    std::vector<Samples> out;
    for (std::size_t i = 0; i < n_; ++i) out.push_back(distances(states[i], behind(states, i)));
    return out;
  }

  [[nodiscard]] double largest() const {
    double out = 0.0;
    for (const Samples& pair : distances_) {
      for (const double off : pair) out = std::max(out, std::abs(off));
    }
    return out;
  }

  /// Sum of a power of distances over the tolerance.
  [[nodiscard]] double sum_of(const std::vector<Samples>& distances, double power) const {
    double out = 0.0;
    for (const Samples& pair : distances) {
      for (const double off : pair) out += std::pow(std::abs(off) / along_.tolerance, power);
    }
    return std::isfinite(out) ? out : HUGE_VAL;
  }

  /// Whether both arcs of a pair go forward and turn by less than half a turn: distances are those
  /// from whole circles.
  [[nodiscard]] bool goes_on(const State& a, const State& b) const {
    const Node from = node_of(a);
    Node to = node_of(b);
    to.ratio = std::exp(a.legs);
    const CirclePair circles = circles_between(from, to);
    const Vec2 joint = circles.second.start, middle = circles.second.tangent;
    return dot(joint - from.point, circles.first.tangent) > 0.0 &&
           dot(joint - from.point, middle) > 0.0 && dot(to.point - joint, middle) > 0.0 &&
           dot(to.point - joint, unit_at(to.theta)) > 0.0;
  }

  [[nodiscard]] bool is_within() const {
    if (!(largest() <= along_.tolerance)) return false;
    double most = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (!goes_on(states_[i], behind(states_, i))) return false;
      along_pair(states_[i], behind(states_, i), kLooksAtPair,
                 [&](std::size_t, double off) { most = std::max(most, std::abs(off)); });
    }
    return most <= kBetweenLooks * along_.tolerance;
  }

  [[nodiscard]] std::vector<Node> nodes() const {
    std::vector<Node> out{node_of(states_.front())};
    for (std::size_t i = 0; i < n_; ++i) {
      const State next = behind(states_, i);
      const bool seam = i + 1 == n_;
      out.push_back(seam && along_.closed ? out.front() : node_of(next));
      if (seam) out.back().s = along_.to;
      out.back().ratio = std::exp(states_[i].legs);
    }
    return out;
  }

  /// Blocks of unknowns so that neighbours around a loop are at most two apart: 0, n-1, 1, n-2, ...
  [[nodiscard]] std::size_t block(std::size_t i) const {
    if (!along_.closed) return i;
    return 2 * i < states_.size() ? 2 * i : 2 * (states_.size() - 1 - i) + 1;
  }
  [[nodiscard]] bool is_free(std::size_t node, std::size_t k) const {
    if (along_.closed) return node > 0 || k > 0;  // the seam lies where it was
    if (k == 3) return node < n_;
    return node > 0 && node < n_;
  }

  /// What a step of an unknown is, for differences and damping.
  [[nodiscard]] double unit_of(std::size_t node, std::size_t k) const {
    const std::size_t pair = std::min(node, n_ - 1);
    const double length = behind(states_, pair).s - states_[pair].s;
    return k == 0 ? length : k == 1 ? along_.tolerance : k == 2 ? along_.tolerance / length : 1.0;
  }

  bool lower_sum(double power) {
    double sum = sum_of(distances_, power);
    double damping = kDampingFirst;
    for (int step = 0; step < kSteps; ++step) {
      if (is_to_end(watch_)) return false;
      constexpr std::size_t kBand = 3 * kUnknowns - 1;
      const std::size_t size = kUnknowns * states_.size();
      BandedMatrix normal(size, kBand, kBand);
      std::vector<double> right(size, 0.0);
      add_equations(power, normal, right);
      bool better = false;
      while (!better && damping <= kDampingLast) {
        BandedMatrix damped = normal;
        for (std::size_t k = 0; k < size; ++k) {
          damped.at(k, k) += damping * damped.at(k, k) + kNotNothing;
        }
        if (damped.factor()) {
          const std::vector<double> move = damped.solve(right);
          std::vector<State> next = moved(move);
          if (!next.empty()) {
            auto there = all_distances(next);
            const double now = sum_of(there, power);
            if (now < sum) {
              better = true;
              const bool settled = now > (1.0 - kSettledSum) * sum;
              states_ = std::move(next);
              distances_ = std::move(there);
              sum = now;
              damping = std::max(kDampingLeast, 0.1 * damping);
              if (settled) return true;
              if (largest() <= along_.tolerance) return true;
            }
          }
        }
        if (!better) damping *= 10.0;
      }
      if (!better) return true;
    }
    return true;
  }

  /// Normal equations of the sum: of the power q its second derivative is q - 1 times as steep.
  void add_equations(double power, BandedMatrix& normal, std::vector<double>& right) const {
    constexpr double kDifference = 1e-4;  // of the unit of an unknown
    const double highest = largest();
    for (std::size_t i = 0; i < n_; ++i) {
      const std::size_t j = i + 1 < states_.size() ? i + 1 : 0;
      const State a = states_[i], b = behind(states_, i);
      std::array<Samples, 2 * kUnknowns - 1> rate{};
      std::array<std::size_t, 2 * kUnknowns - 1> column{};
      std::array<bool, 2 * kUnknowns - 1> free{};
      for (std::size_t u = 0; u < rate.size(); ++u) {
        const bool first = u < kUnknowns;
        const std::size_t node = first ? i : j, k = first ? u : u - kUnknowns;
        column[u] = kUnknowns * block(node) + k;
        free[u] = is_free(node, k);
        if (!free[u]) continue;
        const double unit = unit_of(node, k);
        State other = first ? a : b;
        // ends of the range are no places to go beyond
        const double by =
            unknown(other, k) + kDifference * unit > along_.to && k == 0 && !along_.closed
                ? -kDifference
                : kDifference;
        unknown(other, k) += by * unit;
        const Samples there = first ? distances(other, b) : distances(a, other);
        for (std::size_t m = 0; m < there.size(); ++m) {
          rate[u][m] = (there[m] - distances_[i][m]) / by;
        }
      }
      for (std::size_t m = 0; m <= kSamplesOfPair; ++m) {
        const double off = distances_[i][m];
        const double weight = std::pow(std::abs(off) / highest, power - 2.0);
        for (std::size_t u = 0; u < rate.size(); ++u) {
          if (!free[u]) continue;
          right[column[u]] -= weight * rate[u][m] * off / (power - 1.0);
          for (std::size_t v = 0; v < rate.size(); ++v) {
            if (free[v]) normal.at(column[u], column[v]) += weight * rate[u][m] * rate[v][m];
          }
        }
      }
    }
    for (std::size_t node = 0; node < states_.size(); ++node) {
      for (std::size_t k = 0; k < kUnknowns; ++k) {
        const std::size_t at = kUnknowns * block(node) + k;
        if (!is_free(node, k)) normal.at(at, at) = 1.0;
      }
    }
  }

  /// The states after a step, shortened where nodes would pass each other; nothing where they do.
  [[nodiscard]] std::vector<State> moved(const std::vector<double>& move) const {
    double share = 1.0;
    for (std::size_t node = 0; node < states_.size(); ++node) {
      const double along = std::abs(move[kUnknowns * block(node)]);
      if (along > kMostOfPair) share = std::min(share, kMostOfPair / along);
    }
    std::vector<State> out = states_;
    for (std::size_t node = 0; node < states_.size(); ++node) {
      for (std::size_t k = 0; k < kUnknowns; ++k) {
        if (!is_free(node, k)) continue;
        unknown(out[node], k) += share * move[kUnknowns * block(node) + k] * unit_of(node, k);
      }
      out[node].legs = std::clamp(out[node].legs, -std::log(kMostRatio), std::log(kMostRatio));
    }
    for (std::size_t i = 0; i < n_; ++i) {
      if (!(behind(out, i).s > out[i].s)) return {};
    }
    return out;
  }

  const PairsAlong& along_;
  std::size_t n_;
  Watch* watch_;
  std::vector<State> states_;
  std::vector<Samples> distances_;
};

}  // namespace

std::optional<std::vector<Node>> fitted_pairs(const PairsAlong& along, std::size_t pairs,
                                              Watch* watch) {
  return PairFit(along, pairs, watch).run();
}

double best_number_of_arcs(const PairsAlong& along) {
  constexpr int kPlaces = 400;
  double sum = 0.0;
  const double step = (along.to - along.from) / kPlaces;
  for (int k = 0; k < kPlaces; ++k) {
    const Jet jet = along.track.jet(along.from + (k + 0.5) * step, false);
    sum += step * std::cbrt(std::abs(curvature_rate(jet)) / (along.tolerance * kBestArc));
  }
  return sum;
}

}  // namespace obvid::arcs
