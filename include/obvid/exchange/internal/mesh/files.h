// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/mesh/mesh.h"
#include "obvid/surface/surface.h"

namespace obvid {

// Triangles as files. `meshes[i]` belongs to patch i of the model. Common errors: E307 meshes that
// do not belong to the patches or triangles without their vertices, E303 what is not finite, E311
// no triangles, E309 coordinates or a file larger than the format can hold, E103.

/// Binary STL: coordinates in the model's units as single precision (the format has nothing else,
/// see `single_precision_loss`), normals of the triangles; name and units in the header. Triangles
/// whose corners become one point in single precision are left out: closed ones stay closed.
[[nodiscard]] Result<std::string> stl_text(const SurfaceModel& model,
                                           const std::vector<Mesh>& meshes, Watch* watch = nullptr);

/// Wavefront OBJ: one object per patch, points with all digits and shared by neighbours, normals,
/// texture coordinates = parameters over their ranges, in [0, 1].
[[nodiscard]] Result<std::string> obj_mesh_text(const SurfaceModel& model,
                                                const std::vector<Mesh>& meshes,
                                                Watch* watch = nullptr);

/// glTF 2.0 binary (GLB): one mesh per patch with normals and texture coordinates (as of OBJ), seen
/// from both sides. The node above them turns z up into glTF's y up, scales to metres and moves to
/// the place in double precision: single precision coordinates count from the middle of the model.
/// Units other than um, mm, cm, m, km, in, ft count as mm.
[[nodiscard]] Result<std::string> glb_text(const SurfaceModel& model,
                                           const std::vector<Mesh>& meshes, Watch* watch = nullptr);

/// Binary PLY (little endian) of all patches together: points in double precision, normals,
/// texture coordinates s and t, and the number of the patch of each triangle.
[[nodiscard]] Result<std::string> ply_text(const SurfaceModel& model,
                                           const std::vector<Mesh>& meshes, Watch* watch = nullptr);

/// How far single precision moves a point at most, units: what STL adds to the deviation. Large
/// far from the origin.
[[nodiscard]] double single_precision_loss(const std::vector<Mesh>& meshes);

}  // namespace obvid
