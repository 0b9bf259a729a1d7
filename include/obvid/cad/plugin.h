// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/cad/cad.h"
#include "obvid/core/version.h"

namespace obvid {

/// What the plugin hands to the program: made by the same compiler from the same sources, which
/// `built` proves.
struct CadPlugin {
  const char* built;
  Result<std::string> (*write)(const std::vector<CadCurve>&, const CadWriteOptions&);
  Result<Drawing> (*read)(const std::string& path);
};

inline constexpr const char* kCadPluginFile = "obvid_cad.so";
inline constexpr const char* kCadPluginSymbol = "obvid_cad_plugin";

/// Version and compiler, of the program and of the plugin.
inline std::string build_mark() { return std::string(kVersion) + ", " + __VERSION__; }

}  // namespace obvid
