// SPDX-License-Identifier: Apache-2.0
#include "skin_report.h"

#include <algorithm>
#include <cmath>

#include "obvid/curve/internal/basis.h"
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

/// B-splines across the sections at parameters that all isolines share.
std::vector<BasisValues> bases_at(const NurbsSurface& surface, const std::vector<double>& v) {
  std::vector<BasisValues> bases;
  bases.reserve(v.size());
  for (const double at : v) bases.push_back(basis_at(surface.degree_v, surface.knots_v, at, 2));
  return bases;
}

/// Isoline of a polynomial surface: control points of the line, and of the derivative by u along
/// it.
class Isoline {
 public:
  Isoline(const NurbsSurface& surface, double u)
      : line_(surface.count_v()),
        slope_(surface.count_v()),
        order_(static_cast<std::size_t>(surface.degree_v) + 1) {
    const BasisValues basis = basis_at(surface.degree_u, surface.knots_u, u, 1);
    for (std::size_t j = 0; j < line_.size(); ++j) {
      const Vec3* row = surface.points.data() + j * surface.count_u() + basis.first;
      for (std::size_t i = 0; i <= static_cast<std::size_t>(surface.degree_u); ++i) {
        line_[j] = line_[j] + basis.value[0][i] * row[i];
        slope_[j] = slope_[j] + basis.value[1][i] * row[i];
      }
    }
  }

  struct Place {
    Vec3 point, du, dv, dvv;
  };
  [[nodiscard]] Place at(const BasisValues& v) const {
    Place place;
    for (std::size_t j = 0; j < order_; ++j) {
      const Vec3 p = line_[v.first + j];
      place.point = place.point + v.value[0][j] * p;
      place.dv = place.dv + v.value[1][j] * p;
      place.dvv = place.dvv + v.value[2][j] * p;
      place.du = place.du + v.value[0][j] * slope_[v.first + j];
    }
    return place;
  }

 private:
  std::vector<Vec3> line_, slope_;
  std::size_t order_;
};

/// Where the waves along isolines are counted.
struct AcrossPlaces {
  std::vector<double> steps;  ///< between the places, by v
  std::vector<BasisValues> between, sections;
};

AcrossPlaces places_across(const NurbsSurface& surface, const std::vector<double>& v) {
  AcrossPlaces places;
  std::vector<double> between;
  for (std::size_t j = 0; j + 1 < v.size(); ++j) {
    const double step = (v[j + 1] - v[j]) / kReportSamplesPerSpan;
    for (int k = 0; k < kReportSamplesPerSpan; ++k) {
      between.push_back(v[j] + (k + 0.5) * step);
      places.steps.push_back(step);
    }
  }
  places.between = bases_at(surface, between);
  places.sections = bases_at(surface, v);
  return places;
}

std::size_t waves_found(const Isoline& line, const AcrossPlaces& places, double tolerance) {
  WaveCounter counter(tolerance);
  for (std::size_t k = 0; k < places.between.size(); ++k) {
    const Isoline::Place here = line.at(places.between[k]);
    const Vec3 normal = unit(cross(here.du, here.dv));
    const double speed = dot(here.dv, here.dv);
    if (speed > 0.0) {
      counter.add(dot(here.dvv, normal) / speed, std::sqrt(speed) * places.steps[k]);
    }
  }
  return counter.changes();
}

/// The same from the sections alone: each point is bent against its neighbours.
std::size_t waves_forced(const Isoline& line, const AcrossPlaces& places, double tolerance) {
  WaveCounter counter(tolerance);
  std::vector<Isoline::Place> at;
  for (const BasisValues& section : places.sections) at.push_back(line.at(section));
  for (std::size_t j = 1; j + 1 < at.size(); ++j) {
    const Vec3 in = at[j].point - at[j - 1].point, out = at[j + 1].point - at[j].point;
    const double a = norm(in), b = norm(out);
    if (!(a > 0.0) || !(b > 0.0)) continue;
    const Vec3 bend = (out / b - in / a) / ((a + b) / 2.0);
    // a bend at one point reaches from the point before it to the one behind
    counter.add(dot(bend, unit(cross(at[j].du, at[j].dv))), a + b);
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
    const Vec3 here = evaluate(made, section.parameter_of(s)).point;
    report.from_points = std::max(report.from_points, norm(here - measured.section->points[i]));
  }
}

void add_across_report(const SkinStretch& stretch, const std::vector<double>& v, double tolerance,
                       AcrossReport& report) {
  const AcrossPlaces places = places_across(stretch.surface, v);
  for (const double u : stretch.breaks) {
    const Isoline line(stretch.surface, u);
    const std::size_t found = waves_found(line, places, tolerance);
    // neighbouring bends of the points may merge into one of the surface
    const std::size_t forced = std::min(found, waves_forced(line, places, tolerance));
    ++report.isolines;
    report.found += found;
    report.forced += forced;
    report.beyond += found - forced;
    report.worst = std::max(report.worst, found - forced);
  }
}

}  // namespace obvid
