// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

/// The reference series of the papers, as in examples/series10.csv.
inline const std::vector<Vec2> kTenPoints = {
    {0, 0},          {0.21, -5.28},  {-5.11, -10.13}, {-20.48, -7.65}, {-28.68, 16.23},
    {-13.87, 40.95}, {17.95, 55.28}, {54.24, 53.04},  {100.94, 36.19}, {230.38, -50.82}};

}  // namespace obvid
