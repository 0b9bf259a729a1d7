// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/export.h"

namespace obvid {

/// Choices of formats that are known to work in a system.
struct Profile {
  std::string name;
  std::string choices;  ///< in words, for the user: which file to take and what is set
  ExportOptions options;
};

/// solidworks, freecad, fusion, rhino, autocad, grbl, linuxcnc, fanuc, marlin, opendrive.
[[nodiscard]] const std::vector<Profile>& profiles();

/// Error: E203 with the names that there are.
[[nodiscard]] Result<Profile> profile_of(std::string_view name);

}  // namespace obvid
