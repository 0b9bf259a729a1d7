// SPDX-License-Identifier: Apache-2.0
#include "forced_vertices.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace obvid::fairing_detail {
namespace {

constexpr std::array<std::size_t, 13> kStrides = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96};
constexpr std::size_t kCount = kStrides.size();
/// Only so many points ahead does a step lead.
constexpr std::size_t kRing = kStrides.back() + 1;
/// Neighbouring strides differ by at most this many places in the table.
constexpr std::size_t kStep = 2;
/// Reaches larger than this part of a chord are beyond the first-order bound.
constexpr double kLargestReach = 0.1;
constexpr double kSecondOrder = 8.0;  ///< allowance for the second order, in reaches over chords
/// Cosine of the largest turning between neighbouring chords for which the bound is trusted.
constexpr double kCosLargestTurn = 0.0;
constexpr std::int32_t kNever = -1;
/// Points far denser than their reaches need longer strides: every so many-th point alone is tried
/// too, and of those again, while this many are left.
constexpr std::size_t kThinning = 8;
constexpr std::size_t kFewest = 64;

/// Most changes of sign so far, by the last sure sign: rising, falling; `none` when none was sure.
struct Best {
  std::int32_t rising = kNever, falling = kNever, none = kNever;
};

class Counter {
 public:
  Counter(const std::vector<Vec2>& points, const std::vector<double>& reach)
      : points_(points), reach_(reach), best_(kRing * kCount * kCount) {}

  int run() {
    const std::size_t n = points_.size();
    std::int32_t most = 0;
    for (std::size_t c = 0; c < n; ++c) {
      for (std::size_t i = 0; i < kCount; ++i) {
        for (std::size_t j = low(i); j <= high(i); ++j) {
          if (kStrides[i] + kStrides[j] > c) continue;
          Best& from = best_[state(c, i, j)];
          from.none = std::max(from.none, 0);  // a sequence may begin here
          most = std::max({most, from.none, from.rising, from.falling});
          for (std::size_t k = low(j); k <= high(j); ++k) follow(c, i, j, k, from);
          from = {};
        }
      }
    }
    return most;
  }

 private:
  struct Window {
    std::size_t a, b, c, d;
  };

  [[nodiscard]] bool turns_far(const Window& at) const {
    const Vec2 u = points_[at.b] - points_[at.a], v = points_[at.c] - points_[at.b];
    const Vec2 w = points_[at.d] - points_[at.c];
    return dot(u, v) <= kCosLargestTurn * norm(u) * norm(v) ||
           dot(v, w) <= kCosLargestTurn * norm(v) * norm(w);
  }

  static std::size_t low(std::size_t i) { return i > kStep ? i - kStep : 0; }
  static std::size_t high(std::size_t i) { return std::min(kCount - 1, i + kStep); }
  static std::size_t state(std::size_t c, std::size_t i, std::size_t j) {
    return (c % kRing * kCount + i) * kCount + j;
  }

  void follow(std::size_t c, std::size_t i, std::size_t j, std::size_t k, const Best& from) {
    const std::size_t d = c + kStrides[k];
    if (d >= points_.size()) return;
    Best& to = best_[state(d, j, k)];
    const Window window{c - kStrides[j] - kStrides[i], c - kStrides[j], c, d};
    if (turns_far(window)) {  // the count goes on, what the last sign was is forgotten
      to.none = std::max({to.none, from.none, from.rising, from.falling});
      return;
    }
    const int sign = sure_sign(window);
    to.none = std::max(to.none, from.none);
    if (sign == 0) {
      to.rising = std::max(to.rising, from.rising);
      to.falling = std::max(to.falling, from.falling);
      return;
    }
    const std::int32_t same = sign > 0 ? from.rising : from.falling;
    const std::int32_t other = sign > 0 ? from.falling : from.rising;
    std::int32_t& now = sign > 0 ? to.rising : to.falling;
    now = std::max({now, same, from.none});
    if (other != kNever) now = std::max(now, other + 1);
    if (sign > 0) {
      to.falling = std::max(to.falling, from.falling);  // leaving a sign out is allowed
    } else {
      to.rising = std::max(to.rising, from.rising);
    }
  }

  /// Sign of curvature(b, c, d) - curvature(a, b, c) when no move within the reaches changes it.
  [[nodiscard]] int sure_sign(const Window& at) const {
    const auto [a, b, c, d] = at;
    const Vec2 u = points_[b] - points_[a], v = points_[c] - points_[b],
               w = points_[d] - points_[c];
    const double ab = norm(u), bc = norm(v), cd = norm(w), ac = norm(u + v), bd = norm(v + w);
    const double change = 2.0 * (cross(v, w) / (bc * cd * bd) - cross(u, v) / (ab * bc * ac));
    const double ra = reach_[a], rb = reach_[b], rc = reach_[c], rd = reach_[d];
    const double part = std::max({ra, rb, rc, rd}) / std::min({ab, bc, cd});
    if (part > kLargestReach) return 0;
    // a circle's curvature changes by 2 / (p q) per move of a point at distances p, q from the
    // others
    const double bound = 2.0 * (ra / (ab * ac) + rb / bc * (1.0 / bd + 1.0 / ab) +
                                rc / bc * (1.0 / cd + 1.0 / ac) + rd / (bd * cd));
    if (std::abs(change) <= bound * (1.0 + kSecondOrder * part)) return 0;
    return change > 0.0 ? 1 : -1;
  }

  const std::vector<Vec2>& points_;
  const std::vector<double>& reach_;
  std::vector<Best> best_;
};

}  // namespace

int forced_vertices(const std::vector<Vec2>& points, const std::vector<double>& reach) {
  int most = Counter(points, reach).run();
  std::vector<Vec2> some = points;
  std::vector<double> of_some = reach;
  while (some.size() >= kThinning * kFewest) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < some.size(); i += kThinning, ++n) {
      some[n] = some[i];
      of_some[n] = of_some[i];
    }
    some.resize(n);
    of_some.resize(n);
    most = std::max(most, Counter(some, of_some).run());
  }
  return most;
}

}  // namespace obvid::fairing_detail
