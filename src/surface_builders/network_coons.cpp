// SPDX-License-Identifier: Apache-2.0
// Four curves put in order around a patch.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "network_curves.h"
#include "obvid/surface_builders/internal/network.h"

namespace obvid {
namespace {

/// Curves around the patch, one after the other, each from the end of the one before.
struct Loop {
  std::array<std::size_t, 4> number{0, 1, 2, 3};
  std::array<bool, 4> turned{};
};

Vec3 start_of(const SpaceCurve& c, bool turned) { return turned ? c.points.back() : c.points[0]; }

class Loops {
 public:
  explicit Loops(const std::vector<SpaceCurve>& curves) : curves_(curves) {
    Loop loop;
    do {
      for (unsigned turns = 0; turns < 8; ++turns) {
        for (unsigned k = 1; k < 4; ++k) loop.turned[k] = (turns >> (k - 1) & 1U) != 0;
        all_.push_back(loop);
      }
    } while (std::next_permutation(loop.number.begin() + 1, loop.number.end()));
  }

  [[nodiscard]] const std::vector<Loop>& all() const { return all_; }

  /// Distance from the end of curve k of the loop to the beginning of the next.
  [[nodiscard]] double gap(const Loop& loop, std::size_t k) const {
    const std::size_t next = (k + 1) % 4;
    return norm(start_of(curves_[loop.number[k]], !loop.turned[k]) -
                start_of(curves_[loop.number[next]], loop.turned[next]));
  }
  [[nodiscard]] std::size_t widest(const Loop& loop) const {
    std::size_t worst = 0;
    for (std::size_t k = 1; k < 4; ++k) {
      if (gap(loop, k) > gap(loop, worst)) worst = k;
    }
    return worst;
  }

  [[nodiscard]] SpaceCurve curve(const Loop& loop, std::size_t k, bool backwards) const {
    const SpaceCurve& c = curves_[loop.number[k]];
    return loop.turned[k] != backwards ? reversed(c) : c;
  }

  /// How far opposite curves are apart in the mean: crossed over, they are further.
  [[nodiscard]] double twist(const Loop& loop) const {
    double sum = 0.0;
    for (const std::size_t k : {0u, 1u}) {
      const SpaceCurve there = curve(loop, k, false), back = curve(loop, k + 2, true);
      for (const double part : {0.25, 0.5, 0.75}) {
        sum += norm(evaluate(there, domain(there).at(part)).point -
                    evaluate(back, domain(back).at(part)).point);
      }
    }
    return sum;
  }

  /// Neighbours that run along each other enclose nothing.
  [[nodiscard]] bool encloses(const Loop& loop, double tolerance) const {
    for (std::size_t k = 0; k < 4; ++k) {
      const SpaceCurve a = curve(loop, k, false), b = curve(loop, (k + 1) % 4, true);
      if (is_point(a, tolerance) || is_point(b, tolerance)) continue;
      bool same = true;
      for (int i = 0; i <= kSamples && same; ++i) {
        const double part = static_cast<double>(i) / kSamples;
        same = norm(evaluate(a, domain(a).at(part)).point -
                    evaluate(b, domain(b).at(part)).point) <= tolerance;
      }
      if (same) return false;
    }
    return true;
  }

 private:
  static constexpr int kSamples = 8;
  const std::vector<SpaceCurve>& curves_;
  std::vector<Loop> all_;
};

Error apart(const Loops& loops, const Loop& loop, double tolerance) {
  const std::size_t k = loops.widest(loop), next = (k + 1) % 4;
  const double gap = loops.gap(loop, k);
  return error(ErrorCode::kBadOption,
               fmt::format("an end of curve {} and the next one of curve {} are {:g} apart, the "
                           "tolerance is {:g}",
                           loop.number[k] + 1, loop.number[next] + 1, gap, tolerance))
      .hint("the four curves have to meet at their ends")
      .point(loop.number[k])
      .value(gap);
}

/// The end of one curve and the beginning of another become the same point.
void join(Vec3& a, Vec3& b) {
  if (a == b) return;
  a = 0.5 * (a + b);
  b = a;
}

}  // namespace

Result<CoonsPatch> coons_from(const std::vector<SpaceCurve>& curves, double tolerance) {
  OBVID_TRY(check_tolerance(tolerance));
  if (curves.size() != 4) {
    return error(ErrorCode::kTooFewCurves,
                 fmt::format("a Coons patch has four curves, not {}", curves.size()))
        .hint("a triangle has a fourth curve of length 0 in one corner")
        .value(static_cast<double>(curves.size()));
  }
  OBVID_TRY(check_curves(curves, ""));
  const Loops loops(curves);
  const Loop *nearest = nullptr, *best = nullptr;
  double least_gap = std::numeric_limits<double>::infinity(), least_twist = least_gap;
  bool flat = false;
  for (const Loop& loop : loops.all()) {
    const double gap = loops.gap(loop, loops.widest(loop));
    if (nearest == nullptr || gap < least_gap) {
      nearest = &loop;
      least_gap = gap;
    }
    if (!(gap <= tolerance)) continue;
    if (!loops.encloses(loop, tolerance)) {
      flat = true;
    } else if (const double twist = loops.twist(loop); best == nullptr || twist < least_twist) {
      best = &loop;
      least_twist = twist;
    }
  }
  if (best == nullptr && !flat) return fail(apart(loops, *nearest, tolerance));
  if (best == nullptr) {
    return error(ErrorCode::kBadOption, "curves side by side are the same curve")
        .hint("give each border of the patch once");
  }
  CoonsPatch patch{loops.curve(*best, 0, false), loops.curve(*best, 2, true),
                   loops.curve(*best, 3, true), loops.curve(*best, 1, false)};
  join(patch.u_at_v0.points.front(), patch.v_at_u0.points.front());
  join(patch.u_at_v0.points.back(), patch.v_at_u1.points.front());
  join(patch.u_at_v1.points.front(), patch.v_at_u0.points.back());
  join(patch.u_at_v1.points.back(), patch.v_at_u1.points.back());
  return patch;
}

}  // namespace obvid
