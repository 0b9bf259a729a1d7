// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "obvid/pipeline/fit.h"

namespace obvid {

/// Refused because rounding decides, or made with a warning that says so.
inline bool speaks_of_rounding(const Result<Fit>& f) {
  if (!f) return f.error().code == ErrorCode::kRoundingDecides;
  return std::any_of(f->warnings.begin(), f->warnings.end(), [](const std::string& w) {
    return w.find("rounding of the coordinates decides") != std::string::npos;
  });
}

}  // namespace obvid
