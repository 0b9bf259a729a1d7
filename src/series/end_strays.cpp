// SPDX-License-Identifier: Apache-2.0
// Strays at the ends of an open row: docs/methods/series.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "obvid/geom/vec2.h"
#include "obvid/numeric/internal/median.h"
#include "obvid/series/internal/strays.h"
#include "outlier_rules.h"

namespace obvid {
namespace {

constexpr std::size_t kBehind = 6;  // points that say where the curve comes from
/// What an end may be off where its row goes on as it does elsewhere: so many times the farthest
/// that any other point is off the same curve of the points on one side of it, and of a step.
constexpr double kOfFarthest = 4.0, kOfStep = 0.25;
constexpr double kOpen = 3.0;  // middle steps between the ends, at least

/// Distance of a point from the parabola through the points behind it (least squares over their
/// chords), gone on to it.
double off_parabola(Vec2 point, const std::array<Vec2, kBehind>& behind) {
  std::array<double, kBehind> t{};
  for (std::size_t k = 1; k < kBehind; ++k) t[k] = t[k - 1] - norm(behind[k] - behind[k - 1]);
  const double unit = -t.back() / static_cast<double>(kBehind - 1);
  if (!(unit > 0.0)) return 0.0;
  std::array<double, 5> sum{};  // of powers of t
  std::array<Vec2, 3> right{};
  for (std::size_t k = 0; k < kBehind; ++k) {
    const double u = t[k] / unit;
    double power = 1.0;
    for (std::size_t j = 0; j < sum.size(); ++j, power *= u) {
      sum[j] += power;
      if (j < right.size()) right[j] = right[j] + power * (behind[k] - behind.front());
    }
  }
  // Cramer's rule for the symmetric system of three
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    return sum[i] * sum[j] - sum[k] * sum[l];
  };
  const double c00 = minor(2, 4, 3, 3), c01 = minor(2, 3, 1, 4), c02 = minor(1, 3, 2, 2);
  const double c11 = minor(0, 4, 2, 2), c12 = minor(1, 2, 0, 3), c22 = minor(0, 2, 1, 1);
  const double det = sum[0] * c00 + sum[1] * c01 + sum[2] * c02;
  if (!(std::abs(det) > 0.0)) return 0.0;
  const Vec2 a = (c00 * right[0] + c01 * right[1] + c02 * right[2]) / det;
  const Vec2 b = (c01 * right[0] + c11 * right[1] + c12 * right[2]) / det;
  const Vec2 c = (c02 * right[0] + c12 * right[1] + c22 * right[2]) / det;
  const Vec2 q = point - behind.front();
  double u = norm(q) / unit;
  constexpr int kNewton = 20;
  for (int k = 0; k < kNewton; ++k) {
    const Vec2 away = a + u * b + (u * u) * c - q, slope = b + (2.0 * u) * c;
    const double rate = dot(slope, slope);
    if (!(rate > 0.0)) break;
    u = std::max(0.0, u - dot(away, slope) / rate);
  }
  return norm(a + u * b + (u * u) * c - q);
}

/// The point at a place of a row and those that lie behind it, as seen from an end.
template <class At>
double off_at(const At& at, std::size_t place, std::size_t first) {
  std::array<Vec2, kBehind> behind{};
  for (std::size_t k = 0; k < kBehind; ++k) behind[k] = at(first + k);
  return off_parabola(at(place), behind);
}

/// Points at the start of a row that stray, up to three, and how far they are off.
template <class At>
std::vector<std::pair<std::size_t, double>> strays_of_end(const At& at, double least) {
  for (std::size_t count = kMostInARow; count > 0; --count) {
    std::vector<std::pair<std::size_t, double>> out;
    for (std::size_t k = 0; k < count; ++k) {
      const double off = off_at(at, k, count);
      // without the first point behind it too, which may be the wrong one
      if (off > least && off_at(at, k, count + 1) > least) out.emplace_back(k, off);
    }
    // each of them is off what lies behind them, which goes on without them
    const bool goes_on = !(off_at(at, count, count + 1) > least);
    if (out.size() == count && goes_on) return out;
  }
  return {};
}

}  // namespace

std::optional<OrderBesideStrays> without_end_strays(const std::vector<Vec2>& points,
                                                    const CurveOrder& order) {
  const std::size_t n = order.order.size();
  if (n < kLeastCompared + 2 * (kMostInARow + kBehind) || order.is_outline) return std::nullopt;
  const auto forward = [&](std::size_t k) { return points[order.order[k]]; };
  const auto backward = [&](std::size_t k) { return points[order.order[n - 1 - k]]; };
  std::vector<double> steps;
  for (std::size_t k = 1; k < n; ++k) steps.push_back(norm(forward(k) - forward(k - 1)));
  const double step = median_of(steps);
  if (!(order.gap > kOpen * step)) return std::nullopt;
  std::vector<double> offs;
  for (std::size_t k = kMostInARow; k + kMostInARow + kBehind < n; ++k) {
    offs.push_back(off_at(forward, k, k + 1));
    offs.push_back(off_at(backward, k, k + 1));
  }
  const double farthest = *std::max_element(offs.begin(), offs.end());
  const double deviation = median_of(offs);
  const double least = std::max(kOfFarthest * farthest, kOfStep * step);
  const auto before = strays_of_end(forward, least), behind = strays_of_end(backward, least);
  if (before.empty() && behind.empty()) return std::nullopt;
  OrderBesideStrays out;
  out.strays.deviation = deviation;
  out.strays.limit = deviation > 0.0 ? least / deviation : 0.0;
  for (const auto& [k, off] : before) out.strays.points.push_back({order.order[k], off});
  for (const auto& [k, off] : behind) out.strays.points.push_back({order.order[n - 1 - k], off});
  out.order.order.assign(order.order.begin() + static_cast<std::ptrdiff_t>(before.size()),
                         order.order.end() - static_cast<std::ptrdiff_t>(behind.size()));
  const std::vector<std::size_t>& left = out.order.order;
  for (std::size_t k = 1; k < left.size(); ++k) {
    out.order.largest_step =
        std::max(out.order.largest_step, norm(points[left[k]] - points[left[k - 1]]));
  }
  out.order.gap = norm(points[left.back()] - points[left.front()]);
  return out;
}

}  // namespace obvid
