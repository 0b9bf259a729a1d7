// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/series/analysis.h"

namespace obvid::pipeline_detail {

/// Whether the contour that a chain through all points is stored as is proved: its pieces, and its
/// joints too, whose curvature leaps beyond what doubles hold where a link is close to having no
/// spiral. O(n log n).
[[nodiscard]] bool proved_as_stored(const std::vector<Vec2>& points, const SeriesChain& chain);

/// Where the contour that a chain with lines and arcs is stored as is not proved beside one of
/// them: the point at the nearer end of the nearest one. Nothing where it is proved, or where it is
/// not but a point lies between. O(n log n).
[[nodiscard]] std::optional<std::size_t> primitive_end_unproved(const std::vector<Vec2>& points,
                                                                const SeriesChain& chain);

/// The first joint whose gap is beyond its bound, or before the first piece that is not proved to
/// be monotone and to turn by less than half a turn. Nothing where there is none.
[[nodiscard]] std::optional<std::size_t> unproved_joint(const Certificate& certificate);

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
