// SPDX-License-Identifier: Apache-2.0
#include "offset_raster.h"

#include <algorithm>
#include <cmath>

#include "climb.h"
#include "obvid/curve/internal/basis.h"

namespace obvid {
namespace {

/// Below this, times coordinates over the square of the size, a curvature is flat: over the whole
/// surface it makes an arc as high as 1e-11 of the coordinates, which data do not carry.
constexpr double kFlat = 1e-10;

/// Most that rounding adds to second derivatives, part of coordinates / span^2: some units in the
/// last place of sums of 16 and of quotients of weights.
constexpr double kBasisRounding = 1e-14;

double span_length(int degree, const std::vector<double>& knots, double u) {
  const std::size_t k = span_at(degree, knots, u);
  return knots[k + 1] - knots[k];
}

}  // namespace

Bending::Bending(const NurbsSurface& surface) : surface_(surface) {
  const double size = size_of(surface);
  coordinates_ = size;
  for (const Vec3& p : surface.points) coordinates_ = std::max(coordinates_, norm(p));
  flat_ = kFlat * coordinates_ / (size * size);
}

Bending::Sides Bending::at(double u, double v) const {
  const SurfaceJet jet = evaluate(surface_, u, v);
  const double area = norm(cross(jet.du, jet.dv));
  const double across_u = area / norm(jet.dv), across_v = area / norm(jet.du);
  const SurfaceCurvature bent = curvature(jet);
  const double most = std::max(std::abs(bent.k1), std::abs(bent.k2));
  if (!(most > flat_)) return {};
  const double hu = across_u * span_length(surface_.degree_u, surface_.knots_u, u);
  const double hv = across_v * span_length(surface_.degree_v, surface_.knots_v, v);
  const double rounding = kBasisRounding * coordinates_ * (1.0 / (hu * hu) + 1.0 / (hv * hv));
  // a lower bound, so that nothing climbs on rounding, which has no bound at poles
  const auto sure = [&](double k) { return k > flat_ && k > rounding ? k - rounding : 0.0; };
  return {sure(bent.k1), sure(-bent.k2)};
}

double Bending::at(double u, double v, int side) const {
  const Sides sides = at(u, v);
  return side > 0 ? sides.along : sides.against;
}

Bend Bending::climbed(Bend from, double step_u, double step_v, int side, const Range& u,
                      const Range& v) const {
  constexpr int kMostSteps = 400;
  const Peak top =
      obvid::climbed([&](double at_u, double at_v) { return at(at_u, at_v, side); },
                     {from.value, {from.u, step_u, u}, {from.v, step_v, v}}, kMostSteps);
  return {top.u.at, top.v.at, top.value};
}

std::size_t span_count(const std::vector<double>& knots) {
  std::size_t count = 0;
  for (std::size_t k = 1; k < knots.size(); ++k) count += knots[k] > knots[k - 1] ? 1 : 0;
  return count;
}

std::vector<double> raster_parameters(const std::vector<double>& knots, int degree,
                                      std::size_t steps) {
  constexpr double kBefore = 1e-6;  // part of the span: near enough for the limit from the left
  std::vector<double> at;
  at.reserve(span_count(knots) * (steps + 1) + 1);
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const Range span{knots[k - 1], knots[k]};
    if (!(span.length() > 0.0)) continue;
    for (std::size_t i = 0; i < steps; ++i) {
      at.push_back(span.at(static_cast<double>(i) / static_cast<double>(steps)));
    }
    const auto [first, last] = std::equal_range(knots.begin(), knots.end(), span.to);
    if (last != knots.end() && last - first > degree - 2) at.push_back(span.at(1.0 - kBefore));
  }
  at.push_back(knots.back());
  return at;
}

}  // namespace obvid
