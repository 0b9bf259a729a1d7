// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/surface_builders/internal/skin.h"
#include "section_curve.h"

namespace obvid {

/// Places of a span where curvature along a section is looked at.
inline constexpr int kReportSamplesPerSpan = 16;

/// One stretch of the skin with everything that was used to make it.
struct SkinStretch {
  std::vector<SectionCurve> sections;
  std::vector<double> breaks;
  NurbsSurface surface;
};

/// Adds what this stretch shows about section k.
void add_section_report(const SkinStretch& stretch, const MeasuredSection& measured, std::size_t k,
                        double v, SkinSectionReport& report);

/// Adds the waves across this stretch against what the points of `given` force, a surface over the
/// same knots across (the stretch's own where nothing was moved); `v` are the sections' parameters,
/// `fine` the height of bulges that `AcrossReport::all` counts.
void add_across_report(const SkinStretch& stretch, const NurbsSurface& given,
                       const std::vector<double>& v, double tolerance, double fine,
                       AcrossReport& report);

}  // namespace obvid
