// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// A closed contour turned so that its first joint stands on its first point: fitting begins loops
/// at a corner. Open contours stay. Error: E310 when no joint stands there.
[[nodiscard]] Result<Contour> begun_at_first_point(const Contour& contour);

}  // namespace obvid
