// SPDX-License-Identifier: Apache-2.0
#include "bezier_rows.h"

namespace obvid {
namespace {

/// Weights of the control points k - degree .. k in the blossom of span k at `part` times its end
/// and otherwise its start ([Ramshaw 1987]; de Boor's recurrence with these arguments).
BezierRow row_of(int degree, const std::vector<double>& knots, std::size_t k, int part) {
  const auto p = static_cast<std::size_t>(degree);
  std::array<std::array<double, kMaxNurbsDegree + 1>, kMaxNurbsDegree + 1> d{};
  for (std::size_t i = 0; i <= p; ++i) d[i][i] = 1.0;
  for (std::size_t r = 1; r <= p; ++r) {
    const double at = r <= static_cast<std::size_t>(part) ? knots[k + 1] : knots[k];
    for (std::size_t i = p; i >= r; --i) {
      const std::size_t left = k - p + i;
      const double share = (at - knots[left]) / (knots[left + p - r + 1] - knots[left]);
      for (std::size_t m = 0; m <= p; ++m) {
        d[i][m] = (1.0 - share) * d[i - 1][m] + share * d[i][m];
      }
    }
  }
  return {k - p, d[p]};
}

}  // namespace

BezierRows bezier_rows(int degree, const std::vector<double>& knots) {
  BezierRows out;
  out.degree = degree;
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t k = p; k + p + 1 < knots.size(); ++k) {
    if (!(knots[k] < knots[k + 1])) continue;
    if (out.rows.empty()) {
      out.knots.push_back(knots[k]);
      out.rows.push_back(row_of(degree, knots, k, 0));
    }
    for (int j = 1; j <= degree; ++j) out.rows.push_back(row_of(degree, knots, k, j));
    out.knots.push_back(knots[k + 1]);
  }
  return out;
}

}  // namespace obvid
