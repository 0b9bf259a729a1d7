// SPDX-License-Identifier: Apache-2.0
// What nets of curves are asked before anything is built on them.
#pragma once

#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface/space_curve.h"

namespace obvid {

[[nodiscard]] Result<void> check_tolerance(double tolerance);
/// All pass `check`; the error says which does not, with `kind` behind its number.
[[nodiscard]] Result<void> check_curves(const std::vector<SpaceCurve>& curves,
                                        const std::string& kind);
/// All control points within the tolerance.
[[nodiscard]] bool is_point(const SpaceCurve& curve, double tolerance);

}  // namespace obvid
