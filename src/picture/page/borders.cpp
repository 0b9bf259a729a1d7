// SPDX-License-Identifier: Apache-2.0
#include "page/values.h"

#include <algorithm>

namespace obvid::picture {
namespace {

/// Points closer than this part of the size are one; also how far inside normals are compared.
constexpr double kSameBorderPlace = 1e-7;
constexpr double kInside = 1e-4;
/// Cosine of the angle between the normals of both sides of a smooth seam: 1.8 degrees.
constexpr double kSmooth = 0.9995;
constexpr int kPlaces = 12;

/// A place by its part of the domain across and along a border.
SurfaceJet at(const NurbsSurface& s, bool of_u, double across, double along) {
  const Range u = domain_u(s), v = domain_v(s);
  return of_u ? evaluate(s, u.at(across), v.at(along)) : evaluate(s, u.at(along), v.at(across));
}

struct Pair {
  bool first_is_point = true, second_is_point = true, seam = true;
};

Pair judge(const NurbsSurface& s, bool of_u) {
  const double near = kSameBorderPlace * size_of(s);
  const Vec3 a0 = at(s, of_u, 0.0, 0.0).point, b0 = at(s, of_u, 1.0, 0.0).point;
  Pair pair;
  for (int k = 0; k <= kPlaces; ++k) {
    const double along = static_cast<double>(k) / kPlaces;
    const Vec3 a = at(s, of_u, 0.0, along).point, b = at(s, of_u, 1.0, along).point;
    pair.first_is_point = pair.first_is_point && norm(a - a0) <= near;
    pair.second_is_point = pair.second_is_point && norm(b - b0) <= near;
    if (norm(a - b) > near) pair.seam = false;
    if (!pair.seam || k == 0 || k == kPlaces) continue;  // the ends may be poles
    const Vec3 na = curvature(at(s, of_u, kInside, along)).normal;
    const Vec3 nb = curvature(at(s, of_u, 1.0 - kInside, along)).normal;
    pair.seam = dot(na, nb) >= kSmooth;
  }
  return pair;
}

}  // namespace

std::array<bool, 4> real_borders(const NurbsSurface& surface) {
  const Pair u = judge(surface, true), v = judge(surface, false);
  return {!u.seam && !u.first_is_point, !u.seam && !u.second_is_point, !v.seam && !v.first_is_point,
          !v.seam && !v.second_is_point};
}

}  // namespace obvid::picture
