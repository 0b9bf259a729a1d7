// SPDX-License-Identifier: Apache-2.0
#include "drawing.h"

#include <algorithm>
#include <map>
#include <numbers>

namespace judge {

std::optional<double> metres_of(const std::string& unit) {
  static const std::map<std::string, double> kMetres = {
      {"um", 1e-6},   {"mm", 1e-3},    {"cm", 1e-2},     {"dm", 0.1},
      {"m", 1.0},     {"km", 1e3},     {"in", 0.0254},   {"inch", 0.0254},
      {"ft", 0.3048}, {"yd", 0.9144},  {"mi", 1609.344}, {"usft", 1200.0 / 3937.0},
      {"nm", 1e-9},   {"mil", 2.54e-5}};
  const auto found = kMetres.find(unit);
  if (found == kMetres.end()) return std::nullopt;
  return found->second;
}

namespace {

struct Weighted {
  Vec p;  ///< times w
  Real w;
};

/// Control points of the Bezier span on knots [k, k+1], by blossoming (de Boor with mixed
/// arguments).
std::vector<Weighted> blossomed(int degree, const std::vector<Real>& knots,
                                const std::vector<Weighted>& points, std::size_t k) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<Weighted> out;
  for (std::size_t j = 0; j <= p; ++j) {
    std::vector<Weighted> d(points.begin() + static_cast<std::ptrdiff_t>(k - p),
                            points.begin() + static_cast<std::ptrdiff_t>(k + 1));
    for (std::size_t r = 1; r <= p; ++r) {
      const Real u = r <= j ? knots[k + 1] : knots[k];
      for (std::size_t i = p; i >= r; --i) {
        const std::size_t at = k - p + i;
        const Real a = (u - knots[at]) / (knots[at + p + 1 - r] - knots[at]);
        d[i] = {(1.0L - a) * d[i - 1].p + a * d[i].p, (1.0L - a) * d[i - 1].w + a * d[i].w};
      }
    }
    out.push_back(d[p]);
  }
  return out;
}

}  // namespace

std::vector<Span> spans_of_nurbs(int degree, const std::vector<Real>& knots,
                                 const std::vector<Vec>& points, const std::vector<Real>& weights) {
  std::vector<Span> out;
  const auto p = static_cast<std::size_t>(degree);
  if (points.size() < p + 1 || knots.size() != points.size() + p + 1) return out;
  std::vector<Weighted> homogeneous;
  for (std::size_t i = 0; i < points.size(); ++i) {
    homogeneous.push_back({weights[i] * points[i], weights[i]});
  }
  for (std::size_t k = p; k < points.size(); ++k) {
    if (!(knots[k + 1] > knots[k])) continue;
    std::vector<Vec> span;
    std::vector<Real> w;
    for (const Weighted& one : blossomed(degree, knots, homogeneous, k)) {
      span.push_back((1.0L / one.w) * one.p);
      w.push_back(one.w);
    }
    out.emplace_back(std::move(span), std::move(w));
  }
  return out;
}

Span arc_span(Vec centre, Real radius, Real from, Real turn) {
  const Real sense = turn < 0.0L ? -1.0L : 1.0L;
  return {centre + radius * unit_at(from), from + sense * 0.5L * std::numbers::pi_v<Real>,
          sense / radius, std::abs(turn) * radius};
}

}  // namespace judge
