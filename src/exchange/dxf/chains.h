// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid::dxf {

/// A curve that may be a part of a longer one.
struct Link {
  std::vector<Piece> pieces;  ///< at least one
  bool closed = false;
  std::size_t layer = 0;      ///< only links of one layer are joined
  std::size_t arcs_more = 0;  ///< pieces beyond the arcs that are drawn
};

/// Links that belong together, in order.
struct Chain {
  struct Member {
    std::size_t link = 0;
    bool reversed = false;
  };
  std::vector<Member> members;
  bool closed = false;
};

struct Chains {
  std::vector<Chain> chains;   ///< in the order of their first links
  std::size_t duplicates = 0;  ///< links that lie on others, left out
  double tolerance = 0.0;      ///< ends that are no farther apart meet, units
};

/// Joins links where exactly two ends of one layer meet: first but for rounding, then, of what is
/// left, within a part of the size of the drawing. Where three meet nobody can say which belong
/// together. Every chain runs as its first link does.
/// Time O(n log n), whatever the links are.
[[nodiscard]] Chains join(const std::vector<Link>& links);

}  // namespace obvid::dxf
