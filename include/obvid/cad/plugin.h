// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "obvid/cad/cad.h"
#include "obvid/core/version.h"

namespace obvid {

/// What the plugin hands to the program: made by the same compiler from the same sources, which
/// `built` proves.
struct CadPlugin {
  const char* built;
  Result<std::string> (*write)(const std::vector<CadCurve>&, const CadWriteOptions&);
  Result<Drawing> (*read)(const std::string& path);
  Result<std::string> (*write_surfaces)(const SurfaceModel&, const CadWriteOptions&);
  Result<CadSurfaces> (*read_surfaces)(const std::string& path);
};

inline constexpr const char* kCadPluginFile = "obvid_cad.so";
inline constexpr const char* kCadPluginSymbol = "obvid_cad_plugin";

/// Version, compiler and the sizes of what is handed over, of the program and of the plugin: a
/// plugin that was left behind from an older build is told by it.
inline std::string build_mark() {
  std::string mark = std::string(kVersion) + ", " + __VERSION__;
  for (const std::size_t size :
       {sizeof(CadCurve), sizeof(CadWriteOptions), sizeof(Drawing), sizeof(DrawnCurve),
        sizeof(Piece), sizeof(PointSeries), sizeof(Error), sizeof(CadPlugin), sizeof(CadSurfaces),
        sizeof(SurfacePatch), sizeof(NurbsSurface)}) {
    mark += ", " + std::to_string(size);
  }
  return mark;
}

}  // namespace obvid
