// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/alignment/alignment.h"
#include "obvid/alignment/internal/borne_grades.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/vec2.h"
#include "plane.h"

namespace obvid::alignment {

/// Where a joint of an alignment lies.
struct Node {
  double place = 0.0;  ///< in intervals of the points: 2.5 is half way from point 2 to point 3
  Vec2 point;
  double theta = 0.0;  ///< rad, unwrapped
};

/// The piece of linear curvature with given points and headings at both ends; in a graph a cubic.
/// Nothing where there is none.
[[nodiscard]] std::optional<ClothoidPiece> piece_between(Plane plane, Vec2 start, double theta0,
                                                         Vec2 end, double theta1);

/// What may help where nothing was found: those limits alone that were given.
[[nodiscard]] std::string advice_to_allow_more(const AlignmentOptions& options);

/// Grades that the heights of a search bear: of a loop the last one is the first one again.
[[nodiscard]] BorneGrades grades_borne_by(std::vector<Vec2> points, std::vector<double> tolerance,
                                          const Sought& sought);

/// Fewest clothoids with common tangents (G1) that pass within `tolerance` of all points: nodes
/// from the first to the last point, one more than clothoids. The number is the fewest that this
/// search finds, among nodes at the points and at `options.divisions - 1` places between two of
/// them; deviations are linear in those of the nodes, so that a clothoid may be off by some
/// hundredths of the tolerance. Clothoids are as long and as blunt as `options` ask for, to first
/// order too.
///
/// Dynamic programming: which offsets and headings are possible at a place after k clothoids is
/// kept as a few convex polygons. Time grows with the points of a clothoid squared, linearly with
/// those of the series. Distinct neighbours, at least two points; in a graph ascending stations.
/// What is said of clothoids holds for the arcs alone, or for the cubics and parabolas of a graph,
/// where those are `sought`. With `sought.corners` nodes lie at both ends of what rounds a corner,
/// at any place, and no slope is steeper than the heights bear.
[[nodiscard]] Result<std::vector<Node>> fewest_pieces(const std::vector<Vec2>& points,
                                                      const std::vector<double>& tolerance,
                                                      const AlignmentOptions& options,
                                                      const Sought& sought,
                                                      const RunContext& run = {});

}  // namespace obvid::alignment
