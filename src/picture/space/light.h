// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "page/values.h"

namespace obvid::picture {

/// Shades of a lighted surface: so many steps that none can be seen.
inline constexpr int kShades = 64;

/// Light on a surface, in shades; `normal` as the viewer sees it, turned to him.
[[nodiscard]] double light_at(Vec3 normal);
/// Colour of a shade; `pale` for isolines.
[[nodiscard]] Rgb shade_colour(int shade, bool front, bool pale);

}  // namespace obvid::picture
