// SPDX-License-Identifier: Apache-2.0
#include "third_order.h"

#include "obvid/curve/internal/basis.h"
#include "obvid/curve/internal/homogeneous.h"

namespace obvid {
namespace {

/// n over k for n <= 3.
constexpr std::array<std::array<double, 4>, 4> kChoose = {
    {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}}};

using Homogeneous = std::array<std::array<Vec4, 4>, 4>;

Homogeneous derivatives_at(const NurbsSurface& s, double u, double v) {
  const BasisValues a = basis_at(s.degree_u, s.knots_u, u, 3);
  const BasisValues b = basis_at(s.degree_v, s.knots_v, v, 3);
  Homogeneous h{};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(s.degree_v); ++j) {
    std::array<Vec4, 4> row{};
    for (std::size_t i = 0; i <= static_cast<std::size_t>(s.degree_u); ++i) {
      const Vec4 p = lifted(s.points, s.weights, (b.first + j) * s.count_u() + a.first + i);
      for (std::size_t r = 0; r < 4; ++r) row[r] = row[r] + a.value[r][i] * p;
    }
    for (std::size_t q = 0; q < 4; ++q) {
      for (std::size_t r = 0; r + q < 4; ++r) h[r][q] = h[r][q] + b.value[q][j] * row[r];
    }
  }
  return h;
}

}  // namespace

Partials partials_to_third(const NurbsSurface& surface, double u, double v) {
  const Homogeneous h = derivatives_at(surface, u, v);
  Partials s{};
  // numerator = weight times point, by the rule of Leibniz solved for the highest derivative
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t q = 0; r + q < 4; ++q) {
      Vec3 rest = numerator(h[r][q]);
      for (std::size_t i = 0; i <= r; ++i) {
        for (std::size_t j = 0; j <= q; ++j) {
          if (i + j == 0) continue;
          rest = rest - kChoose[r][i] * kChoose[q][j] * h[i][j].w * s[r - i][q - j];
        }
      }
      s[r][q] = rest / h[0][0].w;
    }
  }
  return s;
}

Partials partials_of_area(const Partials& s) {
  Partials area{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t q = 0; r + q < 3; ++q) {
      for (std::size_t i = 0; i <= r; ++i) {
        for (std::size_t j = 0; j <= q; ++j) {
          area[r][q] =
              area[r][q] + kChoose[r][i] * kChoose[q][j] * cross(s[i + 1][j], s[r - i][q - j + 1]);
        }
      }
    }
  }
  return area;
}

Partials partials_of_unit(const Partials& a) {
  const double length = norm(a[0][0]);
  Partials n{};
  n[0][0] = a[0][0] / length;
  const double length_u = dot(n[0][0], a[1][0]), length_v = dot(n[0][0], a[0][1]);
  n[1][0] = (a[1][0] - length_u * n[0][0]) / length;
  n[0][1] = (a[0][1] - length_v * n[0][0]) / length;
  const auto second = [&](Vec3 both, Vec3 by_x, Vec3 n_x, Vec3 n_y, double l_x, double l_y) {
    const double l_xy = dot(n_y, by_x) + dot(n[0][0], both);
    return (both - l_xy * n[0][0] - l_x * n_y - l_y * n_x) / length;
  };
  n[2][0] = second(a[2][0], a[1][0], n[1][0], n[1][0], length_u, length_u);
  n[1][1] = second(a[1][1], a[1][0], n[1][0], n[0][1], length_u, length_v);
  n[0][2] = second(a[0][2], a[0][1], n[0][1], n[0][1], length_v, length_v);
  return n;
}

}  // namespace obvid
