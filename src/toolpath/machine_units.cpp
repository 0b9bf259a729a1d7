// SPDX-License-Identifier: Apache-2.0
#include "machine_units.h"

#include "obvid/core/units.h"

#include "obvid/toolpath/toolpath.h"

namespace obvid::toolpath {

double millimetres(const std::string& units) { return unit_ratio(units, "mm").value_or(0.0); }

double machine_scale(const std::string& units) { return units == "in" ? 1.0 : millimetres(units); }

}  // namespace obvid::toolpath

namespace obvid {

double millimetres_of(const std::string& units) { return toolpath::millimetres(units); }

ToolpathFeeds default_feeds(const std::string& units) {
  const bool inches = units == "in";
  return {default_feed(units), inches ? 12.0 : 300.0, inches ? 200.0 : 5000.0};
}

}  // namespace obvid
