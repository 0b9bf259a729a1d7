// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// A vertex of a tessellated patch.
struct MeshVertex {
  Vec3 point;
  Vec3 normal;  ///< length 1, of the surface (at poles and collapsed edges the limit)
  double u = 0.0;
  double v = 0.0;
};

/// Triangles of one patch, counter-clockwise as seen from where the normal points to.
struct Mesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double deviation =
      0.0;  ///< units: largest distance from the surface that was found on a triangle
};

struct TessellationOptions {
  double chord_tolerance = 0.0;  ///< units, > 0: distance of a triangle from the surface
  double angle = 0.0;  ///< rad, > 0: between the normals at the ends of an edge; edges much shorter
                       ///< than the chord tolerance (1/32 of it: cusps, folds) are free
  std::size_t most_triangles = 4'000'000;  ///< of one patch, E502 beyond
  std::size_t threads = 1;  ///< 0: as many as the machine has; the result does not depend on it
};

/// Triangles within the chord tolerance and angle, fewest where the surface is flat, no cracks
/// inside a patch nor T-joints. Where the surface has an edge that is sharper than the angle,
/// vertices are there twice, each with the normal of its side. Sides that shrink to a point (poles)
/// have a vertex for each triangle, all at that point, and no triangles without area.
/// Errors: E203 options that are not greater than 0 or a tolerance that rounding of the coordinates
/// swallows (16 units of the last place), and those of `check(NurbsSurface)`; E502 more triangles
/// than allowed, or a cusp that no triangles come near.
[[nodiscard]] Result<Mesh> tessellate(const NurbsSurface& surface,
                                      const TessellationOptions& options);
/// All patches, of trimmed ones what is there; vertices of borders that two whole patches share are
/// the same points (trimmed ones have points of their own): borders are shared
/// when they are the same curve from corner to corner (either way, whatever their parameters)
/// within 1e-7 of the model's size and a tenth of the chord tolerance. `Error::index`: the patch.
[[nodiscard]] Result<std::vector<Mesh>> tessellate(const SurfaceModel& model,
                                                   const TessellationOptions& options,
                                                   const RunContext& run = {});

}  // namespace obvid
