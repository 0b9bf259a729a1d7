// SPDX-License-Identifier: Apache-2.0
#include "space/space_shape.h"

#include <algorithm>
#include <cmath>

#include "obvid/numeric/internal/halving.h"

namespace obvid::pipeline_detail {
namespace {

constexpr int kHalvingsOfLength = 100;
/// Joints nearer than this part of the length are one: lengths are known to some 1e-14.
constexpr double kSameJoint = 1e-12;
/// Of the largest curvature beside a joint: flat there (`JointGaps`).
constexpr double kFlatSeam = 1e-6;
constexpr double kSeamPosition = 1e-12, kSeamHeading = 1e-6, kSeamCurvature = 1e-6;
constexpr double kSeamRoundings = 8.0;  ///< of a height

double slope_of_unrolled(const Jet& jet) { return std::atan2(jet.d1.y, jet.d1.x); }

}  // namespace

bool meets(const SpaceSeam& seam, const SpaceSeam& bounds) {
  return seam.position <= bounds.position && seam.heading <= bounds.heading &&
         seam.curvature <= bounds.curvature;
}

SpaceSeam SpaceShape::seam_bounds() const {
  const double height = std::abs(unrolled_.jet(0.0).point.y);
  return {std::max(kSeamPosition, kSeamRoundings * 0x1p-53 * height / plan_.length()), kSeamHeading,
          kSeamCurvature};
}

SpaceSeam SpaceShape::seam() const {
  const std::size_t last = unrolled_.pieces().size() - 1;
  const Jet begin = unrolled_.jet(0.0), end = unrolled_.jet(length(), true);
  const double before = obvid::curvature(end), after = obvid::curvature(begin);
  double beside = 0.0;
  for (const std::size_t k : {std::size_t{0}, last}) {
    for (const Jet& jet :
         {unrolled_.jet(unrolled_.joint(k)), unrolled_.jet(unrolled_.joint(k + 1), true)}) {
      beside = std::max(beside, std::abs(obvid::curvature(jet)));
    }
  }
  const double scale = std::max({std::abs(before), std::abs(after), kFlatSeam * beside});
  SpaceSeam out;
  out.position = std::abs(end.point.y - begin.point.y) / plan_.length();
  out.heading = std::abs(turning(end.d1, begin.d1));
  out.curvature = before == after ? 0.0 : std::abs(after - before) / scale;
  return out;
}

Jet SpaceShape::below(double plan_length, bool before_joint) const {
  const double near = kSameJoint * plan_.length();
  double s = std::clamp(plan_length, 0.0, plan_.length());
  const ContourPath::Parameter here = plan_.parameter(s);
  for (const std::size_t k : {here.piece, here.piece + 1}) {
    if (std::abs(plan_.joint(k) - s) <= near) s = plan_.joint(k);
  }
  return plan_.jet(s, before_joint);
}

SpacePlace SpaceShape::at(double sigma, bool before_joint) const {
  const Jet rolled = unrolled_.jet(sigma, before_joint);
  const double phi = slope_of_unrolled(rolled), c = std::cos(phi), s = std::sin(phi);
  const double g = obvid::curvature(rolled), g_rate = curvature_rate(rolled);
  const Jet plane = below(rolled.point.x, before_joint);
  const double kappa = obvid::curvature(plane), kappa_rate = curvature_rate(plane);

  SpacePlace out;
  out.point = frame_.at(plane.point) + rolled.point.y * frame_.normal();
  out.plan_length = rolled.point.x;
  out.height = rolled.point.y;
  const Vec2 along = (1.0 / norm(plane.d1)) * plane.d1;
  out.tangent = c * (along.x * frame_.x + along.y * frame_.y) + s * frame_.normal();
  const double b = c * c * kappa;
  const double squared = g * g + b * b;
  out.curvature = std::sqrt(squared);
  if (squared > 0.0) {
    const double e = g_rate + s * c * c * c * kappa * kappa;
    const double f = -3.0 * s * c * g * kappa + c * c * c * kappa_rate;
    out.torsion = (b * e - g * f) / squared;
  }
  return out;
}

SpaceShape::Curvatures SpaceShape::curvatures(double sigma, bool before_joint) const {
  const Jet rolled = unrolled_.jet(sigma, before_joint);
  return {obvid::curvature(below(rolled.point.x, before_joint)), obvid::curvature(rolled),
          slope_of_unrolled(rolled)};
}

double SpaceShape::where(double plan_length) const {
  const auto is_before = [&](double s) { return unrolled_.jet(s).point.x < plan_length; };
  return end_of_condition(0.0, length(), is_before, kHalvingsOfLength).middle();
}

std::vector<double> SpaceShape::joints() const {
  std::vector<double> out;
  for (std::size_t k = 0; k <= unrolled_.pieces().size(); ++k) out.push_back(unrolled_.joint(k));
  const std::vector<double> own = out;
  const double near = kSameJoint * length();
  for (std::size_t k = 1; k < plan_.pieces().size(); ++k) {
    const double one = where(plan_.joint(k));
    const auto behind = std::lower_bound(own.begin(), own.end(), one - near);
    if (behind == own.end() || *behind > one + near) out.push_back(one);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace obvid::pipeline_detail
