// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/curve/internal/homogeneous.h"
#include "obvid/curve/internal/knots.h"
#include "obvid/surface/nurbs_surface.h"

namespace obvid {
namespace {

/// Row j of the net as a line along u.
Line row_of(const NurbsSurface& s, std::size_t j) {
  Line line{s.degree_u, s.knots_u, Polygon(s.count_u())};
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    line.points[i] = lifted(s.points, s.weights, j * s.count_u() + i);
  }
  return line;
}

/// The surface after each of its rows went through `change`, which treats all rows alike.
template <class Change>
NurbsSurface with_rows(const NurbsSurface& s, const Change& change) {
  NurbsSurface out{s.degree_u, s.degree_v, {}, s.knots_v, {}, {}};
  const bool rational = !s.weights.empty();
  for (std::size_t j = 0; j < s.count_v(); ++j) {
    const Line row = change(row_of(s, j));
    out.degree_u = row.degree;
    if (j == 0) out.knots_u = row.knots;
    for (const Vec4& p : row.points) {
      out.points.push_back(rational ? dropped(p) : numerator(p));
      if (rational) out.weights.push_back(p.w);
    }
  }
  return out;
}

/// Rows of the net that belong to control points first .. last of a split along v.
NurbsSurface rows_between(const NurbsSurface& s, std::size_t first, std::size_t last,
                          std::vector<double> knots_v) {
  const auto a = static_cast<std::ptrdiff_t>(first * s.count_u());
  const auto b = static_cast<std::ptrdiff_t>((last + 1) * s.count_u());
  NurbsSurface out{s.degree_u, s.degree_v, s.knots_u, std::move(knots_v), {}, {}};
  out.points.assign(s.points.begin() + a, s.points.begin() + b);
  if (!s.weights.empty()) out.weights.assign(s.weights.begin() + a, s.weights.begin() + b);
  return out;
}

/// Coefficients of one direction's B-splines, of the other's lines: the curve at a parameter.
SpaceCurve curve_along_u(const NurbsSurface& s, double v) {
  const BasisValues b = basis_at(s.degree_v, s.knots_v, v, 0);
  SpaceCurve curve{s.degree_u, s.knots_u, {}, {}};
  for (std::size_t i = 0; i < s.count_u(); ++i) {
    Vec4 sum;
    for (std::size_t j = 0; j <= static_cast<std::size_t>(s.degree_v); ++j) {
      sum = sum + b.value[0][j] * lifted(s.points, s.weights, (b.first + j) * s.count_u() + i);
    }
    curve.points.push_back(s.weights.empty() ? numerator(sum) : dropped(sum));
    if (!s.weights.empty()) curve.weights.push_back(sum.w);
  }
  return curve;
}

}  // namespace

SpaceCurve isocurve_at_v(const NurbsSurface& surface, double v) {
  return curve_along_u(surface, v);
}

SpaceCurve isocurve_at_u(const NurbsSurface& surface, double u) {
  return curve_along_u(transposed(surface), u);
}

NurbsSurface transposed(const NurbsSurface& s) {
  NurbsSurface out{s.degree_v, s.degree_u, s.knots_v, s.knots_u, {}, {}};
  out.points.reserve(s.points.size());
  out.weights.reserve(s.weights.size());
  for (std::size_t i = 0; i < s.count_u(); ++i) {
    for (std::size_t j = 0; j < s.count_v(); ++j) {
      out.points.push_back(s.points[j * s.count_u() + i]);
      if (!s.weights.empty()) out.weights.push_back(s.weights[j * s.count_u() + i]);
    }
  }
  return out;
}

NurbsSurface reversed_u(const NurbsSurface& s) {
  NurbsSurface out = s;
  out.knots_u = reversed(SpaceCurve{s.degree_u, s.knots_u, {}, {}}).knots;
  const auto nu = static_cast<std::ptrdiff_t>(s.count_u());
  for (auto row = out.points.begin(); row != out.points.end(); row += nu)
    std::reverse(row, row + nu);
  for (auto row = out.weights.begin(); row != out.weights.end(); row += nu) {
    std::reverse(row, row + nu);
  }
  return out;
}

NurbsSurface with_knots_u(const NurbsSurface& surface, const std::vector<double>& new_knots) {
  if (new_knots.empty()) return surface;
  return with_rows(surface, [&](const Line& row) { return inserted(row, new_knots); });
}

NurbsSurface with_knots_v(const NurbsSurface& surface, const std::vector<double>& new_knots) {
  return transposed(with_knots_u(transposed(surface), new_knots));
}

NurbsSurface with_degrees(const NurbsSurface& surface, int degree_u, int degree_v) {
  NurbsSurface out = surface;
  const auto raise = [](const Line& row) { return raised(row); };
  while (out.degree_u < degree_u) out = with_rows(out, raise);
  if (out.degree_v >= degree_v) return out;
  out = transposed(out);
  while (out.degree_u < degree_v) out = with_rows(out, raise);
  return transposed(out);
}

NurbsSurface with_domain(const NurbsSurface& surface, Range u, Range v) {
  NurbsSurface out = surface;
  out.knots_u = mapped(surface.knots_u, u.from, u.to);
  out.knots_v = mapped(surface.knots_v, v.from, v.to);
  return out;
}

std::array<NurbsSurface, 2> split_v(const NurbsSurface& surface, double v) {
  const auto p = static_cast<std::size_t>(surface.degree_v);
  const std::size_t have = multiplicity(surface.knots_v, v);
  const NurbsSurface cut = with_knots_v(surface, std::vector<double>(p - std::min(p, have), v));
  const auto first = std::lower_bound(cut.knots_v.begin(), cut.knots_v.end(), v);
  const auto joint = static_cast<std::size_t>(first - cut.knots_v.begin()) - 1;
  std::vector<double> before(cut.knots_v.begin(), first + static_cast<std::ptrdiff_t>(p));
  before.push_back(v);
  std::vector<double> after{v};
  after.insert(after.end(), first, cut.knots_v.end());
  return {rows_between(cut, 0, joint, std::move(before)),
          rows_between(cut, joint, cut.count_v() - 1, std::move(after))};
}

std::array<NurbsSurface, 2> split_u(const NurbsSurface& surface, double u) {
  const auto [before, after] = split_v(transposed(surface), u);
  return {transposed(before), transposed(after)};
}

}  // namespace obvid
