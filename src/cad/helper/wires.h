// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Shape.hxx>
#include <vector>

#include "obvid/cad/internal/cad.h"

namespace obvid::cad {

/// One wire per curve in the plane z = 0, lengths times `scale`, and its face if `face_width` > 0.
/// Error: E310 for clothoids; E101 when the kernel refuses a curve.
[[nodiscard]] Result<TopoDS_Shape> shape_of(const std::vector<CadCurve>& curves, double scale,
                                            double face_width);

}  // namespace obvid::cad
