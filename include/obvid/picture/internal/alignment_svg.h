// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/alignment/profile.h"
#include "obvid/picture/picture_svg.h"

namespace obvid {

/// What the picture of an alignment tells beside its curve. Stations as they are counted.
struct AlignmentDiagram {
  struct Part {
    double station = 0.0;            ///< of its start, units
    double length = 0.0;             ///< units
    std::string label;               ///< "R 300", "A 134", empty for lines
    std::vector<double> curvatures;  ///< at equal steps from its start to its end, 1/unit
  };
  std::vector<Part> parts;            ///< ascending
  std::optional<double> speed_scale;  ///< km/h at a curvature of 1: speed = scale / sqrt(curvature)
  std::optional<VerticalProfile> profile{};
  std::vector<Vec2> heights{};  ///< station, height: what the profile is of
};

/// Picture of an alignment: the curve as in `picture_svg`, and below it over the station curvature,
/// speed and heights, with the stations where elements begin. One self-contained SVG file.
[[nodiscard]] std::string alignment_svg(const StoredContour& stored, const PictureTitles& titles,
                                        const AlignmentDiagram& diagram);

}  // namespace obvid
