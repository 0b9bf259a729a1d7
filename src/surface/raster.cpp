// SPDX-License-Identifier: Apache-2.0
// Many points of a surface: each row of parameters first condenses the net into two lines of
// control points, for the point and for dv; each point then costs one line's B-splines.
#include <algorithm>
#include <cmath>

#include "obvid/curve/internal/basis.h"
#include "obvid/curve/internal/homogeneous.h"

#include "obvid/surface/nurbs_surface.h"

namespace obvid {
namespace {

/// First control point and the B-splines with their first derivatives at one parameter.
template <std::size_t Orders>
struct Column {
  std::size_t first = 0;
  std::array<double, Orders> value{};
  std::array<double, Orders> slope{};
};

template <std::size_t Orders>
std::vector<Column<Orders>> columns_of(const NurbsSurface& s, std::span<const double> us) {
  std::vector<Column<Orders>> columns(us.size());
  for (std::size_t i = 0; i < us.size(); ++i) {
    const BasisValues basis = basis_at(s.degree_u, s.knots_u, us[i], 1);
    columns[i].first = basis.first;
    for (std::size_t j = 0; j < Orders; ++j) {
      columns[i].value[j] = basis.value[0][j];
      columns[i].slope[j] = basis.value[1][j];
    }
  }
  return columns;
}

/// Control points along u at one v: of the surface and of its derivative by v.
struct Lines {
  Polygon here;
  Polygon slope;
};

void condense(const NurbsSurface& s, double v, std::size_t from, std::size_t to, Lines& lines) {
  const BasisValues b = basis_at(s.degree_v, s.knots_v, v, 1);
  const auto begin = static_cast<std::ptrdiff_t>(from), end = static_cast<std::ptrdiff_t>(to);
  std::fill(lines.here.begin() + begin, lines.here.begin() + end, Vec4{});
  std::fill(lines.slope.begin() + begin, lines.slope.begin() + end, Vec4{});
  const std::size_t nu = s.count_u();
  for (std::size_t j = 0; j <= static_cast<std::size_t>(s.degree_v); ++j) {
    const double value = b.value[0][j], slope = b.value[1][j];
    const std::size_t row = (b.first + j) * nu;
    for (std::size_t i = from; i < to; ++i) {
      const Vec4 p = lifted(s.points, s.weights, row + i);
      lines.here[i] = lines.here[i] + value * p;
      lines.slope[i] = lines.slope[i] + slope * p;
    }
  }
}

struct Sums {
  Vec4 point, du, dv;
};

template <std::size_t Orders>
Sums sums_at(const Column<Orders>& column, std::size_t orders, const Lines& lines) {
  Sums sum;
  const Vec4* here = lines.here.data() + column.first;
  const Vec4* slope = lines.slope.data() + column.first;
  for (std::size_t j = 0; j < orders; ++j) {
    sum.point = sum.point + column.value[j] * here[j];
    sum.du = sum.du + column.slope[j] * here[j];
    sum.dv = sum.dv + column.value[j] * slope[j];
  }
  return sum;
}

SurfacePoint polynomial(const Sums& sum) {
  return {numerator(sum.point), numerator(sum.du), numerator(sum.dv)};
}

SurfacePoint rational(const Sums& sum) {
  const double w = 1.0 / sum.point.w;
  const Vec3 point = w * numerator(sum.point);
  return {point, w * (numerator(sum.du) - sum.du.w * point),
          w * (numerator(sum.dv) - sum.dv.w * point)};
}

template <std::size_t Orders>
void raster(const NurbsSurface& s, std::span<const double> us, std::span<const double> vs,
            std::span<SurfacePoint> out) {
  const std::vector<Column<Orders>> columns = columns_of<Orders>(s, us);
  const auto orders = std::min(Orders, static_cast<std::size_t>(s.degree_u) + 1);
  std::size_t from = s.count_u(), to = 0;
  for (const Column<Orders>& c : columns) {
    from = std::min(from, c.first);
    to = std::max(to, c.first + orders);
  }
  Lines lines{Polygon(s.count_u()), Polygon(s.count_u())};
  const bool weighted = !s.weights.empty();
  for (std::size_t j = 0; j < vs.size(); ++j) {
    condense(s, vs[j], from, to, lines);
    SurfacePoint* row = out.data() + j * us.size();
    for (std::size_t i = 0; i < us.size(); ++i) {
      const Sums sum =
          Orders <= 4 ? sums_at(columns[i], Orders, lines) : sums_at(columns[i], orders, lines);
      row[i] = weighted ? rational(sum) : polynomial(sum);
    }
  }
}

}  // namespace

void evaluate_raster(const NurbsSurface& surface, std::span<const double> us,
                     std::span<const double> vs, std::span<SurfacePoint> out) {
  if (us.empty() || vs.empty()) return;
  if (surface.degree_u == 3) {
    raster<4>(surface, us, vs, out);
  } else {
    raster<kMaxNurbsDegree + 1>(surface, us, vs, out);
  }
}

std::vector<SurfacePoint> evaluate_raster(const NurbsSurface& surface, std::span<const double> us,
                                          std::span<const double> vs) {
  std::vector<SurfacePoint> out(us.size() * vs.size());
  evaluate_raster(surface, us, vs, out);
  return out;
}

}  // namespace obvid
