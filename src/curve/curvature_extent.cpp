// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/curvature_extent.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "obvid/numeric/internal/golden.h"

namespace obvid {
namespace {

constexpr double kExtremeFoundTo = 1e-7;  ///< of the distance of two parameters
constexpr double kNearlyStops = 0.25;     ///< of the largest speed

/// Walks to the place between the neighbours of a parameter where `value` is largest.
template <class Value>
double highest_beside(const std::vector<double>& at, std::size_t k, const Value& value) {
  const double low = at[k > 0 ? k - 1 : k], high = at[std::min(k + 1, at.size() - 1)];
  return highest_place(low, high, value, kExtremeFoundTo * (high - low));
}

}  // namespace

CurvatureExtent curvature_extent(const Piece& piece, const std::vector<double>& places,
                                 double known) {
  std::vector<double> at, kappa, speed;
  for (const double t : places) {
    const Jet jet = evaluate(piece, t);
    const double k = curvature(jet);
    if (!std::isfinite(k)) continue;
    at.push_back(t);
    kappa.push_back(k);
    speed.push_back(norm(jet.d1));
  }
  if (at.empty()) return {};
  const auto [least, largest] = std::minmax_element(kappa.begin(), kappa.end());
  CurvatureExtent range{*least, *largest};
  const auto widen = [&](double t) {
    const double k = curvature(evaluate(piece, t));
    if (!std::isfinite(k)) return;
    range.least = std::min(range.least, k);
    range.largest = std::max(range.largest, k);
  };
  // below a neighbour by half a step of the largest it may still be the largest in between
  const double worth = 0.5 * std::max({known, std::abs(range.least), std::abs(range.largest)});
  const auto signed_kappa = [&](double t) { return curvature(evaluate(piece, t)); };
  const auto low = static_cast<std::size_t>(least - kappa.begin());
  const auto high = static_cast<std::size_t>(largest - kappa.begin());
  if (std::abs(kappa[high]) >= worth) widen(highest_beside(at, high, signed_kappa));
  if (std::abs(kappa[low]) >= worth) {
    widen(highest_beside(at, low, [&](double t) { return -signed_kappa(t); }));
  }
  const auto [slow, fast] = std::minmax_element(speed.begin(), speed.end());
  if (*slow < kNearlyStops * *fast) {
    widen(highest_beside(at, static_cast<std::size_t>(slow - speed.begin()),
                         [&](double t) { return -norm(evaluate(piece, t).d1); }));
  }
  return range;
}

}  // namespace obvid
