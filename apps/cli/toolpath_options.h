// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/toolpath/toolpath.h"
#include "obvid/toolpath/toolpath_gcode.h"

namespace obvid {

/// `obvid toolpath`
struct ToolpathCommand {
  std::string input;
  std::vector<std::string> outputs;                          ///< G-code, pictures, pages
  ToolpathOptions plan;                                      ///< but for what follows
  std::optional<double> diameter, corner_radius, tolerance;  ///< units of the surface
  std::string view = "iso";
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

}  // namespace obvid
