// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "kinds.h"

namespace obvid {
namespace {

/// Bezier points of cell i, j: [row along y][column along x].
using Cell = std::array<std::array<Vec3, 3>, 3>;

Cell cell_of(const IdSurface& s, std::size_t i, std::size_t j) {
  const auto x = bezier_ordinates(s.x, i, j), y = bezier_ordinates(s.y, i, j),
             z = bezier_ordinates(s.z, i, j);
  Cell cell;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) cell[r][c] = {x[r][c], y[r][c], z[r][c]};
  }
  return cell;
}

std::vector<double> double_knots(const std::vector<double>& nodes) {
  std::vector<double> knots(3, nodes.front());
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) knots.insert(knots.end(), 2, nodes[i]);
  knots.insert(knots.end(), 3, nodes.back());
  return knots;
}

/// Cells side by side: neighbours share their borders, so inner knots are double.
NurbsSurface of_cells(const IdSurface& s) {
  NurbsSurface out{2, 2, double_knots(s.x.x), double_knots(s.x.y), {}, {}};
  const std::size_t nu = out.count_u();
  out.points.resize(nu * out.count_v());
  for (std::size_t j = 0; j + 1 < s.x.y.size(); ++j) {
    for (std::size_t i = 0; i + 1 < s.x.x.size(); ++i) {
      const Cell cell = cell_of(s, i, j);
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) out.points[(2 * j + r) * nu + 2 * i + c] = cell[r][c];
      }
    }
  }
  return out;
}

/// Whether every other column of control points lies where one derivative on both sides puts it.
bool smooth_along_u(const NurbsSurface& s, const std::vector<double>& nodes) {
  constexpr double kRounding = 1e-12;  // of the size
  const double allowed = kRounding * size_of(s);
  const std::size_t nu = s.count_u();
  for (std::size_t row = 0; row < s.count_v(); ++row) {
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
      const double part = (nodes[i] - nodes[i - 1]) / (nodes[i + 1] - nodes[i - 1]);
      const Vec3* joint = s.points.data() + row * nu + 2 * i;
      const Vec3 wanted = (1.0 - part) * joint[-1] + part * joint[1];
      if (norm(*joint - wanted) > allowed) return false;
    }
  }
  return true;
}

/// A C1 surface with each inner knot once: the joints are no control points then.
NurbsSurface with_simple_knots_u(const NurbsSurface& s, const std::vector<double>& nodes) {
  NurbsSurface out{s.degree_u, s.degree_v, {}, s.knots_v, {}, {}};
  out.knots_u.assign(3, nodes.front());
  out.knots_u.insert(out.knots_u.end(), nodes.begin() + 1, nodes.end() - 1);
  out.knots_u.insert(out.knots_u.end(), 3, nodes.back());
  const std::size_t nu = s.count_u();
  for (std::size_t row = 0; row < s.count_v(); ++row) {
    for (std::size_t i = 0; i < nu; ++i) {
      const bool inner_joint = i % 2 == 0 && i > 0 && i + 1 < nu;
      if (!inner_joint) out.points.push_back(s.points[row * nu + i]);
    }
  }
  return out;
}

}  // namespace

std::array<Range, 2> ranges_of(const IdSurface& s) {
  const auto ends = [](const std::vector<double>& nodes) {
    return nodes.empty() ? Range{} : Range{nodes.front(), nodes.back()};
  };
  return {ends(s.x.x), ends(s.x.y)};
}

SurfaceJet evaluate_kind(const IdSurface& s, double u, double v) {
  const GridJet x = evaluate(s.x, u, v), y = evaluate(s.y, u, v), z = evaluate(s.z, u, v);
  return {{x.value, y.value, z.value}, {x.dx, y.dx, z.dx},    {x.dy, y.dy, z.dy},
          {x.dxx, y.dxx, z.dxx},       {x.dxy, y.dxy, z.dxy}, {x.dyy, y.dyy, z.dyy}};
}

namespace {

/// As many numbers as the nodes need, all finite, nodes ascending.
Result<void> check_spline(const IdSpline2d& s) {
  const std::size_t nx = s.x.size(), ny = s.y.size();
  const auto ascends = [](const std::vector<double>& nodes) {
    return nodes.size() >= 2 &&
           std::adjacent_find(nodes.begin(), nodes.end(),
                              [](double a, double b) { return !(b > a); }) == nodes.end();
  };
  const auto finite = [](const std::vector<double>& all) {
    return std::all_of(all.begin(), all.end(), [](double a) { return std::isfinite(a); });
  };
  if (!ascends(s.x) || !ascends(s.y)) {
    return error(ErrorCode::kBadOption, "the nodes of a spline do not ascend");
  }
  if (s.values.size() != nx * ny || s.along_x.size() != (nx - 1) * ny ||
      s.along_y.size() != nx * (ny - 1) || s.cells.size() != (nx - 1) * (ny - 1)) {
    return error(ErrorCode::kBadOption, "a spline lacks values or integrals of its grid")
        .hint("form it by id_spline_2d");
  }
  for (const auto* all : {&s.x, &s.y, &s.values, &s.along_x, &s.along_y, &s.cells}) {
    if (!finite(*all)) {
      return error(ErrorCode::kNotFinite, "a number of a spline is not finite");
    }
  }
  return {};
}

}  // namespace

Result<NurbsForm> nurbs_of(const IdSurface& s, double) {
  for (const IdSpline2d* spline : {&s.x, &s.y, &s.z}) {
    OBVID_TRY(check_spline(*spline));
  }
  if (!(s.x.x == s.y.x && s.x.x == s.z.x && s.x.y == s.y.y && s.x.y == s.z.y)) {
    return error(ErrorCode::kBadOption, "the three splines do not stand over one grid");
  }
  NurbsSurface surface = of_cells(s);
  if (smooth_along_u(surface, s.x.x)) surface = with_simple_knots_u(surface, s.x.x);
  surface = transposed(surface);
  if (smooth_along_u(surface, s.x.y)) surface = with_simple_knots_u(surface, s.x.y);
  return NurbsForm{transposed(surface), 0.0};
}

}  // namespace obvid
