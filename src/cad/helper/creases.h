// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/surface/nurbs_surface.h"

namespace obvid::cad {

/// The surface cut at the inner knots of full multiplicity where its normal jumps; kernels cut
/// there themselves, each in its own way. Where the normal goes on (the quarters of a circle turned
/// about an axis) it stays whole. More than `most` parts: an empty list.
[[nodiscard]] std::vector<NurbsSurface> without_creases(const NurbsSurface& surface,
                                                        std::size_t most);

}  // namespace obvid::cad
