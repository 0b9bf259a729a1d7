// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>

#include "obvid/core/internal/watch.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/report/stored_contour.h"

namespace obvid {

/// Texts of a picture; what is empty follows from the contour.
struct PictureTitles {
  std::string name;     ///< of the file or the curve
  std::string verdict;  ///< of curves that nobody here promised anything about
};

/// Which curvatures pictures show.
struct ShownCurvatures {
  enum class Which {
    kUsual,  ///< without those of a small part of the length (a nose) that are far larger than the
             ///< rest; the picture says that they are cut off
    kAll,
    kRange  ///< those of `range`
  } which = Which::kUsual;
  ValueRange range{};  ///< 1/unit
};

/// Plots that are drawn on request.
struct PicturePlots {
  bool slope = false;       ///< d kappa/ds over arc length, below the curvature
  bool deviations = false;  ///< of the points from the contour, in three colours in place of the
                            ///< curvature comb; without effect where no point has a tolerance and
                            ///< `allowed` is 0
  double allowed = 0.0;     ///< units: what deviations are held against; 0: each point's tolerance
  ShownCurvatures curvatures{};
};

/// Picture of a contour for a report: contour, points, curvature comb, vertices, inflections and
/// corners, scale bar, and below it curvature and radius over arc length; where points have
/// tolerances also where the contour passes within them. One self-contained SVG file that
/// follows the viewer's light or dark scheme. Under watch, one that was cancelled is worth nothing.
[[nodiscard]] std::string picture_svg(const StoredContour& stored, const PictureTitles& titles = {},
                                      const PicturePlots& plots = {}, Watch* watch = nullptr);

/// Texts of a comparison.
struct ComparisonTitles {
  std::string heading;  ///< of the whole picture
  std::string before;   ///< what the first contour is
  std::string after;
};

/// Two contours of the same thing beside each other: combs and curvature over arc length, all in
/// the same scales, vertices marked and counted. Where a small part of both (a leading edge) has
/// far larger curvatures than the rest, the axis is that of the rest and the title says so.
[[nodiscard]] std::string comparison_svg(const Contour& before, const Contour& after,
                                         const ComparisonTitles& titles,
                                         const ShownCurvatures& shown = {});

}  // namespace obvid
