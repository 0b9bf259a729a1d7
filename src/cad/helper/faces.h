// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface/surface.h"

namespace obvid::cad {

/// A shape and the names of its faces.
struct NamedFaces {
  TopoDS_Shape shape;
  std::vector<TopoDS_Face> faces;
  std::vector<std::string> names;
};

/// Faces on the patches' own splines, lengths times `scale`; patches that meet (`topology_of`,
/// edges know how far their two faces are apart) form a connected shell, in a solid when no
/// border is free (normals outwards then). What the kernel's check finds wrong is taken apart into
/// faces. Errors: E304 no patches, E309 no size, E310 more creases than faces are sensible, E101
/// when the kernel refuses a face, and what `check` finds; `where` names the patch.
[[nodiscard]] Result<NamedFaces> faces_of(const SurfaceModel& model, double scale);

}  // namespace obvid::cad
