// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Face.hxx>
#include <map>
#include <string>

#include "obvid/core/result.h"
#include "obvid/core/units.h"

namespace obvid::cad {

/// All that a file holds, and what its faces are called there.
struct Loaded {
  TopoDS_Shape shape;
  Units units = "mm";  ///< assumed for BREP files, which have none
  std::map<const Geom_Surface*, std::string> name_of_surface;  ///< what repairs leave as it is

  /// Empty when the file has no name for it.
  [[nodiscard]] std::string name_of(const TopoDS_Face& face) const {
    TopLoc_Location place;
    const auto found = name_of_surface.find(BRep_Tool::Surface(face, place).get());
    return found != name_of_surface.end() ? found->second : std::string{};
  }
};

/// A STEP, IGES or BREP file, by its first bytes. Errors: E301, E306.
[[nodiscard]] Result<Loaded> load(const std::string& path);

}  // namespace obvid::cad
