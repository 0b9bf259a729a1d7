// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/profiles.h"

#include <algorithm>

namespace obvid {
namespace {

ExportOptions cad(DxfProfile dxf) {
  ExportOptions out;
  out.dxf = dxf;
  return out;
}

ExportOptions controller(GcodeController which) {
  ExportOptions out;
  out.dxf = DxfProfile::kArcs;
  out.controller = which;
  return out;
}

}  // namespace

const std::vector<Profile>& profiles() {
  static const std::vector<Profile> all = {
      {"solidworks", "take .step (AP214, one edge); .dxf with cubic splines",
       cad(DxfProfile::kCubic)},
      {"freecad", "take .step or .brep; .dxf with exact splines", cad(DxfProfile::kExact)},
      {"fusion", "take .step (AP214); .dxf with arcs for sketches", cad(DxfProfile::kArcs)},
      {"rhino", "take .step or .iges; .dxf with exact splines", cad(DxfProfile::kExact)},
      {"autocad", "take .dxf with exact splines; .step for solids", cad(DxfProfile::kExact)},
      {"grbl", "take .nc: G2/G3 below half a turn, centres from the start (G91.1), M2",
       controller(GcodeController::kGrbl)},
      {"linuxcnc", "take .ngc: G2/G3 below half a turn, centres from the start (G91.1), M2",
       controller(GcodeController::kLinuxCnc)},
      {"fanuc", "take .nc: G2/G3 below half a turn, program O0001 between %, M30",
       controller(GcodeController::kFanuc)},
      {"marlin", "take .gcode: G2/G3 below half a turn, remarks behind semicolons, no end word",
       controller(GcodeController::kMarlin)},
      {"opendrive", "take .xodr: lines, arcs and spirals in metres, from --carrier clothoids",
       ExportOptions{}},
  };
  return all;
}

Result<Profile> profile_of(std::string_view name) {
  const auto found = std::find_if(profiles().begin(), profiles().end(),
                                  [&](const Profile& one) { return one.name == name; });
  if (found != profiles().end()) return *found;
  std::string names;
  for (const Profile& one : profiles()) names += (names.empty() ? "" : ", ") + one.name;
  return error(ErrorCode::kBadOption, "no profile is called '" + std::string(name) + "'")
      .where("--for")
      .hint("one of " + names);
}

}  // namespace obvid
