// SPDX-License-Identifier: Apache-2.0
#include "climb.h"

#include <numbers>

namespace obvid {
namespace {

/// A number of cells is not rounded up for the rounding of a quotient.
constexpr double kCellRounding = 1e-9;

}  // namespace

std::vector<Node> nodes_of(const std::vector<double>& knots, const Range& domain, std::size_t n) {
  constexpr double kBefore = 1e-9;  // part of the span: behind the knot curvature may be another
  const double apart = 0.5 / std::numbers::sqrt3;  // of a cell, from its middle
  std::vector<Node> nodes;
  double from = domain.from;
  for (const double knot : knots) {
    const Range span{from, std::min(knot, domain.to)};
    if (!(span.length() > 0.0)) continue;
    const double share = span.length() / domain.length() * (1.0 - kCellRounding);
    const double cells = std::ceil(0.5 * static_cast<double>(n) * share);
    const double cell = span.length() / cells;
    const double end = span.to < domain.to ? span.at(1.0 - kBefore) : span.to;
    for (double k = 0.0; k < cells; k += 1.0) {
      for (const double side : {-apart, apart}) {
        const double at = span.at((k + 0.5 + side) / cells);
        nodes.push_back(
            {at, 0.5 * cell, {std::max(span.from, at - cell), std::min(end, at + cell)}});
      }
    }
    from = span.to;
  }
  return nodes;
}

}  // namespace obvid
