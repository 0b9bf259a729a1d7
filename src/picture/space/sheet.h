// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "space/camera.h"
#include "space/facets.h"

namespace obvid::picture {

/// Heights of the strips above and below the surface, px, and the margin beside it.
inline constexpr double kSheetTop = 64.0, kSheetBottom = 76.0, kSheetMargin = 24.0;

/// What stands around the surface.
struct SheetTexts {
  std::string title;
  std::string facts;
  std::string units;
};

/// Title, axes, scale bar and the legend of curvature colours.
[[nodiscard]] std::string sheet_furniture(const SheetTexts& texts, const PictureCamera& camera,
                                          const Colours& colours,
                                          const SurfacePictureOptions& options);
/// The whole file around a body.
[[nodiscard]] std::string sheet(const SheetTexts& texts, const SurfacePictureOptions& options,
                                const std::string& body);

}  // namespace obvid::picture
