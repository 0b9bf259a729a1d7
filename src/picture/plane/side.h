// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "plane/plots.h"
#include "plane/track.h"

namespace obvid {

/// One of several contours that are shown beside each other.
struct PictureSide {
  PictureTrack track;
  bool coloured = true;
  std::string caption;
};

/// `title`, and what the curvature does: "clothoids: 0 vertices, 1 inflection", as the certificate
/// counts; without one, as the samples tell.
[[nodiscard]] PictureSide make_picture_side(const Contour& contour, const std::string& title,
                                            const Certificate* certificate = nullptr);

/// Curvature axis that all sides share.
[[nodiscard]] PictureScale common_scale(std::span<const PictureSide> sides,
                                        const ShownCurvatures& shown);

}  // namespace obvid
