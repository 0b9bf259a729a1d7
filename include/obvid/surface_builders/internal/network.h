// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/surface/surface.h"

namespace obvid {

/// Coons patch of four curves in any order and direction: they are put in order by their ends,
/// which have to meet within `tolerance` (units); gaps within it are closed by moving the curves'
/// end control points to the middle (shapes move by half a gap at most, and not at all where the
/// ends already meet). The first curve becomes `u_at_v0` as it stands. Of several orders, as with
/// closed curves, the one with the least twist. A triangle has a fourth curve of length 0.
/// Errors: E304 not four curves, E203 ends that do not meet (`index`: curve, `value`: gap), the
/// same curve twice side by side, tolerance not > 0; those of `check`.
[[nodiscard]] Result<CoonsPatch> coons_from(const std::vector<SpaceCurve>& curves,
                                            double tolerance);

/// Gordon surface of a net of curves: each of `first` (they become `along_u`) crosses each of
/// `second` within the tolerance. Curves are put in order and turned: the first curve of each kind
/// keeps its direction. What sticks out beyond the outermost crossings by more than the tolerance
/// is cut off. Curves shorter than the tolerance are poles. Closed curves have to begin on a curve
/// of the other kind, which then stands twice, at 0 and at 1.
///
/// Parameters at the crossings become the means of the curves' own. What is exact: curves that
/// agree to 1e-9 of the size stay as they are; if only one kind does, it stays as it is and the
/// other is rebuilt; otherwise both are rebuilt through the middles of the gaps. Rebuilt curves are
/// C2 cubics that meet the crossings to rounding and leave the given shape by at most the tolerance
/// plus their share of the gaps.
///
/// Errors: E304 fewer than two curves of a kind; E203 curves that do not cross (`index`: of
/// `first`, `value`: distance), cross in different orders or at the same place (the same curve
/// twice), closed curves that begin nowhere, tolerance not > 0; E502 a curve that cannot be rebuilt
/// within the tolerance; those of `check`.
[[nodiscard]] Result<GordonSurface> gordon_from(const std::vector<SpaceCurve>& first,
                                                const std::vector<SpaceCurve>& second,
                                                double tolerance);

}  // namespace obvid
