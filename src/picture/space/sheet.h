// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

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

/// A part of a thin body that is drawn larger.
struct SheetPart {
  double from = 0.0, to = 0.0;  ///< px, of the whole body on the sheet
  double top = 0.0;             ///< px, of what is drawn larger
  double scale = 1.0;           ///< px/unit there
  std::string place;
};
/// Heights of the row over each part, and of that of their numbers under the whole body, px.
inline constexpr double kPartCaption = 34.0, kPartNumbers = 30.0;

/// Title, axes, scale bar and the legend of curvature colours.
[[nodiscard]] std::string sheet_furniture(const SheetTexts& texts, const PictureCamera& camera,
                                          const Colours& colours,
                                          const SurfacePictureOptions& options);
/// The same for a body that ends at `under` with its parts below, whose scale bars stand over them.
[[nodiscard]] std::string sheet_furniture(const SheetTexts& texts, const PictureCamera& camera,
                                          const Colours& colours,
                                          const SurfacePictureOptions& options, double under,
                                          const std::vector<SheetPart>& parts);
/// The whole file around a body.
[[nodiscard]] std::string sheet(const SheetTexts& texts, const SurfacePictureOptions& options,
                                const std::string& body);

}  // namespace obvid::picture
