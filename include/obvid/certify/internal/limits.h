// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "obvid/core/error.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// A number of a contour that none formed by this program can have, and where it stands.
struct OutOfRange {
  ErrorCode code = ErrorCode::kSizeOutOfRange;
  std::string_view list;  ///< "points", "point_tolerance", "elements", "pieces"; empty: the contour
  std::size_t index = 0;
  std::string what;
};

/// The first number outside of what `fit` accepts and forms, within which no step of the proof
/// leaves the range of doubles. Coordinates: as large as a contour within the limits of its size
/// can have. Lengths, weights and turnings: docs/methods/certify.md, section 4. Headings: four
/// turns more than the pieces and corners can make. An origin: no farther from the contour than the
/// contour is large. A curvature that is NaN says that there is none: see below. Nothing when all
/// are within. Cost O(n).
[[nodiscard]] std::optional<OutOfRange> out_of_range(const Contour& contour);

/// The first joint that says of itself that it has no curvature on one side (NaN), as where a drawn
/// curve has a control point on its end. `fit` forms none, and nothing is proved of such a contour.
[[nodiscard]] std::optional<std::size_t> joint_without_curvature(const Contour& contour);

}  // namespace obvid
