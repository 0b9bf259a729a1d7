// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "obvid/report/curve_comparison.h"

namespace obvid {

/// The curves over each other in true scale, how far the others are from the first one enlarged
/// along its normals, and below it over the chord of airfoils, both sides apart, else over the arc
/// length. On one chord where that was measured. `enlarge`: by how much; nothing: the largest of 1,
/// 2, 5 times a power of ten that keeps the largest deviation below 12 % of the diagonal, at
/// least 1.
[[nodiscard]] std::string overlay_svg(const CurveComparison& compared,
                                      std::optional<double> enlarge);

}  // namespace obvid
