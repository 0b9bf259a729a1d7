// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cell_judge.h"
#include "measure.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"

namespace obvid::mesh {

/// The parameters of a patch cut into cells until each is near enough to the surface. Lines where
/// the surface has an edge (normals that differ by more than the angle) are always cuts.
class CellTree {
 public:
  CellTree(PatchSampler& sampler, const TessellationOptions& options);

  /// First cells, refined. Errors: E103; E502 more cells than triangles are allowed.
  [[nodiscard]] Result<void> build(const RunContext& run = {});
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
  /// A cell that is good, or as small as it may be: nothing. Else its halves.
  [[nodiscard]] static std::optional<std::array<Cell, 2>> cut(CellJudge& judge, Cell& cell);
  /// All that a cell is cut into, in order, but no more than there may be in all and one.
  [[nodiscard]] std::vector<Cell> leaves(CellJudge& judge, const Cell& cell) const;
  [[nodiscard]] Result<void> append(const std::vector<Cell>& leaves);
  [[nodiscard]] std::vector<bool> edges(bool across_u) const;

  PatchSampler& sampler_;
  TessellationOptions options_;
  CellJudge judge_;
  double bend_;  ///< chord on the unit sphere of the angle
  std::vector<bool> edges_u_, edges_v_;
  std::vector<Cell> cells_;
};

}  // namespace obvid::mesh
