// SPDX-License-Identifier: Apache-2.0
#include "units.h"

#include <array>
#include <utility>

namespace obvid::cad {

Result<Unit> unit_of(const std::string& name) {
  static constexpr std::array<std::pair<const char*, Unit>, 7> kUnits = {{{"um", {"UM", 1e-3}},
                                                                          {"mm", {"MM", 1.0}},
                                                                          {"cm", {"CM", 10.0}},
                                                                          {"m", {"M", 1000.0}},
                                                                          {"km", {"KM", 1e6}},
                                                                          {"in", {"INCH", 25.4}},
                                                                          {"ft", {"FT", 304.8}}}};
  for (const auto& [known, unit] : kUnits) {
    if (name == known) return unit;
  }
  return fail({ErrorCode::kBadOption, "STEP and IGES do not know the unit '" + name + "'",
               "--units", "one of um, mm, cm, m, km, in, ft", -1, 0.0});
}

}  // namespace obvid::cad
