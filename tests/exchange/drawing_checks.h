// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "../common/text.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// Whether one of the warnings has these words.
inline bool warns(const Drawing& drawing, const std::string& part) {
  for (const std::string& warning : drawing.warnings) {
    if (warning.find(part) != std::string::npos) return true;
  }
  return false;
}

inline void expect_near(Vec2 a, Vec2 b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

}  // namespace obvid
