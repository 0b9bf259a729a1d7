// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/series/analysis.h"

namespace obvid::pipeline_detail {

/// Whether the contour that a chain through all points is stored as is proved: its pieces, and its
/// joints too, whose curvature leaps beyond what doubles hold where a link is close to having no
/// spiral. O(n log n).
[[nodiscard]] bool proved_as_stored(const std::vector<Vec2>& points, const SeriesChain& chain);

/// Vertices and inflections that a chain has.
struct ChainTurns {
  int vertices = 0, inflections = 0;

  [[nodiscard]] bool more_than(const ChainTurns& other) const {
    return vertices > other.vertices || inflections > other.inflections;
  }
};
[[nodiscard]] ChainTurns turns_of_chain(const SeriesChain& chain);

/// A chain for given data that lie near an end of what the points leave, where no fair one was
/// found or proved: headings and curvatures from what can be reached from both sides
/// (`central_data`), one spiral of the form that exists wherever a spiral exists to each link, and
/// the contour proved as it is stored. The directions are those of the analysis, else those of the
/// chain `free` that the points have when nothing is given, with its vertices between points where
/// they are. `free` may be nothing. Nothing when there is none, or the work is to end.
[[nodiscard]] std::optional<SeriesChain> edge_chain(const std::vector<Vec2>& points,
                                                    const Analysis& analysis,
                                                    const ChainConstraints& constraints,
                                                    const SeriesChain* free, Watch& watch);

}  // namespace obvid::pipeline_detail
