// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/mesh/mesh.h"
#include "patch_sampler.h"

namespace obvid::mesh {

/// A rectangle of parameters that is drawn by two triangles, or by more where neighbours are finer.
struct Cell {
  Line u0 = 0, u1 = 0;
  Line v0 = 0, v1 = 0;
  bool rising = true;  ///< the diagonal runs from (u0, v0) to (u1, v1)
  bool fan = false;    ///< triangles around a point in the middle
};

/// Number of spans that a cell has to do with in one direction.
[[nodiscard]] std::size_t spans_between(Line from, Line to);

/// Whether the triangles of a cell are near enough to the surface, and if not, where to cut it.
class CellJudge {
 public:
  CellJudge(PatchSampler& sampler, const TessellationOptions& options);

  struct Verdict {
    bool good = false;
    bool rising = true;
    bool cut_u = true;  ///< of one that is not good: cut by a line u = const
  };
  [[nodiscard]] Verdict judge(const Cell& cell);
  /// Where to cut a cell that looks good.
  [[nodiscard]] bool cut_u(const Cell& cell);

 private:
  struct Grid;
  struct Errors;
  [[nodiscard]] Errors errors_of(const Grid& grid) const;
  [[nodiscard]] bool bends_too_much(const Grid& grid, Vec3 middle) const;
  [[nodiscard]] bool cut_is_u(const Grid& grid) const;
  [[nodiscard]] double border_error(const Grid& grid) const;
  [[nodiscard]] Verdict judge_all(const Cell& cell, Vec3 middle);
  [[nodiscard]] Verdict judge_grid(const Grid& grid) const;
  void look_at(const Cell& cell);
  [[nodiscard]] Grid grid_of(const Cell& cell) const;

  PatchSampler& sampler_;
  double chord_;   ///< units
  double spread_;  ///< chord on the unit sphere of half the angle
  double bend_;    ///< of the angle
  std::vector<Place> us_, vs_;
  std::vector<Sample> samples_;
};

}  // namespace obvid::mesh
