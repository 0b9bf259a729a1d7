// SPDX-License-Identifier: Apache-2.0
#include "machine_units.h"

#include <array>
#include <utility>

#include "obvid/toolpath/toolpath.h"

namespace obvid::toolpath {

double millimetres(const std::string& units) {
  static constexpr std::array<std::pair<const char*, double>, 7> kUnits = {{{"um", 1e-3},
                                                                            {"mm", 1.0},
                                                                            {"cm", 10.0},
                                                                            {"m", 1e3},
                                                                            {"km", 1e6},
                                                                            {"in", 25.4},
                                                                            {"ft", 304.8}}};
  for (const auto& [name, value] : kUnits) {
    if (units == name) return value;
  }
  return 0.0;
}

double machine_scale(const std::string& units) { return units == "in" ? 1.0 : millimetres(units); }

}  // namespace obvid::toolpath

namespace obvid {

double millimetres_of(const std::string& units) { return toolpath::millimetres(units); }

ToolpathFeeds default_feeds(const std::string& units) {
  const bool inches = units == "in";
  return {default_feed(units), inches ? 12.0 : 300.0, inches ? 200.0 : 5000.0};
}

}  // namespace obvid
