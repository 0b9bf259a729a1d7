// SPDX-License-Identifier: Apache-2.0
#include "across_lines.h"

#include <algorithm>
#include <cmath>

namespace obvid {
namespace {

constexpr int kPlacesPerSpan = 16;

/// Changes of sign of bulges that are higher than each of two tolerances.
class WaveCounter {
 public:
  explicit WaveCounter(const std::array<double, 2>& tolerances) : tolerance_(tolerances) {}

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
  [[nodiscard]] std::array<std::size_t, 2> changes() {
    finish();
    return changes_;
  }

 private:
  void finish() {
    // height of a shallow arc of this length and curvature
    const double height = largest_ * length_ * length_ / 8.0;
    for (std::size_t k = 0; k < 2 && sign_ != 0; ++k) {
      if (!(height > tolerance_[k])) continue;
      if (last_[k] != 0 && last_[k] != sign_) ++changes_[k];
      last_[k] = sign_;
    }
    length_ = largest_ = 0.0;
  }

  std::array<double, 2> tolerance_;
  int sign_ = 0;
  std::array<int, 2> last_{};
  double length_ = 0.0, largest_ = 0.0;
  std::array<std::size_t, 2> changes_{};
};

}  // namespace

Isoline::Isoline(const NurbsSurface& surface, double u)
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

Isoline::Place Isoline::at(const BasisValues& v) const {
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

Vec3 Isoline::derivative(const BasisValues& v, std::size_t order) const {
  Vec3 sum;
  for (std::size_t j = 0; j < order_; ++j) sum = sum + v.value[order][j] * line_[v.first + j];
  return sum;
}

std::vector<BasisValues> bases_across(const NurbsSurface& surface, const std::vector<double>& v,
                                      int derivatives) {
  std::vector<BasisValues> bases;
  bases.reserve(v.size());
  for (const double at : v) {
    bases.push_back(basis_at(surface.degree_v, surface.knots_v, at, derivatives));
  }
  return bases;
}

AcrossPlaces places_across(const NurbsSurface& surface, const std::vector<double>& v) {
  AcrossPlaces places;
  std::vector<double> between;
  for (std::size_t j = 0; j + 1 < v.size(); ++j) {
    const double step = (v[j + 1] - v[j]) / kPlacesPerSpan;
    for (int k = 0; k < kPlacesPerSpan; ++k) {
      between.push_back(v[j] + (k + 0.5) * step);
      places.steps.push_back(step);
    }
  }
  places.between = bases_across(surface, between, 2);
  places.sections = bases_across(surface, v, 2);
  return places;
}

std::array<std::size_t, 2> waves_found(const Isoline& line, const AcrossPlaces& places,
                                       const std::array<double, 2>& tolerances) {
  WaveCounter counter(tolerances);
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

DevelopedLine developed(const Isoline& line, const AcrossPlaces& places, double tolerance) {
  return developed(line, places, std::vector<double>(places.sections.size(), tolerance));
}

DevelopedLine developed(const Isoline& line, const AcrossPlaces& places,
                        const std::vector<double>& tolerance) {
  DevelopedLine out;
  Tube& tube = out.tube;
  std::vector<double> height;
  double slope = 0.0;
  Vec3 before, normal, into;
  for (std::size_t k = 0; k < places.sections.size(); ++k) {
    const Isoline::Place here = line.at(places.sections[k]);
    const double chord = height.empty() ? 0.0 : norm(here.point - before);
    if (!height.empty() && !(chord > 0.0)) continue;
    if (!height.empty()) {
      const Vec3 leaving = (here.point - before) / chord;
      // the normal of the point before: there the chords meet
      if (height.size() > 1) slope += dot(leaving - into, normal);
      tube.at.push_back(tube.at.back() + chord);
      height.push_back(height.back() + slope * chord);
      into = leaving;
    } else {
      tube.at.push_back(0.0);
      height.push_back(0.0);
    }
    out.section.push_back(k);
    const Vec3 across = cross(here.du, here.dv);
    if (norm(across) > 0.0) normal = unit(across);
    before = here.point;
  }
  const double mean = height.size() > 1 ? height.back() / tube.at.back() : 0.0;
  for (std::size_t i = 0; i < height.size(); ++i) {
    const double h = height[i] - mean * tube.at[i];
    tube.low.push_back(h - tolerance[out.section[i]]);
    tube.high.push_back(h + tolerance[out.section[i]]);
  }
  return out;
}

}  // namespace obvid
