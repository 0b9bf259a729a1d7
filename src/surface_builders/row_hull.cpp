// SPDX-License-Identifier: Apache-2.0
#include "row_hull.h"

#include <algorithm>

#include "obvid/curve/internal/blossom.h"

namespace obvid {
namespace {

/// Shares of the coefficients of a span that begins with knot number `s` in Bezier point number j
/// of [a, b], both of the span.
std::array<double, kMostLineDegree + 1> shares_of_blossom(int degree,
                                                          const std::vector<double>& knots,
                                                          std::size_t s, std::size_t j, double a,
                                                          double b) {
  const auto p = static_cast<std::size_t>(degree);
  return blossom_weights<kMostLineDegree + 1>(knots, s, p, p - j, a, b);
}

/// Parameter at a part of a span.
double place_in(const std::vector<double>& knots, std::size_t s, std::size_t part,
                std::size_t parts) {
  if (part == parts) return knots[s + 1];
  const double share = static_cast<double>(part) / static_cast<double>(parts);
  return knots[s] + share * (knots[s + 1] - knots[s]);
}

}  // namespace

void RowHull::add_places(int degree, const std::vector<double>& knots, std::size_t per_span) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t count = knots.size() - p - 1;
  for (std::size_t s = p; s < count; ++s) {
    if (!(knots[s + 1] > knots[s])) continue;
    const std::size_t places = s + 1 == count ? per_span + 1 : per_span;
    for (std::size_t i = 0; i < places; ++i) {
      const double at = place_in(knots, s, i, per_span);
      mixes_.push_back({width_ + s - p, p + 1, shares_of_blossom(degree, knots, s, 0, at, at)});
    }
  }
  width_ += count;
}

void RowHull::add_pieces(int degree, const std::vector<double>& knots, std::size_t per_span) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t count = knots.size() - p - 1;
  for (std::size_t s = p; s < count; ++s) {
    if (!(knots[s + 1] > knots[s])) continue;
    for (std::size_t i = 0; i < per_span; ++i) {
      const double a = place_in(knots, s, i, per_span), b = place_in(knots, s, i + 1, per_span);
      // the last point is the next piece's first, but at the end and where the spline jumps
      const bool ends = s + 1 == count || knots[s + 1 + p] == knots[s + 1];
      const std::size_t points = ends && i + 1 == per_span ? p + 1 : p;
      for (std::size_t j = 0; j < points; ++j) {
        mixes_.push_back({width_ + s - p, p + 1, shares_of_blossom(degree, knots, s, j, a, b)});
      }
    }
  }
  width_ += count;
}

void RowHull::add_points(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) mixes_.push_back({width_ + i, 1, {1.0}});
  width_ += count;
}

double RowHull::longest_squared(const double* row, double negligible) const {
  double most = 0.0;
  for (const double* p = row; p < row + 3 * width_ && negligible > 0.0; p += 3) {
    most = std::max(most, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  }
  if (negligible > 0.0 && most <= negligible * negligible) return most;
  most = 0.0;
  for (const Mix& mix : mixes_) {
    double x = 0.0, y = 0.0, z = 0.0;
    const double* at = row + 3 * mix.first;
    for (std::size_t k = 0; k < mix.count; ++k) {
      x += mix.share[k] * at[3 * k];
      y += mix.share[k] * at[3 * k + 1];
      z += mix.share[k] * at[3 * k + 2];
    }
    most = std::max(most, x * x + y * y + z * z);
  }
  return most;
}

}  // namespace obvid
