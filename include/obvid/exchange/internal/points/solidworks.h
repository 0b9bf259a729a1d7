// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/exchange/internal/points/samples.h"

namespace obvid {

/// Points of one curve for "Curve through XYZ points".
struct SldcrvFile {
  std::string suffix;  ///< "" when there is one file, else "-1", "-2", ...
  std::string text;    ///< x y z, no header, no duplicates
};

/// One file for each run of the contour: splines through the points of several runs would wave at
/// the vertices. Lengths as they are: the program reads them in the units of its document.
[[nodiscard]] Result<std::vector<SldcrvFile>> sldcrv_files(const Contour& contour,
                                                           const SampleOptions& options,
                                                           Watch* watch = nullptr);

/// A macro in the text form of SolidWorks (VBA; .swb, .bas) that draws the contour into an active
/// sketch: CreateLine, CreateArc, CreateEllipticalArc (for conics) and CreateSpline2 through
/// samples for all others. Lengths in metres, as that interface wants them: contours in um, mm, cm,
/// m, km, in and ft are converted, others taken as mm.
[[nodiscard]] Result<std::string> solidworks_macro(const Contour& contour,
                                                   const SampleOptions& options,
                                                   Watch* watch = nullptr);

}  // namespace obvid
