// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface_builders/internal/skin.h"
#include "ripple_meter.h"
#include "section_curve.h"

namespace obvid {

/// Places of a span where curvature along a section is looked at: of the exact skin, and of those
/// whose own spans are longer.
inline constexpr int kReportSamplesPerSpan = 16, kReportSamplesOfLight = 4;

/// One stretch of the skin with everything that was used to make it.
struct SkinStretch {
  std::vector<SectionCurve> sections;
  std::vector<double> breaks;
  NurbsSurface surface;
};

/// Adds what the curvature of a section does in an exact skin with these breaks along.
void add_ripple(const SectionCurve& section, const std::vector<double>& breaks, RippleMeter& meter);

/// Adds what this stretch shows about section k.
void add_section_report(const SkinStretch& stretch, const MeasuredSection& measured, std::size_t k,
                        double v, int samples_per_span, SkinSectionReport& report);

/// Fewest changes of bending on each isoline, and how many of them are certified.
struct ForcedAcross {
  double tolerance = 0.0;  ///< units: how far points may move
  std::vector<std::size_t> forced, proved;
};

/// Those that the points of a surface at the sections force, on the lines u = `lines`; `v` are the
/// sections' parameters. Error: E103.
[[nodiscard]] Result<ForcedAcross> forced_across(const NurbsSurface& surface,
                                                 const std::vector<double>& lines,
                                                 const std::vector<double>& v, double tolerance,
                                                 const RunContext& run);

/// Adds the waves of a surface against what is forced on the same lines, by bulges higher than the
/// tolerance of that; `fine` is the height of bulges that `AcrossReport::all` counts. Error: E103.
[[nodiscard]] Result<void> add_across_report(const NurbsSurface& surface,
                                             const std::vector<double>& lines,
                                             const std::vector<double>& v,
                                             const ForcedAcross& forced, double fine,
                                             const RunContext& run, AcrossReport& report);

}  // namespace obvid
