// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/contour/conics.h"
#include "obvid/curve/pieces.h"

namespace obvid::exchange {

/// Whether an arc given by its centre, radius and angles loses no more than 1e-10 of `size`:
/// centres far away take the digits.
[[nodiscard]] bool centre_is_near(const ArcPiece& arc, double size);

/// The ellipse of a rational quadratic, where its centre and axes lose no more than 1e-10 of
/// `size`; nothing for other pieces, and so near to a parabola that the control points say more.
[[nodiscard]] std::optional<Ellipse> ellipse_within(const RationalBezier& piece, double size);

}  // namespace obvid::exchange
