// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/internal/box.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Triangles of any origin (files of scanners, printers, other systems), corners counter-clockwise
/// as seen from outside. Neighbours share their corners: what reads a file merges equal points.
struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The box of all points. Error: E304 there are none.
[[nodiscard]] Result<Box3> bounds_of(const TriangleMesh& mesh);

/// A chain of edges of a plane section, in the coordinates of the plane.
struct MeshSection {
  std::vector<Vec2> points;  ///< no two neighbours equal; the first one is not repeated at the end
  bool closed = false;       ///< else it ends where the mesh does, or at an edge of three triangles
  std::size_t turned = 0;    ///< edges whose triangles look the other way than the first one's
};

/// Where a plane cuts the mesh: every chain of edges, longest first.
///
/// - Points lie where edges of triangles cross the plane, computed once for both neighbours: chains
///   close exactly. A corner in the plane counts as above it (on the side of its normal), so that
///   no chain is lost or there twice; a face in the plane has its border where the mesh goes down.
///   Where no corner lies below the plane, those in it count as below: the lowest face has its
///   border as the highest one has.
/// - Seen from the plane's normal the body lies to the left: outer chains run counter-clockwise,
///   holes clockwise, when the triangles look outwards. Closed chains begin at their point of
///   largest x (of several: largest y).
/// - What the plane only touches (one point) is not there. Points in the middle of flat faces stay:
///   they are points of the mesh's edges.
/// - Cracks are not closed: where neighbours do not share their corners, chains end. One whose own
///   ends meet within 1e-9 of its size is closed: a seam that differs by rounding.
/// Same mesh, same chains. Linear in triangles and n log n in the points of the section.
/// Errors: E307 a triangle without its points; E303 a point or plane that is not finite.
[[nodiscard]] Result<std::vector<MeshSection>> cut_mesh(const TriangleMesh& mesh,
                                                        const Frame& plane);

}  // namespace obvid
