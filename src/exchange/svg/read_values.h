// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "svg/path_builder.h"

namespace obvid::exchange {

/// Size of the nearest viewport in its user units: what percentages refer to.
struct SvgViewport {
  double width = 0.0;
  double height = 0.0;
};

/// Which length of the viewport 100 % is.
enum class SvgAxis { kX, kY, kDiagonal };

struct SvgViewBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// A length with or without unit, px: px, mm, cm, Q, in, pt, pc, %; nothing for others (em, ex: the
/// font is not known).
[[nodiscard]] std::optional<double> svg_length(std::string_view text, SvgAxis axis,
                                               const SvgViewport& viewport);

/// Value of a `transform` attribute; nothing where it has an error.
[[nodiscard]] std::optional<Affine> svg_transform(std::string_view text);

/// Four numbers, width and height > 0; nothing otherwise.
[[nodiscard]] std::optional<SvgViewBox> svg_view_box(std::string_view text);

/// What maps a view box into the viewport from (x, y) of the given size, as the value of
/// preserveAspectRatio says (empty: xMidYMid meet).
[[nodiscard]] Affine svg_fit(const SvgViewBox& box, Vec2 corner, const SvgViewport& size,
                             std::string_view preserve);

}  // namespace obvid::exchange
