// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kinds.h"
#include "knots.h"
#include "obvid/surface/collocation.h"

namespace obvid {
namespace {

/// Point and first derivatives of the offset.
SurfacePoint first_order(const OffsetSurface& s, double u, double v) {
  const SurfaceJet j = evaluate(s.base, u, v);
  const Vec3 area = cross(j.du, j.dv);
  const double size = norm(area);
  if (!(size > 0.0)) return {j.point, j.du, j.dv};
  const Vec3 n = area / size;
  const Vec3 area_u = cross(j.duu, j.dv) + cross(j.du, j.duv);
  const Vec3 area_v = cross(j.duv, j.dv) + cross(j.du, j.dvv);
  const auto turned = [&](Vec3 by) { return (by - dot(by, n) * n) / size; };
  return {j.point + s.distance * n, j.du + s.distance * turned(area_u),
          j.dv + s.distance * turned(area_v)};
}

/// The normal, at poles the limit from inside.
Vec3 normal_at(const NurbsSurface& base, double u, double v) {
  const Range ru = domain_u(base), rv = domain_v(base);
  const Vec3 middle_u{ru.at(0.5), rv.at(0.5), 0.0};
  for (const double inwards : {0.0, 1e-7, 1e-5, 1e-3}) {
    const double a = u + inwards * (middle_u.x - u), b = v + inwards * (middle_u.y - v);
    const SurfaceCurvature k = curvature(evaluate(base, a, b));
    if (!(k.normal == Vec3{})) return k.normal;
  }
  return {};
}

Vec3 point_at(const OffsetSurface& s, double u, double v) {
  return evaluate(s.base, u, v).point + s.distance * normal_at(s.base, u, v);
}

/// Order of continuity at an inner knot.
int order_at(const std::vector<double>& knots, int degree, double u) {
  return degree - static_cast<int>(multiplicity(knots, u));
}

/// Whether the offset's derivative along u is the same on both sides of a knot.
bool same_slopes_at(const OffsetSurface& s, double u) {
  constexpr int kSamples = 9;
  constexpr double kRounding = 1e-9;  // of the slope
  const auto [left, right] = split_u(s.base, u);
  for (int k = 0; k < kSamples; ++k) {
    const double v = domain_v(s.base).at((k + 0.5) / kSamples);
    const Vec3 a = first_order({left, s.distance}, u, v).du;
    const Vec3 b = first_order({right, s.distance}, u, v).du;
    if (norm(a - b) > kRounding * (norm(a) + norm(b))) return false;
  }
  return true;
}

constexpr int kDegree = 3;

/// Spans of the base along u, and how often its inner knots stand in a cubic as smooth as the
/// offset, which is once less than the base.
struct Frameworks {
  std::vector<double> knots;
  std::vector<int> times;
};

Frameworks framework(const OffsetSurface& s) {
  Frameworks frame;
  for (const double u : s.base.knots_u) {
    if (!frame.knots.empty() && frame.knots.back() == u) continue;
    const bool end = u == s.base.knots_u.front() || u == s.base.knots_u.back();
    const int order = end ? 0 : order_at(s.base.knots_u, s.base.degree_u, u);
    const bool smooth = !end && (order >= 2 || same_slopes_at(s, u));
    frame.knots.push_back(u);
    frame.times.push_back(end ? kDegree + 1 : order >= 3 ? 1 : smooth ? 2 : 3);
  }
  return frame;
}

std::vector<double> divided(const Frameworks& frame, int parts) {
  std::vector<double> knots;
  for (std::size_t i = 0; i < frame.knots.size(); ++i) {
    knots.insert(knots.end(), static_cast<std::size_t>(frame.times[i]), frame.knots[i]);
    for (int k = 1; k < parts && i + 1 < frame.knots.size(); ++k) {
      knots.push_back(frame.knots[i] + (frame.knots[i + 1] - frame.knots[i]) * k / parts);
    }
  }
  return knots;
}

/// Bicubic through the offset's points at the Greville abscissae of both knots.
Result<NurbsSurface> through(const OffsetSurface& s, const std::vector<double>& knots_u,
                             const std::vector<double>& knots_v) {
  const auto along_u = greville_collocation(kDegree, knots_u);
  if (!along_u) return fail(along_u.error());
  const auto along_v = greville_collocation(kDegree, knots_v);
  if (!along_v) return fail(along_v.error());
  const std::vector<double> us = greville(kDegree, knots_u), vs = greville(kDegree, knots_v);
  NurbsSurface out{kDegree, kDegree, knots_u, knots_v, {}, {}};
  out.points.resize(us.size() * vs.size());
  for (std::size_t j = 0; j < vs.size(); ++j) {
    std::vector<Vec3> row;
    for (const double u : us) row.push_back(point_at(s, u, vs[j]));
    row = along_u->matrix.solve(std::move(row));
    std::copy(row.begin(), row.end(),
              out.points.begin() + static_cast<std::ptrdiff_t>(j * us.size()));
  }
  for (std::size_t i = 0; i < us.size(); ++i) {
    std::vector<Vec3> column;
    for (std::size_t j = 0; j < vs.size(); ++j) column.push_back(out.points[j * us.size() + i]);
    column = along_v->matrix.solve(std::move(column));
    for (std::size_t j = 0; j < vs.size(); ++j) out.points[j * us.size() + i] = column[j];
  }
  return out;
}

std::vector<double> distinct(std::vector<double> knots) {
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

/// Largest errors along the lines of knots half way between them, and in the middle of cells.
struct Errors {
  double u = 0.0, v = 0.0;
};

Errors errors_of(const OffsetSurface& s, const NurbsSurface& form, const std::vector<double>& us,
                 const std::vector<double>& vs) {
  const auto error = [&](double u, double v) {
    return norm(evaluate(form, u, v).point - point_at(s, u, v));
  };
  constexpr std::array kParts = {0.25, 0.75};  // cubics err most there, and least half way
  Errors worst;
  for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      for (const double part : kParts) {
        const double u = us[i] + part * (us[i + 1] - us[i]), v = vs[j] + part * (vs[j + 1] - vs[j]);
        const double along_u = error(u, vs[j]), along_v = error(us[i], v), both = error(u, v);
        worst.u = std::max(worst.u, along_u);
        worst.v = std::max(worst.v, along_v);
        if (both > along_u + along_v) {
          worst.u = std::max(worst.u, both / 2.0);
          worst.v = std::max(worst.v, both / 2.0);
        }
      }
    }
  }
  return worst;
}

/// A plane moves as a whole.
std::optional<NurbsSurface> moved_plane(const OffsetSurface& s) {
  const Vec3 n = normal_at(s.base, domain_u(s.base).at(0.5), domain_v(s.base).at(0.5));
  if (n == Vec3{}) return std::nullopt;
  double coordinate = 0.0, height = 0.0;
  for (const Vec3& p : s.base.points) {
    coordinate = std::max({coordinate, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    height = std::max(height, std::abs(dot(p - s.base.points.front(), n)));
  }
  constexpr double kRounding = 1e-15;
  if (height > kRounding * coordinate * 4.0) return std::nullopt;
  NurbsSurface out = s.base;
  for (Vec3& p : out.points) p = p + s.distance * n;
  return out;
}

}  // namespace

SurfaceJet evaluate_kind(const OffsetSurface& s, double u, double v) {
  constexpr double kStep = 1e-5;  // of the domain: half the digits of first derivatives
  const SurfacePoint here = first_order(s, u, v);
  const Range ru = domain_u(s.base), rv = domain_v(s.base);
  const double hu = kStep * ru.length(), hv = kStep * rv.length();
  const double u0 = std::max(ru.from, u - hu), u1 = std::min(ru.to, u + hu);
  const double v0 = std::max(rv.from, v - hv), v1 = std::min(rv.to, v + hv);
  const SurfacePoint left = first_order(s, u0, v), right = first_order(s, u1, v);
  const SurfacePoint low = first_order(s, u, v0), high = first_order(s, u, v1);
  return {here.point,
          here.du,
          here.dv,
          (right.du - left.du) / (u1 - u0),
          (high.du - low.du) / (v1 - v0),
          (high.dv - low.dv) / (v1 - v0)};
}

Result<NurbsForm> nurbs_of(const OffsetSurface& s, double tolerance) {
  if (auto plane = moved_plane(s)) return NurbsForm{std::move(*plane), 0.0};
  constexpr std::size_t kMostPoints = 4'000'000;
  const Frameworks frame_u = framework(s);
  const Frameworks frame_v = framework({transposed(s.base), -s.distance});
  int parts_u = 1, parts_v = 1;
  while (true) {
    const std::vector<double> knots_u = divided(frame_u, parts_u);
    const std::vector<double> knots_v = divided(frame_v, parts_v);
    if (knots_u.size() * knots_v.size() > kMostPoints) {
      return fail(
          {ErrorCode::kToleranceNotReached,
           fmt::format("the offset by {:g} is not followed within {:g}", s.distance, tolerance), "",
           "allow a larger tolerance; an offset with cusps cannot be followed", -1, tolerance});
    }
    auto form = through(s, knots_u, knots_v);
    if (!form) return fail(form.error());
    const Errors worst = errors_of(s, *form, distinct(knots_u), distinct(knots_v));
    const double total = worst.u + worst.v;
    if (total <= tolerance) return NurbsForm{std::move(*form), total};
    // the direction that errs more is divided; both when they are alike
    if (worst.u >= worst.v / 4.0) parts_u *= 2;
    if (worst.v >= worst.u / 4.0) parts_v *= 2;
  }
}

}  // namespace obvid
