// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "obvid/surface/internal/topology.h"

namespace obvid::cad {

/// Sides of a patch in the order of its boundary, seen from where the normal points to: the
/// boundary goes forwards along the first two and backwards along the others.
inline constexpr std::array<PatchSide, 4> kBoundary = {kVStart, kUEnd, kVEnd, kUStart};
[[nodiscard]] constexpr bool runs_with_boundary(PatchSide side) {
  return side == kVStart || side == kUEnd;
}

/// Where a patch has an edge.
struct JointUse {
  std::size_t edge = 0;
  bool along = true;              ///< the edge runs as the side does
  bool other_parameters = false;  ///< the side has other parameters than the edge
};

struct JointEdge {
  SpaceCurve curve;
  std::size_t from = 0, to = 0;  ///< vertices of the topology
  bool point = false;            ///< a side that shrinks to a point
  double gap = 0.0;              ///< units: distance of the two borders that meet here
  int uses = 1;
};

/// Patches connected by shared borders.
struct Joined {
  std::vector<std::size_t> patches;
  bool closed = false;  ///< no border is free
};

/// How patches make shells: an edge belongs to two sides at most.
struct Joints {
  std::vector<TopologyVertex> vertices;
  std::vector<JointEdge> edges;
  std::vector<std::array<JointUse, 4>> sides;  ///< of each patch and `PatchSide`
  std::vector<bool> turned;                    ///< patches whose normal is turned round
  std::vector<Joined> groups;
};

/// Whether patches share edges with others, or each only with itself: seams and poles.
enum class JoinedWith { kAll, kItself };

/// Edges of a topology with two sides each: where more meet, pairs are made in the order of the
/// patches. A patch meets itself in its seam only: opposite sides in the same direction. Normals of
/// connected patches are on one side; where that cannot be (Moebius) an edge stays apart.
[[nodiscard]] Joints joints_of(const std::vector<NurbsSurface>& patches, const Topology& topology,
                               JoinedWith joined);

}  // namespace obvid::cad
