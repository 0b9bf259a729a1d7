// SPDX-License-Identifier: Apache-2.0
#include "skin_report.h"

#include <algorithm>
#include <cmath>

#include "across_lines.h"
#include "skin_breaks.h"

namespace obvid {
namespace {

constexpr int kReportSamplesPerSpan = 16;

/// Largest fall of curvature against the direction in which the contour's own curvature changes.
class RippleMeter {
 public:
  void add(double wanted, double found) {
    largest_ = std::max(largest_, std::abs(wanted));
    if (any_) {
      const double change = wanted - wanted_;
      const int direction = change > 0.0 ? 1 : change < 0.0 ? -1 : direction_;
      if (direction != direction_) extreme_ = found_;
      direction_ = direction;
      extreme_ = direction > 0 ? std::max(extreme_, found) : std::min(extreme_, found);
      if (direction != 0) worst_ = std::max(worst_, std::abs(extreme_ - found));
    } else {
      extreme_ = found;
    }
    any_ = true;
    wanted_ = wanted;
    found_ = found;
  }
  [[nodiscard]] double ripple() const { return largest_ > 0.0 ? worst_ / largest_ : 0.0; }

 private:
  bool any_ = false;
  int direction_ = 0;
  double wanted_ = 0.0, found_ = 0.0, extreme_ = 0.0, worst_ = 0.0, largest_ = 0.0;
};

}  // namespace

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

void add_across_report(const SkinStretch& stretch, const std::vector<double>& v, double tolerance,
                       AcrossReport& report) {
  const AcrossPlaces places = places_across(stretch.surface, v);
  report.tolerance = tolerance;
  for (const double u : stretch.breaks) {
    const Isoline line(stretch.surface, u);
    const Tube tube = developed_tube(line, places, tolerance);
    const std::size_t found = waves_found(line, places, tolerance);
    const std::size_t forced = changes_of(taut_string(tube));
    const std::size_t beyond = found - std::min(found, forced);
    ++report.isolines;
    report.found += found;
    report.forced += forced;
    report.proved += changes_certified(tube);
    report.beyond += beyond;
    report.worst = std::max(report.worst, beyond);
  }
}

}  // namespace obvid
