// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/surface/point_grid.h"

namespace obvid {

/// Turns sections round that run against the one before them, and warns of those; warns too of
/// closed sections that begin elsewhere than the one before, and of sections that lie back along
/// the body.
void align_sections(std::vector<SpaceSeries>& sections, std::vector<std::string>& warnings);

}  // namespace obvid
