// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "obvid/chain/internal/chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/geom/element.h"

namespace obvid {

/// A line or an arc that points mean, as somebody else found it.
struct MeantPiece {
  std::size_t first = 0, last = 0;  ///< its points; `last` counts on over the seam of a loop
  Element middle;                   ///< of it; curvature 0: a line
};

/// Measured points with the circles in which the true points may lie.
struct MeasuredSeries {
  std::vector<Vec2> points;        ///< no two neighbours equal
  std::vector<double> reach;       ///< how far each point may be moved, units; 0: not at all
  std::vector<NodeData> nodes;     ///< empty, or what is given at each point
  bool closed = false;             ///< the last point is followed by the first
  bool primitives = false;         ///< stretches that mean a line or circle become exactly that
  std::vector<MeantPiece> meant;   ///< these are the primitives; empty: they are searched
  std::vector<std::size_t> loose;  ///< points that take no part in primitives
  bool thin = true;  ///< only as many nodes as the tolerances can tell apart; else every point
};

/// A series of moved points with headings and curvatures that spirals can join, one direction per
/// link. Where points lie closer together than their tolerances let them tell anything, only some
/// of them are nodes; the others are passed within their tolerance.
struct FairedSeries {
  std::vector<Element> elements;  ///< per node; a closed series does not repeat its first
  std::vector<std::optional<std::size_t>> source;  ///< per node: its measured point; nothing at a
                                                   ///< node inside a link, where a vertex lies
  std::vector<std::int8_t> direction;              ///< per link: +1 curvature grows, -1 falls, 0 an
                                                   ///< exact arc or line
  bool feasible = false;  ///< false: the points are moved and smooth, but no runs were found;
                          ///< headings and curvatures are those of the smooth curve
  int vertices = 0;       ///< changes of direction
  int vertices_lower_bound = 0;  ///< what the points force within their tolerances
  std::size_t trouble = 0;       ///< when not feasible: node near which it failed
  int primitives = 0;            ///< exact lines and arcs
  int given_up = 0;  ///< further ones, that the points mean: no transitions beside them were found
  std::vector<std::size_t>
      loose;  ///< points taken off the primitives so that transitions have room
  int newton_steps = 0;
};

/// Finds few alternating runs of monotone curvature within the tolerances, and the fairest such
/// series (docs/methods/fairing.md): a smooth curve through the tube of tolerances, from its runs
/// the weakest are taken away as long as the problem stays feasible, then one solve of the whole.
///
/// Guarantees: every node lies within its point's reach, by construction. The lower bound is that
/// of `forced_vertices` (obvid/series). Not guaranteed: that fewer vertices are impossible when the
/// lower bound is smaller; that points between nodes keep their tolerance to the last bit (they are
/// held to a quintic Hermite model of the link: measure the finished contour).
/// Cost O(n) per Newton step, some 20 steps and a few hundred short windows.
/// Requires at least 4 points (3 when closed), no two neighbours equal.
[[nodiscard]] FairedSeries fair(const MeasuredSeries& series, Watch& watch);

/// The measured point at the end of a primitive that lies nearest to a node; nothing without
/// primitives.
[[nodiscard]] std::optional<std::size_t> nearest_primitive_end(const FairedSeries& faired,
                                                               std::size_t node);

}  // namespace obvid
