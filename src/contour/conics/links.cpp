// SPDX-License-Identifier: Apache-2.0
#include "links.h"

#include <algorithm>
#include <string>

namespace obvid::conics {

Result<std::vector<Link>> links_over(const std::vector<Element>& elements) {
  if (elements.size() < 2) {
    return error(ErrorCode::kTooFewPoints, "a chain of conics needs at least two points")
        .hint("add points")
        .value(static_cast<double>(elements.size()));
  }
  std::vector<Link> links;
  for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
    const auto t = triangle_over(elements[i], elements[i + 1]);
    if (!t || (i > 0 && t->turning != links.front().triangle.turning)) {
      return error(ErrorCode::kNoSpiral, "chord and tangents make no triangle for a convex conic")
          .where("points " + std::to_string(i + 1) + " and " + std::to_string(i + 2))
          .hint(
              "conics carry no inflection and less than half a turn per segment: split the "
              "series there or use another carrier")
          .point(i);
    }
    double from_first = 0.0;
    if (i > 0) {  // S_1/(w_1^2 b_1^3) = S_2/(w_2^2 a_2^3)
      from_first = links.back().from_first +
                   0.5 * (log_start_curvature(*t) - log_end_curvature(links.back().triangle));
    }
    links.push_back({*t, from_first});
  }
  return links;
}

LogWeights monotone_range(const Triangle& t) {
  const auto squares = monotone_squares(t.phi, t.psi);
  const bool falls = t.log_b > t.log_a;
  const double low = falls ? squares.at_end : squares.at_start;
  const double high = falls ? squares.at_start : squares.at_end;
  return {0.5 * low, 0.5 * std::min(0.0, high)};
}

}  // namespace obvid::conics
