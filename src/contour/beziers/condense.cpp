// SPDX-License-Identifier: Apache-2.0
// One condensation: docs/methods/beziers.md, sections 1 and 2.
#include <algorithm>
#include <cmath>

#include "obvid/contour/beziers.h"
#include "obvid/numeric/internal/golden.h"
#include "obvid/region/internal/convex_triangle.h"

namespace obvid {
namespace {

/// The triangle of a link, its start at the origin, and what is wanted of the chain.
struct Triangle {
  Vec2 start, chord, u, v;            ///< u, v: unit tangents
  double a = 0.0, b = 0.0;            ///< sides, from the start and to the end
  double height = 0.0;                ///< of the apex over the chord
  double kappa0 = 0.0, kappa1 = 0.0;  ///< wanted, in size
  bool grows = false;                 ///< radii grow from start to end
};

std::optional<Triangle> triangle_of(const Element& start, const Element& end, int direction) {
  const bool left = start.kappa > 0.0;
  if (start.kappa == 0.0 || end.kappa == 0.0 || left != (end.kappa > 0.0)) return std::nullopt;
  const Vec2 u = unit_at(start.theta), v = unit_at(end.theta);
  const auto t = tangent_triangle(start.point, u, end.point, v);
  if (!t || (t->side < 0) != left) return std::nullopt;  // a left turn has its apex on the right
  const bool grows = (direction > 0) != left;
  return Triangle{
      start.point,           end.point - start.point, u,    v, t->to_apex, t->from_apex, t->height,
      std::abs(start.kappa), std::abs(end.kappa),     grows};
}

/// Where a parallel to the base cuts the sides of a triangle (counted from the base) so that the
/// parabolas on both sides of the cut have `factor` times the radii of the whole one at its ends:
/// 2 m^2 / (1 - m) = factor.
double cut_for(double factor) { return 0.25 * (std::sqrt(factor * (factor + 8.0)) - factor); }

using Chain = std::array<std::array<Vec2, 3>, 4>;

/// The first tangent: its legs on both sides of where it touches, and the factors of radii that the
/// second cuts have to bring.
struct FirstCut {
  double before = 0.0, behind = 0.0, k1 = 0.0, k2 = 0.0;
};

FirstCut first_cut(const Triangle& t, double cut) {
  // legs such that the curvatures of both sides agree where it touches
  const double q = std::cbrt(t.kappa0 / t.kappa1) * (t.a / t.b);
  const double width = (1.0 - cut) * norm(t.chord);
  const double c = cut * t.a, f = cut * t.b, rise = cut * t.height;
  FirstCut out;
  out.before = width * q / (1.0 + q);
  out.behind = width / (1.0 + q);
  out.k1 = out.before * rise / (2.0 * t.kappa0 * c * c * c);
  out.k2 = out.behind * rise / (2.0 * t.kappa1 * f * f * f);
  return out;
}

/// Control points of the four parabolas when the first tangent cuts the sides at `cut`.
Chain chain_at(const Triangle& t, double cut) {
  const Vec2 along = t.chord / norm(t.chord);
  const auto [before, behind, k1, k2] = first_cut(t, cut);
  const double c = cut * t.a, f = cut * t.b;
  const double m1 = cut_for(k1);
  const double m2 = cut_for(k2);
  const Vec2 touch = c * t.u + before * along;
  const Vec2 x1 = (m1 * c) * t.u, y1 = touch - (m1 * before) * along;
  const Vec2 x2 = touch + (m2 * behind) * along, y2 = t.chord - (m2 * f) * t.v;
  const Vec2 z1 = 0.5 * (x1 + y1), z2 = 0.5 * (x2 + y2);
  return {{{Vec2{}, x1, z1}, {z1, y1, touch}, {touch, x2, z2}, {z2, y2, t.chord}}};
}

/// Sapidis and Frey's condition with the direction: the leg beside the smaller radius, seen along
/// the other, must not be longer than it.
double margin_of(const Triangle& t, const Chain& chain) {
  double least = HUGE_VAL;
  for (const auto& p : chain) {
    const Vec2 a = p[1] - p[0], b = p[2] - p[1];
    const Vec2 shorter = t.grows ? a : b;
    least = std::min(least, dot(a, b) / dot(shorter, shorter) - 1.0);
  }
  return least;
}

/// Cut with the largest margin: the best of a coarse row, then golden sections around it.
double best_cut(const Triangle& t) {
  constexpr double kFrom = 0.2, kTo = 0.8;
  constexpr int kRow = 12;
  constexpr double kFoundTo = 1e-9;  // below the sensitivity of a flat maximum
  const auto margin = [&](double cut) { return margin_of(t, chain_at(t, cut)); };
  const double step = (kTo - kFrom) / kRow;
  double best = 0.5;
  for (int i = 0; i <= kRow; ++i) {
    const double cut = kFrom + i * step;
    if (margin(cut) > margin(best)) best = cut;
  }
  return highest_place(best - step, best + step, margin, kFoundTo);
}

}  // namespace

std::optional<Condensation> condense(const Element& start, const Element& end, int direction) {
  const auto t = triangle_of(start, end, direction);
  if (!t) return std::nullopt;
  Condensation out;
  out.cut = best_cut(*t);
  const Chain chain = chain_at(*t, out.cut);
  out.margin = margin_of(*t, chain);
  if (!(out.margin > 0.0)) return std::nullopt;
  const FirstCut cut = first_cut(*t, out.cut);
  out.k1 = cut.k1;
  out.k2 = cut.k2;
  out.shift = 0.5 * (cut.before - cut.behind);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    RationalBezier& piece = out.parabolas[i];
    piece.origin = t->start;
    piece.degree = 2;
    std::copy(chain[i].begin(), chain[i].end(), piece.offset.begin());
    std::fill_n(piece.weight.begin(), 3, 1.0);
  }
  return out;
}

}  // namespace obvid
