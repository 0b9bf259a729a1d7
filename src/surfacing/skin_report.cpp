// SPDX-License-Identifier: Apache-2.0
#include "skin_report.h"

#include <algorithm>
#include <cmath>

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

/// Common parameter of an arc length: the function is monotone.
double parameter_of(const SectionCurve& section, double s) {
  double low = 0.0, high = 1.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2.0;
    (section.length_at(middle).s < s ? low : high) = middle;
  }
  return (low + high) / 2.0;
}

/// Changes of sign of bulges that are higher than a tolerance.
class WaveCounter {
 public:
  explicit WaveCounter(double tolerance) : tolerance_(tolerance) {}

  /// The next step along a line: curvature over a length.
  void add(double kappa, double length) {
    const int sign = kappa > 0.0 ? 1 : kappa < 0.0 ? -1 : 0;
    if (sign != sign_) {
      finish();
      sign_ = sign;
    }
    length_ += length;
    largest_ = std::max(largest_, std::abs(kappa));
  }
  [[nodiscard]] std::size_t changes() {
    finish();
    return changes_;
  }

 private:
  void finish() {
    // height of a shallow arc of this length and curvature
    const bool counts = sign_ != 0 && largest_ * length_ * length_ / 8.0 > tolerance_;
    if (counts && last_ != 0 && last_ != sign_) ++changes_;
    if (counts) last_ = sign_;
    length_ = largest_ = 0.0;
  }

  double tolerance_;
  int sign_ = 0, last_ = 0;
  double length_ = 0.0, largest_ = 0.0;
  std::size_t changes_ = 0;
};

std::size_t waves_found(const NurbsSurface& surface, double u, const std::vector<double>& v,
                        double tolerance) {
  WaveCounter counter(tolerance);
  for (std::size_t j = 0; j + 1 < v.size(); ++j) {
    const double step = (v[j + 1] - v[j]) / kReportSamplesPerSpan;
    for (int k = 0; k < kReportSamplesPerSpan; ++k) {
      const SurfaceJet jet = evaluate(surface, u, v[j] + (k + 0.5) * step);
      const Vec3 normal = unit(cross(jet.du, jet.dv));
      const double speed = dot(jet.dv, jet.dv);
      if (speed > 0.0) counter.add(dot(jet.dvv, normal) / speed, std::sqrt(speed) * step);
    }
  }
  return counter.changes();
}

/// The same from the sections alone: each point is bent against its neighbours.
std::size_t waves_forced(const NurbsSurface& surface, double u, const std::vector<double>& v,
                         double tolerance) {
  WaveCounter counter(tolerance);
  for (std::size_t j = 1; j + 1 < v.size(); ++j) {
    const Vec3 before = evaluate(surface, u, v[j - 1]).point,
               after = evaluate(surface, u, v[j + 1]).point;
    const SurfaceJet here = evaluate(surface, u, v[j]);
    const double a = norm(here.point - before), b = norm(after - here.point);
    if (!(a > 0.0) || !(b > 0.0)) continue;
    const Vec3 bend = ((after - here.point) / b - (here.point - before) / a) / ((a + b) / 2.0);
    // a bend at one point reaches from the point before it to the one behind
    counter.add(dot(bend, unit(cross(here.du, here.dv))), a + b);
  }
  return counter.changes();
}

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
    const Vec3 here = evaluate(made, parameter_of(section, s)).point;
    report.from_points = std::max(report.from_points, norm(here - measured.section->points[i]));
  }
}

void add_across_report(const SkinStretch& stretch, const std::vector<double>& v, double tolerance,
                       AcrossReport& report) {
  for (const double u : stretch.breaks) {
    const std::size_t found = waves_found(stretch.surface, u, v, tolerance);
    const std::size_t forced = waves_forced(stretch.surface, u, v, tolerance);
    ++report.isolines;
    report.found += found;
    report.forced += forced;
    if (found <= forced) continue;
    report.beyond += found - forced;
    report.worst = std::max(report.worst, found - forced);
  }
}

}  // namespace obvid
