// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "obvid/chain/internal/chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/geom/element.h"

namespace obvid {

/// Points that are met exactly, with the way in which their adjacent circles say that the curvature
/// changes.
struct ExactSeries {
  std::vector<Vec2> points;            ///< at least 2, no two neighbours equal
  std::vector<NodeData> nodes;         ///< one per point: what is given there
  std::vector<std::int8_t> direction;  ///< per link: +1 or -1
  bool with_room = false;              ///< links must keep clear of the limits of their cones, too
};

/// The same points with the directions that they can keep. Where one direction does not carry a
/// link, a node between its points carries a vertex.
struct ExactRuns {
  bool feasible = false;
  std::vector<Element> elements;                   ///< per node
  std::vector<std::optional<std::size_t>> source;  ///< per node: its point; nothing inside a link
  std::vector<std::int8_t> direction;              ///< per link between nodes
  std::size_t trouble = 0;                         ///< not feasible: a point near which it failed
  int newton_steps = 0;
};

/// Mends the directions of a series through whose points no curve of the given ones runs: window by
/// window a vertex is moved by a link, else one or two are put inside a link, until every window
/// holds, then the whole. The change that needs the fewest vertices is taken, of equal ones the
/// fairest. What is not in the way stays as it was given.
/// Not guaranteed: the least number of vertices. Cost O(n) for the windows that hold, some 30
/// solves of a window for each that does not; given up after 20,000 Newton steps of a link per
/// link.
[[nodiscard]] ExactRuns exact_runs(const ExactSeries& series, Watch& watch);

}  // namespace obvid
