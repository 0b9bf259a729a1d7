// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <vector>

#include "obvid/curve/contour.h"

namespace obvid {

/// Parts of a contour between its corners, each as a contour of its own. Over the seam of a closed
/// contour, unless it is a corner, a part goes on, and one without corners stays closed; else
/// (`over_seam` false) all parts are open and the first begins where the contour does.
[[nodiscard]] std::vector<Contour> smooth_parts(const Contour& contour, bool over_seam = true);

}  // namespace obvid
