// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/curve/contour.h"
#include "obvid/picture/picture_svg.h"

namespace obvid {

/// One contour of a picture of several, with its name and a remark ("G2, 9 pieces"); without pieces
/// the remark says why.
struct NamedContour {
  std::string name;
  std::string remark;
  Contour contour;
  std::optional<Certificate> certificate;  ///< whose counts are told; none: as the samples tell
};

/// Curvature over arc length of contours through the same points, one plot above the other, all in
/// the same scales, vertices and inflections marked; behind each plot the first contour's in grey.
/// Where a small part has far larger curvatures than the rest, the axis is that of the rest and the
/// title says so.
[[nodiscard]] std::string carriers_svg(const std::vector<NamedContour>& contours,
                                       const std::string& heading,
                                       const ShownCurvatures& shown = {});

}  // namespace obvid
