// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/run_context.h"
#include "obvid/picture/picture_svg.h"
#include "obvid/pipeline/import.h"

namespace obvid {

/// A curve of a drawing as it is drawn, with what can be proved about it.
struct DrawnContour {
  StoredContour stored;
  std::string name;                           ///< of the curve
  double first_station = 0.0;                 ///< of its start, units
  std::vector<PlacedTransition> transitions;  ///< which pieces are clothoids in their place
  std::optional<VerticalProfile> profile;     ///< of heights
  PictureTitles picture;                      ///< of a picture of it
  std::vector<std::string> remarks;           ///< which curve it is
  std::vector<std::string> warnings;          ///< what was left out, which of several was taken
};

/// Takes the curve that `options` choose. Errors: those of `chosen_curve`; E310 where that is a
/// series of points and its edges were not asked for; E103. `where` stands in errors and remarks.
[[nodiscard]] Result<DrawnContour> drawn_contour(Drawing drawing, const ImportOptions& options,
                                                 const std::string& where,
                                                 const RunContext& run = {});

}  // namespace obvid
