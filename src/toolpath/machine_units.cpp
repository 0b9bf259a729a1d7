// SPDX-License-Identifier: Apache-2.0
#include "machine_units.h"

#include "obvid/core/units.h"

namespace obvid::toolpath {

double millimetres(const std::string& units) { return unit_ratio(units, "mm").value_or(0.0); }

double machine_scale(const std::string& units) { return units == "in" ? 1.0 : millimetres(units); }

}  // namespace obvid::toolpath
