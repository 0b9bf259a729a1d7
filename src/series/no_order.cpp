// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <utility>

#include "obvid/numeric/internal/median.h"
#include "obvid/series/internal/order.h"

namespace obvid {

std::optional<std::string> no_order_hint(const std::vector<Vec2>& points) {
  constexpr std::size_t kFewestToTell = 12, kMostLooked = 200;  // points
  constexpr double kBeyondNearest =
      4.0;  // of the distance of the nearest: rows have 1, combs some 2
  const std::size_t n = points.size();
  if (n < kFewestToTell) return std::nullopt;
  std::vector<double> beyond;
  const std::size_t every = std::max<std::size_t>(1, n / kMostLooked);
  for (std::size_t i = 0; i + 1 < n; i += every) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < n; ++k) {
      if (k != i) nearest = std::min(nearest, norm(points[k] - points[i]));
    }
    if (nearest > 0.0) beyond.push_back(norm(points[i + 1] - points[i]) / nearest);
  }
  if (beyond.empty() || median_of(std::move(beyond)) <= kBeyondNearest) return std::nullopt;
  return "the points follow each other in no order, as it seems: neighbours in the list are far "
         "beyond the nearest points; --unordered puts them in that of their curve";
}

}  // namespace obvid
