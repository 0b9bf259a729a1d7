// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "obvid/surface/nurbs_surface.h"

namespace obvid::cad {

/// Sides of a patch in the order of its boundary, seen from where the normal points to: bottom
/// (v from), right (u to), top (v to), left (u from). Each runs along with its parameter: the
/// boundary goes forwards along the first two and backwards along the others.
enum Side : std::size_t { kBottom, kRight, kTop, kLeft };
inline constexpr std::array<Side, 4> kSides = {kBottom, kRight, kTop, kLeft};
[[nodiscard]] constexpr bool runs_with_boundary(Side side) { return side < kTop; }

/// A side as a curve, exact.
[[nodiscard]] SpaceCurve border_of(const NurbsSurface& surface, Side side);

/// Where a patch has an edge.
struct EdgeUse {
  std::size_t edge = 0;
  bool along = true;  ///< the edge runs as the side does
};

struct JointVertex {
  Vec3 point;
  double gap = 0.0;  ///< units: distance of the corners that meet here
};

struct JointEdge {
  SpaceCurve curve;
  std::size_t from = 0, to = 0;  ///< vertices
  bool point = false;            ///< a side that shrinks to a point
  double gap = 0.0;              ///< units: distance of the two borders that meet here
  int uses = 1;
};

/// Patches that hang together.
struct Joined {
  std::vector<std::size_t> patches;
  bool closed = false;  ///< no border is free
};

/// How patches meet: corners that coincide are one vertex, borders that coincide one edge.
struct Joints {
  std::vector<JointVertex> vertices;
  std::vector<JointEdge> edges;
  std::vector<std::array<EdgeUse, 4>> sides;  ///< of each patch
  std::vector<bool> turned;                   ///< patches whose normal is turned round
  std::vector<Joined> groups;
};

/// Borders are one edge when they have the same points at the same parts of their parameters,
/// forwards or backwards, within the tolerance (units). Two patches at most share an edge; a closed
/// patch meets itself in its seam. Normals of patches that hang together are on one side; where
/// that cannot be (Moebius) an edge stays apart. O(patches + border spans), apart from many borders
/// between the same two vertices.
[[nodiscard]] Joints joints_of(const std::vector<NurbsSurface>& patches, double tolerance);
/// Each patch for itself, seams and poles as above.
[[nodiscard]] Joints joints_apart(const std::vector<NurbsSurface>& patches, double tolerance);

}  // namespace obvid::cad
