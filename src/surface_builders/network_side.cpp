// SPDX-License-Identifier: Apache-2.0
#include "network_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace obvid {
namespace {

/// Crossings that are nearer than this part of a curve are one place.
constexpr double kSamePlace = 1e-7;

template <class T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t k : order) sorted.push_back(values[k]);
  return sorted;
}

void permute_curves(NetSide& side, const std::vector<std::size_t>& order) {
  side.curves = in_order(side.curves, order);
  side.number = in_order(side.number, order);
  side.is_pole = in_order(side.is_pole, order);
  side.at = in_order(side.at, order);
}

void permute_crossings(NetSide& side, const std::vector<std::size_t>& order) {
  for (std::vector<double>& row : side.at) row = in_order(row, order);
}

void turn(NetSide& side, std::size_t i) {
  side.curves[i] = reversed(side.curves[i]);
  for (double& t : side.at[i]) t = 1.0 - t;
}

/// The curve that keeps its direction: the first one given that is no pole. The number of curves
/// when all are poles.
std::size_t guide_of(const NetSide& side) {
  std::size_t guide = side.curves.size();
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    if (side.is_pole[i]) continue;
    if (guide == side.curves.size() || side.number[i] < side.number[guide]) guide = i;
  }
  return guide;
}

bool is_closed(const SpaceCurve& curve, double tolerance) {
  return norm(curve.points.front() - curve.points.back()) <= tolerance;
}

bool all_closed(const NetSide& side, double tolerance) {
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    if (!side.is_pole[i] && !is_closed(side.curves[i], tolerance)) return false;
  }
  return guide_of(side) < side.curves.size();
}

bool at_seam(const NetSide& side, std::size_t j, double tolerance) {
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    if (side.is_pole[i]) continue;
    const SpaceCurve& c = side.curves[i];
    if (norm(evaluate(c, side.at[i][j]).point - c.points.front()) > 2.0 * tolerance) return false;
  }
  return true;
}

/// Closed curves have no ends that tell their direction: two crossings besides the seam tell it, or
/// the tangents there.
void turn_alike(NetSide& side, const std::vector<std::size_t>& seams) {
  const std::size_t guide = guide_of(side);
  std::vector<std::size_t> inner;
  for (std::size_t j = 0; j < side.at[guide].size(); ++j) {
    if (std::find(seams.begin(), seams.end(), j) == seams.end()) inner.push_back(j);
  }
  std::sort(inner.begin(), inner.end(),
            [&](std::size_t a, std::size_t b) { return side.at[guide][a] < side.at[guide][b]; });
  const Vec3 ahead = evaluate(side.curves[guide], 0.0).d1;
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    if (i == guide || side.is_pole[i]) continue;
    const bool turned = inner.size() > 1 ? side.at[i][inner.front()] > side.at[i][inner.back()]
                                         : dot(ahead, evaluate(side.curves[i], 0.0).d1) < 0.0;
    if (turned) turn(side, i);
  }
}

Error unordered(const NetSide& side, const NetSide& other, std::size_t i, std::size_t j) {
  return error(ErrorCode::kBadOption,
               fmt::format("{} meets {} and {} in another order than {} does", side.name(i),
                           other.name(j - 1), other.name(j), side.name(guide_of(side))))
      .hint("curves of one kind must not cross each other between those of the other")
      .point(side.number[i])
      .value(side.at[i][j]);
}

Error same_place(const NetSide& side, const NetSide& other, std::size_t i, std::size_t j) {
  return error(ErrorCode::kBadOption, fmt::format("{} and {} cross {} at the same place",
                                                  other.name(j - 1), other.name(j), side.name(i)))
      .hint("leave out curves that are given twice")
      .point(other.number[j])
      .value(side.at[i][j] - side.at[i][j - 1]);
}

}  // namespace

std::string NetSide::name(std::size_t i) const {
  return fmt::format("curve {} {}", number[i] + 1, kind);
}

Result<void> open_at_seam(NetSide& side, NetSide& other, double tolerance) {
  if (!all_closed(side, tolerance)) return {};
  std::vector<std::size_t> seams;
  for (std::size_t j = 0; j < other.curves.size(); ++j) {
    if (at_seam(side, j, tolerance)) seams.push_back(j);
  }
  if (seams.empty() || seams.size() > 2) {
    return error(ErrorCode::kBadOption,
                 fmt::format("{} curves {} pass through the ends of the closed curves {}",
                             seams.size(), other.kind, side.kind))
        .hint("let the closed curves begin on one and the same curve of the other kind")
        .value(static_cast<double>(seams.size()));
  }
  if (seams.size() == 1) {  // the curve stands once more, at the other end
    const std::size_t j = seams[0];
    other.curves.push_back(SpaceCurve(other.curves[j]));
    other.number.push_back(std::size_t{other.number[j]});
    other.is_pole.push_back(char{other.is_pole[j]});
    other.at.push_back(std::vector<double>(other.at[j]));
    for (std::vector<double>& row : side.at) row.push_back(1.0);
    seams.push_back(other.curves.size() - 1);
  }
  turn_alike(side, seams);
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    side.at[i][seams[0]] = 0.0;
    side.at[i][seams[1]] = 1.0;
  }
  return {};
}

Result<void> put_in_order(NetSide& side, NetSide& other) {
  const std::size_t guide = guide_of(side);
  if (guide == side.curves.size()) {
    return error(ErrorCode::kBadOption, fmt::format("all curves {} are points", side.kind));
  }
  std::vector<std::size_t> order(other.curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return side.at[guide][a] < side.at[guide][b];
  });
  permute_crossings(side, order);
  permute_curves(other, order);
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    if (side.is_pole[i]) continue;
    const std::vector<double>& at = side.at[i];
    if (at.front() > at.back()) turn(side, i);
    for (std::size_t j = 1; j < at.size(); ++j) {
      if (std::abs(at[j] - at[j - 1]) <= kSamePlace) return fail(same_place(side, other, i, j));
      if (at[j] < at[j - 1]) return fail(unordered(side, other, i, j));
    }
  }
  return {};
}

void trim(NetSide& side, double tolerance) {
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    if (side.is_pole[i]) continue;
    SpaceCurve& curve = side.curves[i];
    std::vector<double>& at = side.at[i];
    const auto at_end = [&](double t, Vec3 end) {
      return norm(evaluate(curve, t).point - end) <= tolerance;
    };
    if (at_end(at.front(), curve.points.front())) at.front() = 0.0;
    if (at_end(at.back(), curve.points.back())) at.back() = 1.0;
    const Range kept{at.front(), at.back()};
    if (kept.to < 1.0) curve = split(curve, kept.to)[0];
    if (kept.from > 0.0) curve = split(curve, kept.from)[1];
    curve = with_domain(curve, {0.0, 1.0});
    for (double& t : at) t = (t - kept.from) / kept.length();
    at.back() = 1.0;
  }
}

std::vector<double> mean_parameters(NetSide& side) {
  std::vector<double> mean(side.at[0].size(), 0.0);
  double counted = 0.0;
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    if (side.is_pole[i]) continue;
    counted += 1.0;
    // a running mean: of equal numbers it is that number to the last digit
    for (std::size_t j = 0; j < mean.size(); ++j) mean[j] += (side.at[i][j] - mean[j]) / counted;
  }
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    if (side.is_pole[i]) side.at[i] = mean;
  }
  return mean;
}

}  // namespace obvid
