// SPDX-License-Identifier: Apache-2.0
#include "patch_sampler.h"

#include <algorithm>
#include <cmath>

namespace obvid::mesh {
namespace {

/// Derivatives that are smaller than this part of the greatest one count as zero (a pole, a
/// collapsed edge): files of 8 digits leave so much of a point.
constexpr double kNoDerivative = 1e-7;
/// Sine of the angle of du and dv below which their product has no direction worth its digits.
constexpr double kParallel = 1e-7;
/// Steps off a pole in parts of the span, on which the limit of the normal is read.
constexpr double kStepsOffPole[] = {1e-5, 1e-3, 1e-2};

/// Distance from 0, in sizes of the surface, at which derivatives lose digits worth the trouble.
constexpr double kFar = 64.0;

struct Sums {
  Vec3 point, du, dv;
  double w = 0.0, wu = 0.0, wv = 0.0;
};

SurfacePoint divided(const Sums& s, Vec3 origin) {
  const double w = 1.0 / s.w;
  const Vec3 point = w * s.point;
  return {origin + point, w * (s.du - s.wu * point), w * (s.dv - s.wv * point)};
}

double greatest_step(const NurbsSurface& s, bool along_u) {
  const std::size_t nu = s.count_u(), nv = s.count_v();
  const std::size_t step = along_u ? 1 : nu;
  double greatest = 0.0;
  for (std::size_t j = 0; j + (along_u ? 0 : 1) < nv; ++j) {
    for (std::size_t i = 0; i + (along_u ? 1 : 0) < nu; ++i) {
      const std::size_t k = j * nu + i;
      greatest = std::max(greatest, norm(s.points[k + step] - s.points[k]));
    }
  }
  return greatest;
}

/// Where to sum from: 0 unless the surface is far from it, then a round number nearby, so that
/// differences from it are exact and so are control points put together again.
double round_origin(double coordinate, double size) {
  if (!(std::fabs(coordinate) > kFar * size) || !(size > 0.0)) return 0.0;
  const double step = std::exp2(std::ceil(std::log2(size)));
  return step * std::round(coordinate / step);
}

Place stepped(const PatchAxis& axis, const Place& from, double part) {
  const double low = axis.end(from.span), high = axis.end(from.span + 1);
  const bool up = from.t - low < high - from.t;
  return {from.span, from.t + (up ? part : -part) * (high - low)};
}

}  // namespace

PatchSampler::PatchSampler(const NurbsSurface& surface)
    : surface_(surface),
      u_(surface.degree_u, surface.knots_u),
      v_(surface.degree_v, surface.knots_v),
      count_u_(surface.count_u()),
      weighted_(!surface.weights.empty()),
      least_du_(kNoDerivative * greatest_step(surface, true) / (u_.to() - u_.from())),
      least_dv_(kNoDerivative * greatest_step(surface, false) / (v_.to() - v_.from())) {
  const Vec3 first = surface.points.front();
  const double size = size_of(surface);
  origin_ = {round_origin(first.x, size), round_origin(first.y, size), round_origin(first.z, size)};
}

SurfacePoint PatchSampler::at(const Place& u, const Place& v) const {
  const SpanBasis bu = u_.basis(u), bv = v_.basis(v);
  const auto pu = static_cast<std::size_t>(u_.degree()), pv = static_cast<std::size_t>(v_.degree());
  Sums sum;
  for (std::size_t j = 0; j <= pv; ++j) {
    const std::size_t row = (bv.first + j) * count_u_ + bu.first;
    Vec3 here, slope;
    double w = 0.0, wu = 0.0;
    for (std::size_t i = 0; i <= pu; ++i) {
      const double weight = weighted_ ? surface_.weights[row + i] : 1.0;
      const double value = weight * bu.value[i], rise = weight * bu.slope[i];
      const Vec3 p = surface_.points[row + i] - origin_;
      here = here + value * p;
      slope = slope + rise * p;
      w += value;
      wu += rise;
    }
    sum.point = sum.point + bv.value[j] * here;
    sum.du = sum.du + bv.value[j] * slope;
    sum.dv = sum.dv + bv.slope[j] * here;
    sum.w += bv.value[j] * w;
    sum.wu += bv.value[j] * wu;
    sum.wv += bv.slope[j] * w;
  }
  return weighted_ ? divided(sum, origin_) : SurfacePoint{origin_ + sum.point, sum.du, sum.dv};
}

bool PatchSampler::is_regular(const SurfacePoint& p) const {
  const double du = dot(p.du, p.du), dv = dot(p.dv, p.dv);
  const Vec3 n = cross(p.du, p.dv);
  return du > least_du_ * least_du_ && dv > least_dv_ * least_dv_ &&
         dot(n, n) > kParallel * kParallel * du * dv;
}

Sample PatchSampler::sample(const Place& u, const Place& v) const {
  const SurfacePoint p = at(u, v);
  return {p.point, normal_at(p, u, v)};
}

// At a pole the limit depends on where one comes from: first across the collapsed edge (a cone's
// apex has a normal for each u), then along both.
Vec3 PatchSampler::normal_at(const SurfacePoint& p, const Place& u, const Place& v) const {
  if (is_regular(p)) return unit(cross(p.du, p.dv));
  for (const double step : kStepsOffPole) {
    const Place near_u = stepped(u_, u, step), near_v = stepped(v_, v, step);
    for (const auto& [a, b] :
         {std::pair{u, near_v}, std::pair{near_u, v}, std::pair{near_u, near_v}}) {
      const SurfacePoint q = at(a, b);
      if (is_regular(q)) return unit(cross(q.du, q.dv));
    }
  }
  return {};
}

void PatchSampler::condense(const SpanBasis& b, std::size_t from, std::size_t to) {
  const std::size_t n = to - from;
  here_.assign(n, {});
  slope_.assign(n, {});
  if (weighted_) {
    here_w_.assign(n, 0.0);
    slope_w_.assign(n, 0.0);
  }
  for (std::size_t j = 0; j <= static_cast<std::size_t>(v_.degree()); ++j) {
    const std::size_t row = (b.first + j) * count_u_ + from;
    for (std::size_t i = 0; i < n; ++i) {
      const double weight = weighted_ ? surface_.weights[row + i] : 1.0;
      const double value = weight * b.value[j], rise = weight * b.slope[j];
      const Vec3 p = surface_.points[row + i] - origin_;
      here_[i] = here_[i] + value * p;
      slope_[i] = slope_[i] + rise * p;
      if (!weighted_) continue;
      here_w_[i] += value;
      slope_w_[i] += rise;
    }
  }
}

SurfacePoint PatchSampler::on_lines(const SpanBasis& b, std::size_t from) const {
  Sums sum;
  const std::size_t first = b.first - from;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(u_.degree()); ++i) {
    sum.point = sum.point + b.value[i] * here_[first + i];
    sum.du = sum.du + b.slope[i] * here_[first + i];
    sum.dv = sum.dv + b.value[i] * slope_[first + i];
    if (!weighted_) continue;
    sum.w += b.value[i] * here_w_[first + i];
    sum.wu += b.slope[i] * here_w_[first + i];
    sum.wv += b.value[i] * slope_w_[first + i];
  }
  return weighted_ ? divided(sum, origin_) : SurfacePoint{origin_ + sum.point, sum.du, sum.dv};
}

void PatchSampler::block(std::span<const Place> us, std::span<const Place> vs,
                         std::vector<Sample>& out) {
  columns_.clear();
  for (const Place& u : us) columns_.push_back(u_.basis(u));
  const std::size_t from = columns_.front().first;
  const std::size_t to = columns_.back().first + static_cast<std::size_t>(u_.degree()) + 1;
  out.resize(us.size() * vs.size());
  Sample* next = out.data();
  for (const Place& v : vs) {
    condense(v_.basis(v), from, to);
    for (std::size_t i = 0; i < us.size(); ++i) {
      const SurfacePoint p = on_lines(columns_[i], from);
      *next++ = {p.point, normal_at(p, us[i], v)};
    }
  }
}

}  // namespace obvid::mesh
