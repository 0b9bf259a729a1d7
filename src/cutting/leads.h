// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "edges.h"

namespace obvid::cutting {

/// Quarters of circles on the side of the waste that lead to a path and away from it. Lengths in
/// units of the machine.
class Leads {
 public:
  /// `radius` 0: there are none. `waste_left`: of the way of the tool.
  Leads(const Edges& edges, double radius, double tool_radius, bool waste_left)
      : edges_(edges), radius_(radius), tool_radius_(tool_radius), waste_left_(waste_left) {}

  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] double tool_radius() const { return tool_radius_; }

  /// Tangent to a piece at a place of it, towards it or away.
  [[nodiscard]] ArcPiece at(const Piece& piece, double place, bool in) const;

  /// It crosses no edge, and the tool fits beside all of them.
  [[nodiscard]] bool has_room(const ArcPiece& lead) const;

 private:
  const Edges& edges_;
  double radius_, tool_radius_;
  bool waste_left_;
};

}  // namespace obvid::cutting
