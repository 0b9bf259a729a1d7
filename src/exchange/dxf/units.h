// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace obvid::dxf {

/// A unit of $INSUNITS in one that the program has a name for.
struct Unit {
  const char* name = "mm";
  double factor = 1.0;  ///< lengths of the file times this are in `name`
  bool known = false;   ///< false: none is stated, or an unknown one
};

[[nodiscard]] Unit unit_of(int insunits);

/// $INSUNITS of a unit by its canonical name; 0: none.
[[nodiscard]] int insunits_of(std::string_view name);

/// $MEASUREMENT of a value of $INSUNITS: 0 inches and feet, 1 metric.
[[nodiscard]] int measurement_of(int insunits);

}  // namespace obvid::dxf
