// SPDX-License-Identifier: Apache-2.0
// Gordon surfaces of nets of curves: crossings, order, common parameters.
#include "obvid/surface_builders/internal/network.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "network_crossing.h"
#include "network_curves.h"
#include "network_side.h"
#include "obvid/geom/internal/box.h"

namespace obvid {
namespace {

/// Curves that meet this well, part of the size of the net, are said to agree.
constexpr double kAgree = 1e-9;

NetSide side_of(const std::vector<SpaceCurve>& curves, std::string kind, std::size_t others,
                double tolerance) {
  NetSide side;
  side.kind = std::move(kind);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    side.curves.push_back(with_domain(curves[i], {0.0, 1.0}));
    side.number.push_back(i);
    side.is_pole.push_back(is_point(curves[i], tolerance) ? 1 : 0);
    side.at.emplace_back(others, 0.0);
  }
  return side;
}

Error missed(const NetSide& first, const NetSide& second, std::size_t i, std::size_t j,
             double distance, double tolerance) {
  return error(ErrorCode::kBadOption,
               fmt::format("{} misses {} by {:g}, the tolerance is {:g}", first.name(i),
                           second.name(j), distance, tolerance))
      .hint("each curve of one kind has to cross each curve of the other")
      .point(i)
      .value(distance);
}

std::vector<BoxedCurve> boxed(const NetSide& side) {
  return {side.curves.begin(), side.curves.end()};
}

Result<void> find_crossings(NetSide& first, NetSide& second, double tolerance) {
  const std::vector<BoxedCurve> a = boxed(first), b = boxed(second);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Crossing crossing = nearest_points(a[i], b[j]);
      if (!(crossing.distance <= tolerance)) {
        return fail(missed(first, second, i, j, crossing.distance, tolerance));
      }
      first.at[i][j] = crossing.s;
      second.at[j][i] = crossing.t;
    }
  }
  return {};
}

double size_of(const NetSide& side) { return bounding_diagonal(side.curves, &SpaceCurve::points); }

CrossingPoints points_at(const NetSide& side, const std::vector<double>& parameters) {
  CrossingPoints points;
  for (const SpaceCurve& c : side.curves) {
    std::vector<Vec3>& row = points.emplace_back();
    for (const double u : parameters) row.push_back(evaluate(c, u).point);
  }
  return points;
}

CrossingPoints points_at_own(const NetSide& side) {
  CrossingPoints points;
  for (std::size_t i = 0; i < side.curves.size(); ++i) {
    std::vector<Vec3>& row = points.emplace_back();
    for (const double u : side.at[i]) row.push_back(evaluate(side.curves[i], u).point);
  }
  return points;
}

CrossingPoints transposed(const CrossingPoints& points) {
  CrossingPoints turned(points[0].size());
  for (const std::vector<Vec3>& row : points) {
    for (std::size_t j = 0; j < row.size(); ++j) turned[j].push_back(row[j]);
  }
  return turned;
}

double farthest(const CrossingPoints& a, const CrossingPoints& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a[i].size(); ++j) {
      worst = std::max(worst, norm(a[i][j] - b[i][j]));
    }
  }
  return worst;
}

CrossingPoints middles(CrossingPoints a, const CrossingPoints& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a[i].size(); ++j) a[i][j] = 0.5 * (a[i][j] + b[i][j]);
  }
  return a;
}

Result<void> rebuild(NetSide& side, const std::vector<double>& parameters,
                     const CrossingPoints& points, double tolerance) {
  Result<std::vector<SpaceCurve>> curves = rebuilt(side, parameters, points, tolerance);
  OBVID_TRY(curves);
  side.curves = std::move(*curves);
  return {};
}

/// Curves get the common parameters and points at the crossings; those that have them stay.
Result<void> make_agree(NetSide& first, NetSide& second, const std::vector<double>& u,
                        const std::vector<double>& v, double tolerance) {
  const double agree = kAgree * std::max(size_of(first), size_of(second));
  const CrossingPoints own_first = points_at_own(first), at_first = points_at(first, u);
  const CrossingPoints own_second = transposed(points_at_own(second));
  const CrossingPoints at_second = transposed(points_at(second, v));
  if (farthest(at_first, at_second) <= agree) return {};
  if (farthest(at_first, own_first) <= agree) {
    return rebuild(second, v, transposed(at_first), tolerance);
  }
  if (farthest(at_second, own_second) <= agree) return rebuild(first, u, at_second, tolerance);
  const CrossingPoints points = middles(own_first, own_second);
  OBVID_TRY(rebuild(first, u, points, tolerance));
  return rebuild(second, v, transposed(points), tolerance);
}

Result<void> check_net(const std::vector<SpaceCurve>& first, const std::vector<SpaceCurve>& second,
                       double tolerance) {
  OBVID_TRY(check_tolerance(tolerance));
  if (first.size() < 2 || second.size() < 2) {
    return error(ErrorCode::kTooFewCurves,
                 fmt::format("a net has two curves of each kind at least, not {} and {}",
                             first.size(), second.size()))
        .value(static_cast<double>(std::min(first.size(), second.size())));
  }
  OBVID_TRY(check_curves(first, " of the first kind"));
  return check_curves(second, " of the second kind");
}

Result<void> arrange(NetSide& first, NetSide& second, double tolerance) {
  OBVID_TRY(find_crossings(first, second, tolerance));
  OBVID_TRY(open_at_seam(first, second, tolerance));
  OBVID_TRY(open_at_seam(second, first, tolerance));
  OBVID_TRY(put_in_order(first, second));
  OBVID_TRY(put_in_order(second, first));
  trim(first, tolerance);
  trim(second, tolerance);
  return {};
}

}  // namespace

Result<GordonSurface> gordon_from(const std::vector<SpaceCurve>& first,
                                  const std::vector<SpaceCurve>& second, double tolerance) {
  OBVID_TRY(check_net(first, second, tolerance));
  NetSide along_u = side_of(first, "of the first kind", second.size(), tolerance);
  NetSide along_v = side_of(second, "of the second kind", first.size(), tolerance);
  OBVID_TRY(arrange(along_u, along_v, tolerance));
  std::vector<double> u = mean_parameters(along_u), v = mean_parameters(along_v);
  OBVID_TRY(make_agree(along_u, along_v, u, v, tolerance));
  return GordonSurface{std::move(along_u.curves), std::move(along_v.curves), std::move(v),
                       std::move(u)};
}

}  // namespace obvid
