// SPDX-License-Identifier: Apache-2.0
#include "fit/excursion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <variant>

#include "fit/parts.h"
#include "obvid/certify/internal/crossings.h"
#include "obvid/core/internal/figures.h"

namespace obvid::pipeline_detail {
namespace {

/// Twice the distance of the farthest point from the middle of all.
double reach_across(const std::vector<Vec2>& points) {
  Vec2 sum;
  for (const Vec2& p : points) sum = sum + (p - points.front());
  const Vec2 middle = points.front() + sum / static_cast<double>(points.size());
  double radius = 0.0;
  for (const Vec2& p : points) radius = std::max(radius, norm(p - middle));
  return 2.0 * radius;
}

/// No place of a piece is farther from its start: the hull of its control points, or its length.
double reach_of(const Piece& piece) {
  struct Reach {
    double operator()(const LinePiece& p) const { return norm(p.end - p.start); }
    double operator()(const ArcPiece& p) const { return p.length; }
    double operator()(const ClothoidPiece& p) const { return p.length; }
    double operator()(const RationalBezier& p) const {
      double most = 0.0;
      for (std::size_t j = 1; j <= static_cast<std::size_t>(p.degree); ++j) {
        most = std::max(most, norm(p.offset[j] - p.offset[0]));
      }
      return most;
    }
  };
  return std::visit(Reach{}, piece);
}

/// Farthest place of a part from the nearer one of its ends.
double distance_of(const Contour& contour, const Part& part, Vec2 from, Vec2 to) {
  constexpr int kPlaces = 16;
  double most = 0.0;
  for (std::size_t k = part.first_piece; k <= part.last_piece; ++k) {
    const double a = k == part.first_piece ? part.t0 : 0.0;
    const double b = k == part.last_piece ? part.t1 : 1.0;
    for (int i = 0; i <= kPlaces; ++i) {
      const Vec2 p = evaluate(contour.pieces[k], a + (b - a) * i / kPlaces).point;
      most = std::max(most, std::min(norm(p - from), norm(p - to)));
    }
  }
  return most;
}

}  // namespace

std::optional<std::string> warn_of_excursion(const Contour& contour, const std::vector<bool>& given,
                                             Watch& watch) {
  const double extent = reach_across(contour.points);
  double worst = extent;
  const Part* at = nullptr;
  const std::vector<Part> parts = parts_of(contour, &watch);
  for (const Part& part : parts) {
    const auto is_given = [&](std::size_t i) { return i < given.size() && given[i]; };
    if (is_given(part.from) || is_given(part.to)) continue;
    double reach = 0.0;
    for (std::size_t k = part.first_piece; k <= part.last_piece; ++k) {
      reach += reach_of(contour.pieces[k]);
    }
    if (!(reach > worst)) continue;
    const double away =
        distance_of(contour, part, contour.points[part.from], contour.points[part.to]);
    if (!(away > worst)) continue;
    worst = away;
    at = &part;
  }
  if (at == nullptr) return std::nullopt;
  return fmt::format(
      "between points {} and {} the contour runs {} {} away from both, {} times as far as all "
      "points lie apart: they leave open what happens there; points in between, a heading there or "
      "a corner say what is meant",
      at->from + 1, at->to + 1, significant(worst, 3), contour.units.text(),
      significant(worst / extent, 2));
}

std::optional<std::string> warn_of_crossings(const Contour& contour,
                                             const Certificate& certificate) {
  const int found = certificate.self_intersections;
  if (found == 0 || found <= count_crossings_of_chords(contour.points, contour.closed)) {
    return std::nullopt;
  }
  return fmt::format(
      "the contour crosses itself {}, more often than the chords between its points: no outline of "
      "a part does; points in between, less --noise or a corner say what is meant",
      found == 1 ? "once" : fmt::format("{} times", found));
}

}  // namespace obvid::pipeline_detail
