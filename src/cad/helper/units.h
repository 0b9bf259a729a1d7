// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"

namespace obvid::cad {

/// A unit of length as the kernel names it.
struct Unit {
  const char* kernel = "MM";
  double millimetres = 1.0;
};

/// Error: E203 for a unit that STEP and IGES do not know.
[[nodiscard]] Result<Unit> unit_of(const std::string& name);

}  // namespace obvid::cad
