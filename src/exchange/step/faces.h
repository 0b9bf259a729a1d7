// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "step/curves.h"

namespace obvid::exchange {

/// An OPEN_SHELL of one face to each shape of a chain, the shape moved along z by `width`.
/// Neighbours share their edge; a closed curve of one shape has a seam. Normals to the right.
StepId step_shell(const StepChain& chain, double width, StepFile& file, StepCurves& curves);

}  // namespace obvid::exchange
