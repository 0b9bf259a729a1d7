// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "triangle.h"

namespace obvid::conics {

/// A segment with its place in the weight chain.
struct Link {
  Triangle triangle;
  double from_first = 0.0;  ///< logarithm of its weight over the first one
};

/// Triangles and weight chain of a convex series: equal curvature at the joints.
/// Errors: E304 fewer than two elements; E401 a segment without triangle, or turning the other way.
[[nodiscard]] Result<std::vector<Link>> links_over(const std::vector<Element>& elements);

/// Logarithms of the weights with which one segment is a monotone ellipse arc; empty when low >=
/// high.
struct LogWeights {
  double low = 0.0;
  double high = 0.0;
};

[[nodiscard]] LogWeights monotone_range(const Triangle& t);

}  // namespace obvid::conics
