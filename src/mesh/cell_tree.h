// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell_judge.h"
#include "measure.h"
#include "obvid/core/result.h"

namespace obvid::mesh {

/// The parameters of a patch cut into cells until each is near enough to the surface. Lines where
/// the surface has an edge (normals that differ by more than the angle) are always cuts.
class CellTree {
 public:
  CellTree(PatchSampler& sampler, const TessellationOptions& options);

  /// First cells, refined. E502 more cells than triangles are allowed.
  [[nodiscard]] Result<void> build();
  /// Cells that look good and turned out not to be, mostly because of the points of their
  /// neighbours: first they become fans, which gives neighbours no new points, the second time they
  /// are cut. Cells that are as small as they may be stay. False: nothing changed.
  /// `seen`, one for each cell, is kept beside the cells.
  [[nodiscard]] Result<bool> improve(const std::vector<bool>& marked, std::vector<CellSeen>& seen);

  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  /// The surface has an edge at the begin of this span.
  [[nodiscard]] const std::vector<bool>& edges_u() const { return edges_u_; }
  [[nodiscard]] const std::vector<bool>& edges_v() const { return edges_v_; }

 private:
  [[nodiscard]] Result<void> refine(const Cell& cell);
  [[nodiscard]] std::vector<bool> edges(bool across_u) const;

  PatchSampler& sampler_;
  CellJudge judge_;
  std::size_t most_;
  double bend_;  ///< chord on the unit sphere of the angle
  std::vector<bool> edges_u_, edges_v_;
  std::vector<Cell> cells_, waiting_;
};

}  // namespace obvid::mesh
