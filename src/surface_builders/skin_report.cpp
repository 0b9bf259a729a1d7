// SPDX-License-Identifier: Apache-2.0
#include "skin_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "across_lines.h"
#include "obvid/core/internal/parallel.h"
#include "ripple_meter.h"
#include "skin_breaks.h"

namespace obvid {

void add_ripple(const SectionCurve& section, const std::vector<double>& breaks,
                RippleMeter& meter) {
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double length = breaks[i + 1] - breaks[i];
    const auto piece = quintic(section.at(breaks[i]), section.at(breaks[i + 1]), length);
    for (int j = 0; j < kReportSamplesPerSpan; ++j) {
      const double part = (j + 0.5) / kReportSamplesPerSpan;
      const Hermite wanted = section.at(breaks[i] + part * length);
      meter.add(plane_curvature(wanted, section.frame()),
                plane_curvature(evaluate(piece, part, length), section.frame()),
                curvature_rounding(wanted, length, section));
    }
  }
}

void add_section_report(const SkinStretch& stretch, const MeasuredSection& measured, std::size_t k,
                        double v, int samples_per_span, SkinSectionReport& report) {
  const SectionCurve& section = stretch.sections[k];
  if (section.is_point()) return;
  const SpaceCurve made = isocurve_at_v(stretch.surface, v);
  RippleMeter meter;
  const auto look = [&](double u, double span) {
    const SpaceJet jet = evaluate(made, u);
    const Hermite wanted = section.at(u);
    report.deviation = std::max(report.deviation, norm(jet.point - wanted.point));
    meter.add(plane_curvature(wanted, section.frame()),
              plane_curvature({jet.point, jet.d1, jet.d2}, section.frame()),
              curvature_rounding(wanted, span, section));
  };
  for (std::size_t i = 0; i + 1 < stretch.breaks.size(); ++i) {
    const double span = stretch.breaks[i + 1] - stretch.breaks[i];
    const double step = span / samples_per_span;
    look(stretch.breaks[i], span);  // runs end at breaks: places beside one alone would mix two
    for (int j = 0; j < samples_per_span; ++j) look(stretch.breaks[i] + (j + 0.5) * step, span);
    if (i + 2 == stretch.breaks.size()) look(stretch.breaks.back(), span);
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

Result<ForcedAcross> forced_across(const NurbsSurface& surface, const std::vector<double>& lines,
                                   const std::vector<double>& v, double tolerance,
                                   const RunContext& run) {
  ForcedAcross out{tolerance, std::vector<std::size_t>(lines.size()),
                   std::vector<std::size_t>(lines.size())};
  const AcrossPlaces places = places_across(surface, v);
  OBVID_TRY(in_parallel(lines.size(), run, [&](std::size_t l) {
    const Tube tube = developed(Isoline(surface, lines[l]), places, tolerance).tube;
    out.forced[l] = changes_of(taut_string(tube));
    out.proved[l] = changes_certified(tube);
  }));
  return out;
}

Result<void> add_across_report(const NurbsSurface& surface, const std::vector<double>& lines,
                               const std::vector<double>& v, const ForcedAcross& forced,
                               double fine, const RunContext& run, AcrossReport& report) {
  const AcrossPlaces places = places_across(surface, v);
  std::vector<std::array<std::size_t, 2>> found(lines.size());
  OBVID_TRY(in_parallel(lines.size(), run, [&](std::size_t l) {
    found[l] = waves_found(Isoline(surface, lines[l]), places, {forced.tolerance, fine});
  }));
  report.tolerance = forced.tolerance;
  report.fine = fine;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const auto beyond = [&](std::size_t many) { return many - std::min(many, forced.forced[l]); };
    ++report.isolines;
    report.found += found[l][0];
    report.forced += forced.forced[l];
    report.proved += forced.proved[l];
    report.beyond += beyond(found[l][0]);
    report.worst = std::max(report.worst, beyond(found[l][0]));
    report.all += found[l][1];
    report.all_beyond += beyond(found[l][1]);
  }
  return {};
}

}  // namespace obvid
