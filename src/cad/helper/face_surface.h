// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Face.hxx>
#include <optional>
#include <string>
#include <vector>

#include "obvid/surface/surface.h"

namespace obvid::cad {

/// The surface under a face, over the box of the parameters that the face covers.
struct FaceSurface {
  std::optional<NurbsSurface> surface;  ///< normal as the face has it
  std::string refused;                  ///< why there is none: "has no limits", ...
  bool trimmed = false;                 ///< the face covers a part of the box only
  std::vector<TrimLoop> trims;          ///< then: which; empty where its boundary is not understood
  double trims_within = 0.0;            ///< `SurfacePatch::trims_within`, in the file's lengths
  double deviation = 0.0;               ///< > 0: approximated within this, in the file's lengths
};

[[nodiscard]] FaceSurface surface_of(const TopoDS_Face& face);

}  // namespace obvid::cad
