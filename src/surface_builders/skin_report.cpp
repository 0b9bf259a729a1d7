// SPDX-License-Identifier: Apache-2.0
#include "skin_report.h"

#include <algorithm>
#include <cmath>

#include "across_lines.h"
#include "ripple_meter.h"
#include "skin_breaks.h"

namespace obvid {
void add_section_report(const SkinStretch& stretch, const MeasuredSection& measured, std::size_t k,
                        double v, SkinSectionReport& report) {
  const SectionCurve& section = stretch.sections[k];
  if (section.is_point()) return;
  const SpaceCurve made = isocurve_at_v(stretch.surface, v);
  RippleMeter meter;
  for (std::size_t i = 0; i + 1 < stretch.breaks.size(); ++i) {
    const double step = (stretch.breaks[i + 1] - stretch.breaks[i]) / kReportSamplesPerSpan;
    for (int j = 0; j < kReportSamplesPerSpan; ++j) {
      const double u = stretch.breaks[i] + (j + 0.5) * step;
      const SpaceJet jet = evaluate(made, u);
      const Hermite wanted = section.at(u);
      report.deviation = std::max(report.deviation, norm(jet.point - wanted.point));
      meter.add(plane_curvature(wanted, section.frame()),
                plane_curvature({jet.point, jet.d1, jet.d2}, section.frame()));
    }
  }
  report.ripple = std::max(report.ripple, meter.ripple());
  const double from = section.length_at(0.0).s, to = section.length_at(1.0).s;
  for (std::size_t i = 0; i < measured.point_at.size(); ++i) {
    const double s = measured.point_at[i];
    if (s < from || s > to) continue;
    const Vec3 here = evaluate(made, section.parameter_of(s)).point;
    report.from_points = std::max(report.from_points, norm(here - measured.section->points[i]));
  }
}

void add_across_report(const SkinStretch& stretch, const NurbsSurface& given,
                       const std::vector<double>& v, double tolerance, double fine,
                       AcrossReport& report) {
  const AcrossPlaces places = places_across(given, v);
  report.tolerance = tolerance;
  report.fine = fine;
  for (const double u : stretch.breaks) {
    const Tube tube = developed(Isoline(given, u), places, tolerance).tube;
    const std::size_t forced = changes_of(taut_string(tube));
    const Isoline line(stretch.surface, u);
    const std::size_t found = waves_found(line, places, tolerance);
    const std::size_t all = fine == tolerance ? found : waves_found(line, places, fine);
    const std::size_t beyond = found - std::min(found, forced);
    ++report.isolines;
    report.found += found;
    report.forced += forced;
    report.proved += changes_certified(tube);
    report.beyond += beyond;
    report.worst = std::max(report.worst, beyond);
    report.all += all;
    report.all_beyond += all - std::min(all, forced);
  }
}

}  // namespace obvid
