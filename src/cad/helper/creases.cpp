// SPDX-License-Identifier: Apache-2.0
#include "creases.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace obvid::cad {
namespace {

constexpr double kSmooth = 1e-6;     // rad: a jump of the normal below is rounding of the points
constexpr double kNoNormal = 1e-12;  // sine between du and dv: no normal to compare

/// Inner knots that stand as often as the degree.
std::vector<double> full_knots(int degree, const std::vector<double>& knots) {
  std::vector<double> out;
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t k = p + 1; k + 2 * p + 1 <= knots.size(); ++k) {
    if (knots[k] == knots[k + p - 1]) {
      out.push_back(knots[k]);
      k += p - 1;
    }
  }
  return out;
}

/// Two places in each span: a crease over less than a span is none of a tensor product.
std::vector<double> samples(const std::vector<double>& knots) {
  std::vector<double> out;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const double a = knots[k - 1], b = knots[k];
    if (!(a < b)) continue;
    for (const double part : {0.25, 0.75}) out.push_back(a + part * (b - a));
  }
  return out;
}

bool jumps(const SurfacePoint& a, const SurfacePoint& b) {
  const Vec3 m = cross(a.du, a.dv), n = cross(b.du, b.dv);
  if (norm(m) <= kNoNormal * norm(a.du) * norm(a.dv)) return false;
  if (norm(n) <= kNoNormal * norm(b.du) * norm(b.dv)) return false;
  return norm(unit(m) - unit(n)) > kSmooth;
}

bool is_crease(const NurbsSurface& before, const NurbsSurface& after) {
  const std::vector<double> vs = samples(before.knots_v);
  const std::vector<double> end = {domain_u(before).to}, start = {domain_u(after).from};
  const auto a = evaluate_raster(before, end, vs), b = evaluate_raster(after, start, vs);
  for (std::size_t i = 0; i < vs.size(); ++i) {
    if (jumps(a[i], b[i])) return true;
  }
  return false;
}

std::vector<NurbsSurface> cut_along_u(NurbsSurface rest) {
  std::vector<NurbsSurface> out;
  for (const double knot : full_knots(rest.degree_u, rest.knots_u)) {
    auto halves = split_u(rest, knot);
    if (!is_crease(halves[0], halves[1])) continue;
    out.push_back(std::move(halves[0]));
    rest = std::move(halves[1]);
  }
  out.push_back(std::move(rest));
  return out;
}

}  // namespace

std::vector<NurbsSurface> without_creases(const NurbsSurface& surface, std::size_t most) {
  std::vector<NurbsSurface> out;
  for (const NurbsSurface& strip : cut_along_u(surface)) {
    if (full_knots(strip.degree_v, strip.knots_v).empty()) {
      out.push_back(strip);
    } else {
      for (const NurbsSurface& part : cut_along_u(transposed(strip))) {
        out.push_back(transposed(part));
      }
    }
    if (out.size() > most) return {};
  }
  return out;
}

}  // namespace obvid::cad
