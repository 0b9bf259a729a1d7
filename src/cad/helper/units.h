// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"

namespace obvid::cad {

/// A unit of length, and the kernel's name of the one in which it is written.
struct Unit {
  const char* kernel = "MM";
  double millimetres = 1.0;  ///< in one of ours
};

/// Error: E203 for a unit without a length in metres.
[[nodiscard]] Result<Unit> unit_of(const std::string& name);

}  // namespace obvid::cad
