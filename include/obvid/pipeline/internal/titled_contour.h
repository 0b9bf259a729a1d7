// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/picture/picture_svg.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// A contour, and what its files say beside its pieces.
struct TitledContour {
  StoredContour stored;
  std::string name = "contour";                 ///< of the curve, where a format has a place for it
  std::string id{};                             ///< by what its file tells it from others
  std::string layer{};                          ///< of its drawing, where that has layers
  std::string source;                           ///< what it was read from, as it was named
  double first_station = 0.0;                   ///< of its start, units
  std::vector<PlacedTransition> transitions{};  ///< which pieces are clothoids in their place
  std::optional<VerticalProfile> profile{};     ///< of heights
  PictureTitles picture{};                      ///< of a picture of it
  std::vector<std::string> remarks{};           ///< which curve it is
  std::vector<std::string> warnings{};          ///< what was left out, which of several was taken
};

/// Of the curve through points: that in its drawing, or that of an airfoil; not that of the file
/// `input`, by whose name it is called otherwise. "contour" where it has none of its own.
[[nodiscard]] std::string curve_name(const PointSeries& series, const std::string& input);

/// A formed contour. `input`: what its points were read from.
[[nodiscard]] TitledContour titled_contour(Fit made, const PointSeries& series,
                                           const std::string& input);

/// Its names, its places and what was said of it, in front of whose remarks goes `profile`, what
/// was chosen of formats in words, unless it is empty.
void set_titles(const TitledContour& contour, const std::string& profile, ExportOptions& formats);

}  // namespace obvid
