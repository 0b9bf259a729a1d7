// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/exchange/internal/cad_curve.h"

namespace obvid {

/// Application protocols of STEP files.
enum class StepSchema { kAp214, kAp242 };

struct StepOptions {
  StepSchema schema = StepSchema::kAp214;
  std::string units = "mm";  ///< of the curves, and of the file as `cad_unit` says
  double face_width = 0.0;  ///< units; > 0: also faces, the curves moved along z by this width, for
                            ///< systems that show no wires
};

/// A STEP file (ISO 10303-21) of curves in the plane z = 0, and of NURBS curves in space, without a
/// CAD kernel: a NURBS curve as
/// B_SPLINE_CURVE_WITH_KNOTS, rational where its weights differ; lines, arcs and arcs of ellipses
/// as trimmed LINE, CIRCLE and ELLIPSE, several of them as one COMPOSITE_CURVE; other rational
/// pieces, and arcs whose centre lies too far away for its digits, as splines
/// (docs/methods/step.md). Numbers have the fewest digits that give them back. The name of the
/// product is that of the first curve. The same curves give the same bytes.
/// Linear time. Errors: E203 a unit that STEP does not know; E303 a number that is not finite; E311
/// no curves or no pieces; E310 a clothoid, and faces of a curve in space; what `check` finds of
/// one; E103; E101 pieces that do not meet, and knots, points and weights that make no NURBS curve.
[[nodiscard]] Result<std::string> step_text(const std::vector<CadCurve>& curves,
                                            const StepOptions& options = {},
                                            Watch* watch = nullptr);

}  // namespace obvid
