// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/forced_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "four_points.h"
#include "right_angles.h"

namespace obvid {
namespace {

using namespace series_detail;

constexpr std::array<std::size_t, 13> kStrides = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96};
constexpr std::size_t kCount = kStrides.size();
/// Only so many points ahead does a step lead.
constexpr std::size_t kRing = kStrides.back() + 1;
/// Neighbouring strides differ by at most this many places in the table.
constexpr std::size_t kStep = 2;
constexpr std::size_t kChoices = 2 * kStep + 1;
constexpr std::int32_t kNever = -1;
/// Points far denser than their reaches need longer strides: every so many-th point alone is tried
/// too, and of those again, while this many are left.
constexpr std::size_t kThinning = 8;
constexpr std::size_t kFewest = 64;
/// A closed series goes on over its seam until every point was the first of four neighbours.
constexpr std::size_t kOverSeam = 3;

std::size_t low(std::size_t i) { return i > kStep ? i - kStep : 0; }
std::size_t high(std::size_t i) { return std::min(kCount - 1, i + kStep); }

/// Most changes of sign so far, by the last sure sign: rising, falling; `none` when none was sure.
struct Best {
  std::int32_t rising = kNever, falling = kNever, none = kNever;

  void take(const Best& from, int sign) {
    none = std::max(none, from.none);
    rising = std::max(rising, from.rising);  // leaving a sign out is allowed
    falling = std::max(falling, from.falling);
    if (sign == 0) return;
    std::int32_t& now = sign > 0 ? rising : falling;
    const std::int32_t other = sign > 0 ? from.falling : from.rising;
    now = std::max(now, from.none);
    if (other != kNever) now = std::max(now, other + 1);
  }
  [[nodiscard]] std::int32_t most() const { return std::max({none, rising, falling}); }
};

double largest_distance(const Disc& a, const Disc& b) {
  return norm(b.centre - a.centre) + a.reach + b.reach;
}

/// Whether four neighbouring points are close to a curve that keeps within a right angle, or within
/// a half turn while it bends one way: the headings of their chords keep within 90 degrees, or
/// within two thirds of 180 (the ends of a curve go on for half a chord each) bending one way.
bool neighbours_compare(const Disc& a, const Disc& b, const Disc& c, const Disc& d) {
  constexpr double kCosineOfMost = -0.5;  // of 120 degrees
  const Vec2 u = b.centre - a.centre, v = c.centre - b.centre, w = d.centre - c.centre;
  if (dot(u, v) > 0.0 && dot(v, w) > 0.0 && dot(u, w) > 0.0) return true;
  const double lu = norm(u), lv = norm(v), lw = norm(w);
  const double by_b = cross(u, v) / (lu * lv), by_c = cross(v, w) / (lv * lw);
  const double moved =
      (a.reach + b.reach) / lu + (b.reach + c.reach) / lv + (c.reach + d.reach) / lw;
  return by_b * by_c > 0.0 && std::min(std::abs(by_b), std::abs(by_c)) > moved &&
         by_b * cross(u, w) > 0.0 && dot(u, w) > kCosineOfMost * lu * lw;
}

/// Changes of sign along the best subsequence whose steps are strides of the table, neighbouring
/// ones similar: dynamic programming over the last two steps.
class StrideSearch {
 public:
  /// `last[i]`: up to there points from i on may be compared.
  StrideSearch(const std::vector<Disc>& discs, const std::vector<std::size_t>& last, Watch& watch)
      : discs_(discs), last_(last), watch_(watch), best_(kRing * kCount * kCount) {}

  /// All points, not every so many-th alone.
  StrideSearch& with_neighbours() {
    neighbours_ = true;
    return *this;
  }

  int run() {
    std::int32_t most = 0;
    for (std::size_t c = 0; c < discs_.size() && !watch_.cancelled(); ++c) {
      look_behind(c);
      for (std::size_t i = 0; i < kCount; ++i) {
        for (std::size_t j = low(i); j <= high(i); ++j) {
          if (kStrides[i] + kStrides[j] > c) continue;
          Best& from = best_[state(c, i, j)];
          from.none = std::max(from.none, 0);  // a sequence may begin here
          most = std::max(most, from.most());
          follow(c, i, j, from);
          from = {};
        }
      }
    }
    return most;
  }

 private:
  static std::size_t state(std::size_t c, std::size_t i, std::size_t j) {
    return (c % kRing * kCount + i) * kCount + j;
  }

  /// The sides of all fourth points d of a, b, c, d.
  void look_behind(std::size_t c) {
    for (std::size_t j = 0; j < kCount; ++j) {
      if (kStrides[j] > c) break;
      for (std::size_t k = low(j); k <= high(j); ++k) {
        const std::size_t d = c + kStrides[k];
        if (d >= discs_.size()) break;
        behind_[j][k - low(j)] = Side::of(discs_[d], discs_[c], discs_[c - kStrides[j]]);
      }
    }
  }

  void follow(std::size_t c, std::size_t i, std::size_t j, const Best& from) {
    const std::size_t b = c - kStrides[j], a = b - kStrides[i];
    const Disc &first = discs_[a], &second = discs_[b], &third = discs_[c];
    const bool neighbours = neighbours_ && i == 0 && j == 0;
    const Side before = neighbours || c < last_[a] ? Side::of(first, second, third) : Side{};
    const double bc = largest_distance(second, third);
    for (std::size_t k = low(j); k <= high(j); ++k) {
      const std::size_t d = c + kStrides[k];
      if (d >= discs_.size()) return;
      int sign = 0;
      const Disc& fourth = discs_[d];
      if (d <= last_[a] ||
          (neighbours && k == 0 && neighbours_compare(first, second, third, fourth))) {
        sign = compare_circles(before, behind_[j][k - low(j)], second, third, bc,
                               largest_distance(first, fourth));
      }
      best_[state(d, j, k)].take(from, sign);
    }
  }

  const std::vector<Disc>& discs_;
  const std::vector<std::size_t>& last_;
  Watch& watch_;
  std::vector<Best> best_;
  std::array<std::array<Side, kChoices>, kCount> behind_{};
  bool neighbours_ = false;
};

/// Points and stretches of every `kThinning`-th point.
void thin_out(std::vector<Disc>& discs, std::vector<std::size_t>& last) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < discs.size(); i += kThinning, ++n) {
    discs[n] = discs[i];
    last[n] = last[i] / kThinning;
  }
  discs.resize(n);
  last.resize(n);
}

int within_reaches(std::vector<Disc> discs, Watch& watch) {
  std::vector<std::size_t> last = right_angle_stretches(discs);
  int most = StrideSearch(discs, last, watch).with_neighbours().run();
  while (discs.size() >= kThinning * kFewest) {
    thin_out(discs, last);
    most = std::max(most, StrideSearch(discs, last, watch).run());
  }
  return most;
}

/// Four neighbours at a time: more points never say less than fewer, when they are exact.
int of_neighbours(const std::vector<Disc>& discs) {
  int changes = 0, before = 0;
  for (std::size_t i = 0; i + 3 < discs.size(); ++i) {
    const Disc &a = discs[i], &b = discs[i + 1], &c = discs[i + 2], &d = discs[i + 3];
    if (!neighbours_compare(a, b, c, d)) continue;
    const int sign = compare_circles(Side::of(a, b, c), Side::of(d, c, b), b, c,
                                     largest_distance(b, c), largest_distance(a, d));
    if (sign == 0) continue;
    if (before != 0 && sign != before) ++changes;
    before = sign;
  }
  return changes;
}

}  // namespace

int forced_vertices(const std::vector<Vec2>& points, const std::vector<double>& reach,
                    bool closed) {
  Watch nobody;
  return forced_vertices(points, reach, closed, nobody);
}

int forced_vertices(const std::vector<Vec2>& points, const std::vector<double>& reach, bool closed,
                    Watch& watch) {
  const std::size_t n = points.size();
  std::vector<Disc> discs;
  discs.reserve(n + kOverSeam);
  bool exact = true;
  for (std::size_t i = 0; i < n + (closed ? kOverSeam : 0); ++i) {
    const Vec2 p = points[i % n];
    const double own = reach.empty() ? 0.0 : reach[i % n];
    const double rounding = 0x1p-53 * (std::abs(p.x) + std::abs(p.y));  // half an ulp in each
    discs.push_back({p, own + rounding});
    exact = exact && own == 0.0;
  }
  const int forced = exact ? of_neighbours(discs) : within_reaches(std::move(discs), watch);
  return closed ? forced + forced % 2 : forced;  // around a loop curvature returns to its value
}

}  // namespace obvid
