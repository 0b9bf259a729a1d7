// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/nurbs_surface.h"

#include <algorithm>

#include "obvid/curve/internal/basis.h"
#include "obvid/curve/internal/homogeneous.h"
#include "obvid/curve/internal/knots.h"
#include "obvid/geom/internal/box.h"

namespace obvid {

Result<void> check(const NurbsSurface& surface) {
  OBVID_TRY(check_knots(surface.degree_u, surface.knots_u, "the knots along u"));
  OBVID_TRY(check_knots(surface.degree_v, surface.knots_v, "the knots along v"));
  return check_points(surface.points, surface.weights, surface.count_u() * surface.count_v());
}

Range domain_u(const NurbsSurface& s) { return {s.knots_u.front(), s.knots_u.back()}; }
Range domain_v(const NurbsSurface& s) { return {s.knots_v.front(), s.knots_v.back()}; }

SurfaceJet evaluate(const NurbsSurface& s, double u, double v) {
  const BasisValues a = basis_at(s.degree_u, s.knots_u, u, 2);
  const BasisValues b = basis_at(s.degree_v, s.knots_v, v, 2);
  // h[r][q]: r times by u, q times by v, of the homogeneous form
  std::array<std::array<Vec4, 3>, 3> h{};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(s.degree_v); ++j) {
    std::array<Vec4, 3> row{};
    for (std::size_t i = 0; i <= static_cast<std::size_t>(s.degree_u); ++i) {
      const Vec4 p = lifted(s.points, s.weights, (b.first + j) * s.count_u() + a.first + i);
      for (std::size_t r = 0; r < 3; ++r) row[r] = row[r] + a.value[r][i] * p;
    }
    for (std::size_t q = 0; q < 3; ++q) {
      for (std::size_t r = 0; r + q < 3; ++r) h[r][q] = h[r][q] + b.value[q][j] * row[r];
    }
  }
  if (s.weights.empty()) {
    return {numerator(h[0][0]), numerator(h[1][0]), numerator(h[0][1]),
            numerator(h[2][0]), numerator(h[1][1]), numerator(h[0][2])};
  }
  SurfaceJet jet;
  const double w = h[0][0].w, wu = h[1][0].w, wv = h[0][1].w;
  jet.point = numerator(h[0][0]) / w;
  jet.du = (numerator(h[1][0]) - wu * jet.point) / w;
  jet.dv = (numerator(h[0][1]) - wv * jet.point) / w;
  jet.duu = (numerator(h[2][0]) - 2.0 * wu * jet.du - h[2][0].w * jet.point) / w;
  jet.dvv = (numerator(h[0][2]) - 2.0 * wv * jet.dv - h[0][2].w * jet.point) / w;
  jet.duv = (numerator(h[1][1]) - wu * jet.dv - wv * jet.du - h[1][1].w * jet.point) / w;
  return jet;
}

double size_of(const NurbsSurface& surface) {
  Box3 box;
  box.add_all(surface.points);
  return box.diagonal();
}

}  // namespace obvid
