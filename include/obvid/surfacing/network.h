// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/surface/surface.h"

namespace obvid {

/// Coons patch of four curves in any order and direction: they are put in order by their ends,
/// which have to meet within `tolerance` (units); gaps within it are closed by moving the curves'
/// ends. Errors: E304 not four curves, E203 ends that do not meet (`index`: curve, `value`: gap).
[[nodiscard]] Result<CoonsPatch> coons_from(const std::vector<SpaceCurve>& curves,
                                            double tolerance);

/// Gordon surface of a net of curves: each of `first` crosses each of `second` within the
/// tolerance. Curves are put in order and turned, their parameters made to agree at the crossings.
/// Errors: E304 fewer than two curves of a kind, E203 curves that do not cross (`value`: distance).
[[nodiscard]] Result<GordonSurface> gordon_from(const std::vector<SpaceCurve>& first,
                                                const std::vector<SpaceCurve>& second,
                                                double tolerance);

}  // namespace obvid
