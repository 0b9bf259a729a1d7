// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/internal/match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kinds.h"

namespace obvid {
namespace {

NurbsSurface reversed_along_v(const NurbsSurface& s) {
  return transposed(reversed_u(transposed(s)));
}

/// Turned so that the side lies at v = 0 and runs along u; and back.
NurbsSurface side_first(const NurbsSurface& s, PatchSide side) {
  NurbsSurface out = runs_along_u(side) ? s : transposed(s);
  return is_far_end(side) ? reversed_along_v(out) : out;
}
NurbsSurface side_back(const NurbsSurface& s, PatchSide side) {
  const NurbsSurface out = is_far_end(side) ? reversed_along_v(s) : s;
  return runs_along_u(side) ? out : transposed(out);
}

using BorderRows = std::array<std::vector<Vec3>, 3>;

/// Control points of the border, and of both derivatives across it by v, in the first `order` + 1.
BorderRows border_rows(const NurbsSurface& s, int order) {
  const std::size_t n = s.count_u();
  const auto q = static_cast<std::size_t>(s.degree_v);
  const auto at = [&](std::size_t i, std::size_t j) { return s.points[j * n + i]; };
  const double degree = s.degree_v;
  const double k1 = s.knots_v[q + 1] - s.knots_v.front();
  BorderRows out;
  for (std::size_t i = 0; i < n; ++i) {
    out[0].push_back(at(i, 0));
    if (order < 1) continue;
    const Vec3 first = (degree / k1) * (at(i, 1) - at(i, 0));
    out[1].push_back(first);
    if (order < 2) continue;
    if (q < 2) {
      out[2].push_back({});
      continue;
    }
    const double k2 = s.knots_v[q + 2] - s.knots_v.front();
    out[2].push_back((degree - 1.0) / k1 * ((degree / k2) * (at(i, 2) - at(i, 1)) - first));
  }
  return out;
}

/// The rows of control points that have these derivatives.
void put_rows(const BorderRows& rows, int order, NurbsSurface& s) {
  const std::size_t n = s.count_u();
  const auto q = static_cast<std::size_t>(s.degree_v);
  const double degree = s.degree_v;
  const double k1 = s.knots_v[q + 1] - s.knots_v.front();
  for (std::size_t i = 0; i < n; ++i) {
    s.points[i] = rows[0][i];
    if (order < 1) continue;
    s.points[n + i] = rows[0][i] + (k1 / degree) * rows[1][i];
    if (order < 2) continue;
    const double k2 = s.knots_v[q + 2] - s.knots_v.front();
    s.points[2 * n + i] =
        s.points[n + i] + (k2 / degree) * (rows[1][i] + (k1 / (degree - 1.0)) * rows[2][i]);
  }
}

/// The rows as a surface whose knots across are those of another, to be refined along with it.
NurbsSurface carrying(const BorderRows& rows, int order, const NurbsSurface& from,
                      const NurbsSurface& like) {
  NurbsSurface out{from.degree_u, like.degree_v, from.knots_u, like.knots_v, {}, {}};
  for (std::size_t j = 0; j < like.count_v(); ++j) {
    const auto& row = rows[j <= static_cast<std::size_t>(order) ? j : 0];
    out.points.insert(out.points.end(), row.begin(), row.end());
  }
  return out;
}

double share(const std::vector<Vec3>& of, const std::vector<Vec3>& by) {
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < of.size(); ++i) {
    product += dot(of[i], by[i]);
    square += dot(by[i], by[i]);
  }
  return square > 0.0 ? product / square : 0.0;
}

/// Whether the other border runs the other way; those that close have to begin at the same place.
Result<bool> runs_back(const NurbsSurface& mine, const NurbsSurface& other) {
  const auto at = [](const NurbsSurface& s, double u) { return evaluate(s, u, 0.0).point; };
  const Vec3 a = at(mine, 0.0), b = at(mine, 1.0), c = at(other, 0.0), d = at(other, 1.0);
  const Vec3 half = at(mine, 0.5), other_half = at(other, 0.5);
  constexpr double kCloses = 1e-9;  // of half its way across
  const bool closes = norm(b - a) <= kCloses * norm(half - a);
  const bool other_closes = norm(d - c) <= kCloses * norm(other_half - c);
  if (closes != other_closes) {
    return error(ErrorCode::kUnsupported, "one of the borders closes and the other does not")
        .hint("name sides of which both do, or neither");
  }
  if (!closes) return norm(a - d) + norm(b - c) < norm(a - c) + norm(b - d);
  for (const double u : {0.25, 0.5, 0.75}) {
    if (norm(a - at(other, u)) >= norm(a - c)) continue;
    return error(ErrorCode::kUnsupported, "the borders close at places that lie apart")
        .hint("let both patches begin at the same place of the ring")
        .value(norm(a - c));
  }
  const Vec3 quarter = at(mine, 0.25);
  return norm(quarter - at(other, 0.75)) < norm(quarter - at(other, 0.25));
}

Result<void> check_side(const SideOfPatch& one) {
  OBVID_TRY(check(one.surface));
  if (!one.surface.weights.empty()) {
    return error(ErrorCode::kUnsupported, "borders of rational patches are not matched");
  }
  return {};
}

}  // namespace

Result<MatchedSurface> matched(const SideOfPatch& patch, const SideOfPatch& to, int order) {
  if (order < 0 || order > 2) return error(ErrorCode::kBadOption, "the order has to be 0, 1 or 2");
  OBVID_TRY(check_side(patch));
  OBVID_TRY(check_side(to));
  const Range unit_range{0.0, 1.0};
  NurbsSurface mine = with_domain(side_first(patch.surface, patch.side), unit_range, unit_range);
  NurbsSurface other = with_domain(side_first(to.surface, to.side), unit_range, unit_range);
  const auto back = runs_back(mine, other);
  OBVID_TRY(back);
  if (*back) other = reversed_u(other);
  const auto needed = static_cast<std::size_t>(2 * (order + 1));
  while (mine.count_v() < needed) mine = with_degrees(mine, mine.degree_u, mine.degree_v + 1);
  std::vector<NurbsSurface> both{mine, carrying(border_rows(other, order), order, other, mine)};
  make_alike(both);
  const NurbsSurface before = both[0];
  const std::size_t n = before.count_u();
  const auto row = [&](std::size_t j) {
    const auto begin = both[1].points.begin() + static_cast<std::ptrdiff_t>(j * n);
    return std::vector<Vec3>(begin, begin + static_cast<std::ptrdiff_t>(n));
  };
  const BorderRows had = border_rows(before, order);
  BorderRows rows;
  MatchedSurface out;
  for (int k = 0; k <= order; ++k)
    rows[static_cast<std::size_t>(k)] = row(static_cast<std::size_t>(k));
  if (order >= 1) {
    const std::vector<Vec3> first = rows[1];
    out.pace = share(had[1], first);
    if (!(out.pace < 0.0)) {
      return error(ErrorCode::kSurfaceFolds,
                   "beside its border the patch lies over the other one, not beyond it")
          .hint("name other sides, or match the position alone: G0")
          .value(out.pace);
    }
    for (Vec3& one : rows[1]) one = out.pace * one;
    if (order >= 2) {
      std::vector<Vec3> left = had[2];
      for (std::size_t i = 0; i < n; ++i) {
        rows[2][i] = out.pace * out.pace * rows[2][i];
        left[i] = left[i] - rows[2][i];
      }
      const double along = share(left, first);
      for (std::size_t i = 0; i < n; ++i) rows[2][i] = rows[2][i] + along * first[i];
    }
  }
  NurbsSurface after = before;
  put_rows(rows, order, after);
  for (std::size_t i = 0; i < after.points.size(); ++i) {
    out.moved = std::max(out.moved, norm(after.points[i] - before.points[i]));
  }
  // control point j reaches up to knot j + degree + 1
  out.reach = after.knots_v[static_cast<std::size_t>(order + after.degree_v + 1)];
  const Range u = domain_u(patch.surface), v = domain_v(patch.surface);
  out.surface = with_domain(side_back(after, patch.side), u, v);
  OBVID_TRY(check(out.surface));
  return out;
}

}  // namespace obvid
