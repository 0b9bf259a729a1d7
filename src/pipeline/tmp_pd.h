#pragma once
#include <algorithm>
#include <limits>
#include "obvid/curve/contour.h"
namespace obvid {
inline std::vector<double> point_distances(const Contour& c) {
  std::vector<double> d(c.points.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec2> S;
  for (auto& p : c.pieces)
    for (int k = 0; k <= 64; ++k) S.push_back(evaluate(p, k / 64.0).point);
  std::size_t lo = 0;
  (void)lo;
  for (std::size_t i = 0; i < d.size(); ++i)
    for (std::size_t j = 0; j + 1 < S.size(); ++j) {
      Vec2 u = S[j + 1] - S[j], w = c.points[i] - S[j];
      double t = dot(u, u) > 0 ? std::clamp(dot(u, w) / dot(u, u), 0.0, 1.0) : 0;
      d[i] = std::min(d[i], norm(w - t * u));
    }
  return d;
}
}  // namespace obvid
