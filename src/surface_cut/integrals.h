// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "obvid/geom/vec3.h"
#include "obvid/numeric/internal/gauss.h"
#include "obvid/surface/nurbs_surface.h"

/// What is measured of a body afloat.
namespace obvid::afloat {

/// Integrals over a part of a patch: area; and with the third component of du x dv 1, x, y, y^2;
/// with the height above the water too 1, x, y, and half that height.
inline constexpr std::size_t kIntegrals = 9;
using Integrals = std::array<double, kIntegrals>;
inline constexpr std::array<int, kIntegrals> kDimension = {2, 2, 3, 3, 4, 3, 4, 4, 4};
enum : std::size_t { kArea, kFlat, kFlatX, kFlatY, kFlatYy, kVolume, kMomentX, kMomentY, kMomentZ };

inline constexpr double kPartsDiffer = 1e-13;  ///< of the size, to the power of the dimension
inline constexpr int kMostHalvingsOfParts = 10;
inline Integrals operator+(Integrals a, const Integrals& b) {
  for (std::size_t i = 0; i < kIntegrals; ++i) a[i] += b[i];
  return a;
}

/// With what the last step changed.
struct Sum {
  Integrals value{}, error{};
  void add(const Sum& other) {
    value = value + other.value;
    error = error + other.error;
  }
};

template <std::size_t N>
std::array<double, N> nodes(Range range) {
  std::array<double, N> out{};
  for (std::size_t i = 0; i < N / 2; ++i) {
    const double step = 0.5 * range.length() * GaussRule<N>::kNode[i];
    out[N / 2 + i] = 0.5 * (range.from + range.to) + step;
    out[N / 2 - 1 - i] = 0.5 * (range.from + range.to) - step;
  }
  return out;
}
template <std::size_t N>
double weight(std::size_t i) {
  return GaussRule<N>::kWeight[i >= N / 2 ? i - N / 2 : N / 2 - 1 - i];
}

/// What is integrated, at a point; heights are those over the origin.
inline Integrals integrands(const SurfacePoint& p, Vec3 origin) {
  const Vec3 normal = cross(p.du, p.dv), r = p.point - origin;
  const double n = normal.z;
  return {norm(normal),       n,       r.x * n,       r.y * n,
          r.y * r.y * n,      r.z * n, r.x * r.z * n, r.y * r.z * n,
          0.5 * r.z * r.z * n};
}

/// What is small of each for a model of that size.
inline Integrals small_integrals(double size) {
  Integrals out{};
  for (std::size_t i = 0; i < kIntegrals; ++i) {
    out[i] = kPartsDiffer * std::pow(size, kDimension[i]);
  }
  return out;
}

template <std::size_t N>
using Rule = std::integral_constant<std::size_t, N>;

/// `part` of each of 2^halvings parts of a range, together.
template <class Part>
Integrals over_panels(Range range, int halvings, const Part& part) {
  constexpr int kMostPanels = 4;  // halvings
  const int count = 1 << std::min(halvings, kMostPanels);
  Integrals out{};
  for (int k = 0; k < count; ++k) {
    out = out + part(Range{range.at(static_cast<double>(k) / count),
                           range.at(static_cast<double>(k + 1) / count)});
  }
  return out;
}

/// Over a part of a line of constant u or v.
template <std::size_t N>
Integrals across_line(const NurbsSurface& surface, Vec3 origin, double t, Range range, bool at_u,
                      Rule<N>) {
  const auto others = nodes<N>(range);
  const std::array<double, 1> fixed = {t};
  std::array<SurfacePoint, N> points;
  if (at_u) {
    evaluate_raster(surface, fixed, others, points);
  } else {
    evaluate_raster(surface, others, fixed, points);
  }
  Integrals out{};
  for (std::size_t j = 0; j < N; ++j) {
    const double w = 0.5 * range.length() * weight<N>(j);
    const Integrals here = integrands(points[j], origin);
    for (std::size_t k = 0; k < kIntegrals; ++k) out[k] += w * here[k];
  }
  return out;
}

/// A range halved until 4 and 8 points agree; what lies across it is halved as often.
template <class Part>
Sum refined(Range range, const Integrals& small, const Part& part, int halvings = 0) {
  const Integrals rough = part(range, Rule<4>{}, halvings);
  const Integrals fine = part(range, Rule<8>{}, halvings);
  Sum out{fine, {}};
  bool enough = true;
  for (std::size_t i = 0; i < kIntegrals; ++i) {
    out.error[i] = std::abs(fine[i] - rough[i]);
    enough = enough && out.error[i] <= small[i];
  }
  if (enough) return out;
  const double middle = range.at(0.5);
  const std::array<Range, 2> halves = {Range{range.from, middle}, Range{middle, range.to}};
  const Integrals both =
      part(halves[0], Rule<8>{}, halvings + 1) + part(halves[1], Rule<8>{}, halvings + 1);
  enough = true;
  for (std::size_t i = 0; i < kIntegrals; ++i) {
    out.error[i] = std::abs(fine[i] - both[i]);
    enough = enough && out.error[i] <= small[i];
  }
  out.value = both;
  if (enough || halvings >= kMostHalvingsOfParts) return out;
  Sum halved = refined(halves[0], small, part, halvings + 1);
  halved.add(refined(halves[1], small, part, halvings + 1));
  return halved;
}

}  // namespace obvid::afloat
