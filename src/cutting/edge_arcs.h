// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "offset_path.h"

namespace obvid::cutting {

/// Arcs, and longer lines, in place of edges that follow each other with small turns, and how far
/// the farthest is from the edges.
struct EdgeArcs {
  ArcPath path;
  double deviation = 0.0;
};

/// Each ends at vertices, begins where the one before ends and goes as far as one was found to stay
/// within `within` of the edges (places of all edges are looked at; both ways, as each arc is a
/// graph over its chord): the headings of neighbours may differ as those of edges do. Vertices
/// where edges turn by more than 30 degrees stay corners; pieces other than lines stay.
[[nodiscard]] EdgeArcs arcs_over_edges(const ArcPath& path, double within);

}  // namespace obvid::cutting
