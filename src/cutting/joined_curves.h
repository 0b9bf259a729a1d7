// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "offset_path.h"

namespace obvid::cutting {

struct ClosedGap {
  double width = 0.0;
  double moved = 0.0;  ///< how far its ends were moved; 0: a line leads over it
};

/// Open curves that were put together where exactly two ends meet.
struct JoinedCurves {
  struct Chain {
    std::vector<std::size_t> members;  ///< curves in their order along it, the first one as it runs
    ArcPath path;                      ///< whose gaps are closed
    double largest_gap = 0.0;          ///< that was closed
    double moved = 0.0;                ///< how far an end was moved for that, at most
  };
  std::vector<Chain> chains;  ///< of every curve one, by their first members
  /// A chain with which others close around something, where three and more ends meet.
  std::optional<std::size_t> enclosing;
  /// Ends that did not meet, nearer than a hundredth of a chain: they look as if they were meant
  /// to.
  struct Gap {
    std::size_t one, other;  ///< chains; the same: its own ends
    double distance;
  };
  std::vector<Gap> gaps;
};

/// Ends as near as `within` meet.
[[nodiscard]] JoinedCurves joined_curves(const std::vector<ArcPath>& open, double within);

/// Lets the last piece end where the first one starts: half way, pieces similar to what they were;
/// by a line where one of them is not ten times as long as the gap.
ClosedGap close_gap(ArcPath& path);

}  // namespace obvid::cutting
