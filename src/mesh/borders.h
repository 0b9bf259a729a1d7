// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "cell_tree.h"
#include "obvid/surface/internal/topology.h"

namespace obvid::mesh {

/// A point of a side at the patch's own parameter.
struct BorderNode {
  double t = 0.0;
  Vec3 point;
};

/// Borders of all patches: sides of one edge get the same points, at the same pace or not, corners
/// that meet are one point, sides that shrink to a point are that point.
class Borders {
 public:
  Borders(const std::vector<PatchSampler>& patches, const Topology& topology);

  /// Points of all sides from the lines that end on them; `changed` says which trees are new and
  /// comes back with all patches whose borders are new, too.
  void update(const std::vector<CellTree>& trees, std::vector<bool>& changed);

  /// Ascending from the begin to the end of the side's parameter; of the patch's own lines t is
  /// exactly the line's.
  [[nodiscard]] const std::vector<BorderNode>& nodes(std::size_t patch, PatchSide side) const {
    return nodes_[patch][side];
  }

 private:
  [[nodiscard]] const PatchAxis& axis(const EdgeUse& use) const;
  [[nodiscard]] Vec3 point(const EdgeUse& use, double t) const;
  [[nodiscard]] double part_of_edge(const TopologyEdge& edge, const EdgeUse& use, Line line) const;
  [[nodiscard]] double own_parameter(const TopologyEdge& edge, const EdgeUse& use,
                                     double part) const;
  void update_edge(const TopologyEdge& edge, const std::vector<CellTree>& trees);

  const std::vector<PatchSampler>& patches_;
  const Topology& topology_;
  std::vector<std::array<std::vector<BorderNode>, 4>> nodes_;  ///< of each patch and side
};

}  // namespace obvid::mesh
