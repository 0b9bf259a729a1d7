// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// Elements of joints that lie outside what their pieces have there, heading and curvature each, get
/// the nearest of these: rounding of coordinates can turn a short piece by more than anything that
/// was sought.
void take_piece_ends(Contour& contour);

}  // namespace obvid::pipeline_detail
