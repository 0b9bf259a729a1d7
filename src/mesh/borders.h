// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "cell_tree.h"

namespace obvid::mesh {

/// The sides of a patch: where v begins and ends (along u), where u begins and ends (along v).
inline constexpr std::size_t kSides = 4;
[[nodiscard]] constexpr bool runs_along_u(std::size_t side) { return side < 2; }
[[nodiscard]] constexpr bool is_far_end(std::size_t side) { return side % 2 == 1; }

/// A point of a side at the patch's own parameter.
struct BorderNode {
  double t = 0.0;
  Vec3 point;
};

/// Borders of all patches: sides that are the same curve, at the same pace or not, get the same
/// points, corners that meet
/// are one point, sides that shrink to a point are that point.
class Borders {
 public:
  /// `same`: units, what lies nearer together is the same.
  Borders(const std::vector<PatchSampler>& patches, double same);

  /// Points of all sides from the lines that end on them; `changed` says which trees are new and
  /// comes back with all patches whose borders are new, too.
  void update(const std::vector<CellTree>& trees, std::vector<bool>& changed);

  /// Ascending from the begin to the end of the side's parameter; of the patch's own lines t is
  /// exactly the line's.
  [[nodiscard]] const std::vector<BorderNode>& nodes(std::size_t patch, std::size_t side) const {
    return nodes_[patch * kSides + side];
  }

 private:
  struct Curve {                       ///< what is known of a side
    std::array<std::size_t, 2> end{};  ///< numbers of its corner points
    bool collapsed = false;
    bool reversed = false;  ///< against the first of its group
    bool own_pace = false;  ///< the same curve, but parameters run differently from the first's
    std::size_t group = 0;
  };
  void find_corners();
  void find_groups();
  [[nodiscard]] const PatchAxis& axis(std::size_t side) const;
  [[nodiscard]] SurfacePoint at(std::size_t side, double t) const;
  [[nodiscard]] Vec3 point(std::size_t side, double t) const;
  [[nodiscard]] bool is_collapsed(std::size_t side) const;
  [[nodiscard]] bool are_same(std::size_t a, std::size_t b, bool reversed) const;
  [[nodiscard]] bool follows(std::size_t a, std::size_t b, bool reversed) const;
  [[nodiscard]] bool joins(std::size_t side, std::size_t first);
  [[nodiscard]] double foot(std::size_t side, Vec3 of) const;
  [[nodiscard]] double part_in_group(std::size_t side, Line line) const;
  [[nodiscard]] double own_parameter(std::size_t side, double part) const;
  void update_group(const std::vector<std::size_t>& sides, const std::vector<CellTree>& trees);

  const std::vector<PatchSampler>& patches_;
  double same_;
  std::vector<Vec3> corners_;  ///< of all patches, four each; the same where they meet
  std::vector<Curve> curves_;  ///< of all patches, four each
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<std::vector<BorderNode>> nodes_;
};

}  // namespace obvid::mesh
