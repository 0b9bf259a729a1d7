// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <cstddef>
#include <string>
#include <vector>

#include "obvid/surface/surface.h"

namespace obvid::cad {

/// Faces of a trimmed patch: one for each outer loop, with the loops inside of it as holes. Edges
/// have the loops' curves in the plane of the parameters, and in space the kernel's approximation
/// of them, within `tolerance` (lengths of the patch).
/// `edges`: of a loop of one curve.
[[nodiscard]] std::vector<TopoDS_Face> trimmed_faces(const SurfacePatch& patch, double tolerance,
                                                     std::size_t edges);

/// Faces with edges that lie on each other within the tolerance made one; `faces` become those of
/// the shape.
[[nodiscard]] TopoDS_Shape sewn(std::vector<TopoDS_Face>& faces, double tolerance);

}  // namespace obvid::cad
