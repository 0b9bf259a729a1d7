// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/idspline/internal/id_spline.h"

namespace obvid::idspline {

/// Finds the node data of order `first_free` and above at the inner nodes, so that as many
/// derivatives are continuous there as there are free data.
void smooth(IdSpline& spline, int first_free);

}  // namespace obvid::idspline
