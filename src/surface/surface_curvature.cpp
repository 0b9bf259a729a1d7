// SPDX-License-Identifier: Apache-2.0
// Principal curvatures in an orthonormal basis of the tangent plane: docs/methods/surface.md.
#include <cmath>

#include "obvid/surface/nurbs_surface.h"

namespace obvid {

SurfaceCurvature curvature(const SurfaceJet& jet) {
  SurfaceCurvature result;
  const Vec3 area = cross(jet.du, jet.dv);
  const double lu = norm(jet.du), lv = norm(jet.dv), a = norm(area);
  // partial derivatives that are parallel but for rounding span no plane
  constexpr double kParallel = 1e-14;
  if (!(a > kParallel * lu * lv)) return result;
  result.normal = area / a;
  // e1 along du, e2 across: du = lu e1, dv = c e1 + d e2
  const Vec3 e1 = jet.du / lu, e2 = cross(result.normal, e1);
  const double c = dot(jet.dv, e1), d = dot(jet.dv, e2);
  const double l = dot(jet.duu, result.normal), m = dot(jet.duv, result.normal),
               n = dot(jet.dvv, result.normal);
  // second fundamental form in e1, e2, a symmetric matrix
  const double s11 = l / (lu * lu);
  const double s12 = (m - c / lu * l) / (lu * d);
  const double s22 = (n - 2.0 * (c / lu) * m + (c / lu) * (c / lu) * l) / (d * d);
  const double half = (s11 - s22) / 2.0, radius = std::hypot(half, s12);
  result.mean = (s11 + s22) / 2.0;
  result.k1 = result.mean + radius;
  result.k2 = result.mean - radius;
  result.gaussian = s11 * s22 - s12 * s12;
  const double turn = radius > 0.0 ? std::atan2(s12, half) / 2.0 : 0.0;
  result.direction1 = std::cos(turn) * e1 + std::sin(turn) * e2;
  return result;
}

}  // namespace obvid
