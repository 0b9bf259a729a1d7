// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "passes.h"
#include "reach.h"
#include "surface_cells.h"

namespace obvid::toolpath {

/// What a larger cutter left that rested on every place of the part: where it came no nearer to the
/// surface than the tolerance. Told by the middles of cells.
class Leftover {
 public:
  /// `reach`: of the smaller cutter, as many as cells; known for the cells that are left then.
  /// Passes farther than `beyond` from where that cutter touches these are not needed.
  [[nodiscard]] static Result<Leftover> find(const Part& part, const CutterShape& earlier,
                                             const SurfaceCells& cells, LargeList<Nearest>& reach,
                                             double beyond, std::size_t threads,
                                             const RunContext& run);

  /// The earlier cutter did not come to the middle of this cell.
  [[nodiscard]] bool at(std::size_t cell) const { return left_[cell] != 0; }
  /// A pass needs this place of the tip, level as it is.
  [[nodiscard]] bool wants(Vec3 tip) const;
  /// Walks a rail of the axis where it is needed.
  [[nodiscard]] Result<Pass> walk(Walker& walker, const Rail& rail) const;
  /// Leaves of a pass what is needed.
  void keep(Pass& pass) const;
  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] double depth() const { return depth_; }  ///< of what is left, along normals
  [[nodiscard]] Vec3 place() const { return place_; }    ///< where that is

 private:
  struct Heights {
    double low = 0.0, high = 0.0;
  };
  using Square = std::pair<long, long>;
  [[nodiscard]] Square square(Vec2 p) const;
  void mark(Vec3 tip);

  double side_ = 0.0;
  std::vector<std::uint8_t> left_;
  std::map<Square, Heights> squares_;  ///< seen from above, with heights of the tip
  double area_ = 0.0, depth_ = 0.0;
  Vec3 place_;
};

/// All of a rail of the axis, or what of it is needed for what an earlier cutter left.
[[nodiscard]] Result<Pass> walk_where_left(Walker& walker, const Rail& rail, const Leftover* left);

/// Passes that have pieces here and there, one for each piece, each beginning (`either_end`: or
/// ending) near to where the last one ended.
[[nodiscard]] std::vector<Pass> in_short_order(std::vector<Pass> passes, bool either_end);

}  // namespace obvid::toolpath
