// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "kinds.h"
#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/basis.h"
#include "obvid/curve/internal/knots.h"
#include "obvid/surface/internal/collocation.h"
#include "third_order.h"

namespace obvid {
namespace {

/// Whether du x dv is rounding: at poles and collapsed edges it is not exactly 0.
bool vanishes(const NurbsSurface& base, Vec3 point, Vec3 du, Vec3 dv) {
  constexpr double kRounding = 1e-13;  // of the coordinates, in a derivative over the whole domain
  const double lu = domain_u(base).length(), lv = domain_v(base).length();
  const double coordinates = norm(point) + lu * norm(du) + lv * norm(dv);
  return norm(cross(du, dv)) <= kRounding * coordinates * (norm(du) / lv + norm(dv) / lu);
}

/// The normal; where du x dv vanishes its limit from inside, zero where there is none.
Vec3 normal_at(const NurbsSurface& base, double u, double v, const SurfaceJet& jet) {
  const Vec3 area = cross(jet.du, jet.dv);
  if (!vanishes(base, jet.point, jet.du, jet.dv)) return unit(area);
  // du x dv grows from 0 towards the middle of the domain: its derivative that way
  const double to_u = domain_u(base).at(0.5) - u, to_v = domain_v(base).at(0.5) - v;
  const Vec3 by_u = cross(jet.duu, jet.dv) + cross(jet.du, jet.duv);
  const Vec3 by_v = cross(jet.duv, jet.dv) + cross(jet.du, jet.dvv);
  const Vec3 inwards = to_u * by_u + to_v * by_v;
  constexpr double kFlat = 1e-10;  // below this part of its terms the derivative vanishes too
  const double terms =
      std::abs(to_u) * (norm(jet.duu) * norm(jet.dv) + norm(jet.du) * norm(jet.duv)) +
      std::abs(to_v) * (norm(jet.duv) * norm(jet.dv) + norm(jet.du) * norm(jet.dvv));
  if (norm(inwards) > kFlat * terms) return unit(inwards);
  constexpr std::array kBesidePole = {1e-5, 1e-3};  // of the way inwards, nearest first
  for (const double part : kBesidePole) {           // poles of higher order: near them, not in them
    const double a = u + part * to_u, b = v + part * to_v;
    const SurfaceJet near = evaluate(base, a, b);
    if (!vanishes(base, near.point, near.du, near.dv)) return unit(cross(near.du, near.dv));
  }
  return {};
}

Vec3 point_at(const OffsetSurface& s, double u, double v) {
  const SurfaceJet jet = evaluate(s.base, u, v);
  return jet.point + s.distance * normal_at(s.base, u, v, jet);
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
    const Vec3 a = evaluate_kind(OffsetSurface{left, s.distance}, u, v).du;
    const Vec3 b = evaluate_kind(OffsetSurface{right, s.distance}, u, v).du;
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

tl::unexpected<Error> no_normal(double u, double v) {
  return error(ErrorCode::kBadOption,
               fmt::format("the surface has no normal at u = {:g}, v = {:g}", u, v))
      .hint("an offset needs a surface that does not collapse");
}

/// Bicubic through the offset's points at the Greville abscissae of both knots.
Result<NurbsSurface> through_offset(const OffsetSurface& s, const std::vector<double>& knots_u,
                                    const std::vector<double>& knots_v) {
  const auto along_u = greville_collocation(kDegree, knots_u);
  OBVID_TRY(along_u);
  const auto along_v = greville_collocation(kDegree, knots_v);
  OBVID_TRY(along_v);
  const std::vector<double> us = greville(kDegree, knots_u), vs = greville(kDegree, knots_v);
  NurbsSurface out{kDegree, kDegree, knots_u, knots_v, {}, {}};
  out.points.resize(us.size() * vs.size());
  for (std::size_t j = 0; j < vs.size(); ++j) {
    std::vector<Vec3> row;
    for (const double u : us) {
      const SurfaceJet jet = evaluate(s.base, u, vs[j]);
      const Vec3 normal = normal_at(s.base, u, vs[j], jet);
      if (normal == Vec3{}) return no_normal(u, vs[j]);
      row.push_back(jet.point + s.distance * normal);
    }
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

std::vector<double> offset_samples(const std::vector<double>& lines) {
  std::vector<double> at;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      at.push_back(lines[i] + part * (lines[i + 1] - lines[i]));
    }
  }
  return at;
}

/// Largest error on a raster in each cell, with what it may rise between the samples.
double offset_error(const OffsetSurface& s, const NurbsSurface& form, const std::vector<double>& us,
                    const std::vector<double>& vs) {
  constexpr double kBetween = 1.1;  // quartics rise by less between the samples
  const std::vector<double> raster_u = offset_samples(us), raster_v = offset_samples(vs);
  std::vector<SurfacePoint> row(raster_u.size());
  double worst = 0.0;
  for (const double v : raster_v) {
    evaluate_raster(form, raster_u, std::span(&v, 1), row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      worst = std::max(worst, norm(row[i].point - point_at(s, raster_u[i], v)));
    }
  }
  return kBetween * worst;
}

/// A plane moves as a whole.
std::optional<NurbsSurface> moved_plane(const OffsetSurface& s) {
  const double u = domain_u(s.base).at(0.5), v = domain_v(s.base).at(0.5);
  const Vec3 n = normal_at(s.base, u, v, evaluate(s.base, u, v));
  if (n == Vec3{}) return std::nullopt;
  double coordinate = 0.0, height = 0.0;
  for (const Vec3& p : s.base.points) {
    coordinate = std::max({coordinate, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    height = std::max(height, std::abs(dot(p - s.base.points.front(), n)));
  }
  constexpr double kRounding = 1e-15;  // of the coordinate: a height of nothing
  if (height > kRounding * coordinate * 4.0) return std::nullopt;
  NurbsSurface out = s.base;
  for (Vec3& p : out.points) p = p + s.distance * n;
  return out;
}

}  // namespace

SurfaceJet evaluate_kind(const OffsetSurface& s, double u, double v) {
  const Partials p = partials_to_third(s.base, u, v);
  if (vanishes(s.base, p[0][0], p[1][0], p[0][1])) {
    return {point_at(s, u, v), p[1][0], p[0][1], p[2][0], p[1][1], p[0][2]};
  }
  const Partials n = partials_of_unit(partials_of_area(p));
  const auto moved = [&](std::size_t r, std::size_t q) { return p[r][q] + s.distance * n[r][q]; };
  return {moved(0, 0), moved(1, 0), moved(0, 1), moved(2, 0), moved(1, 1), moved(0, 2)};
}

Result<NurbsForm> nurbs_of(const OffsetSurface& s, double tolerance) {
  OBVID_TRY(check(s.base));
  if (!std::isfinite(s.distance)) {
    return error(ErrorCode::kNotFinite, "the distance of the offset is not finite");
  }
  if (auto plane = moved_plane(s)) return NurbsForm{std::move(*plane), 0.0};
  constexpr std::size_t kMostPoints = 1'000'000;
  constexpr int kMostStalls = 4;  // divisions that hardly help: something is not smooth
  constexpr double kHelps = 0.7;  // smooth ones leave 1/16, first ones more
  const Frameworks frame_u = framework(s);
  const Frameworks frame_v = framework({transposed(s.base), -s.distance});
  int parts_u = 1, parts_v = 1, stalls = 0;
  double before = std::numeric_limits<double>::infinity();
  struct {
    NurbsSurface form;
    std::vector<double> us, vs;
    double total = std::numeric_limits<double>::infinity();
  } nearest;
  while (tolerance > 0.0 && stalls < kMostStalls) {
    const std::vector<double> knots_u = divided(frame_u, parts_u);
    const std::vector<double> knots_v = divided(frame_v, parts_v);
    if (knots_u.size() * knots_v.size() > kMostPoints) break;
    auto form = through_offset(s, knots_u, knots_v);
    OBVID_TRY(form);
    const std::vector<double> us = distinct(knots_u), vs = distinct(knots_v);
    const Errors worst = errors_of(s, *form, us, vs);
    const double total = worst.u + worst.v;
    if (total <= tolerance) {
      const double deviation = offset_error(s, *form, us, vs);
      if (deviation <= tolerance) return NurbsForm{std::move(*form), deviation};
    }
    if (total < nearest.total) nearest = {std::move(*form), us, vs, total};
    stalls = total > kHelps * before ? stalls + 1 : 0;
    before = total;
    // the direction that errs more is divided; both when they are alike
    if (worst.u >= worst.v / 4.0) parts_u *= 2;
    if (worst.v >= worst.u / 4.0) parts_v *= 2;
  }
  double reached = nearest.total;  // as what is accepted is measured
  if (std::isfinite(reached)) {
    reached = std::max(reached, offset_error(s, nearest.form, nearest.us, nearest.vs));
  }
  return error(ErrorCode::kToleranceNotReached,
               fmt::format("the offset by {} is followed within {}, not {:g}", s.distance,
                           significant_above(reached, 3), tolerance))
      .hint(fmt::format("a tolerance of {} is reached; near the distance at which it folds and at "
                        "creases of the surface an offset is torn",
                        significant_above(reached, 3)))
      .value(reached);
}

}  // namespace obvid
