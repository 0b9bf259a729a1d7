// SPDX-License-Identifier: Apache-2.0
#include "bezier_rows.h"

#include "obvid/curve/internal/blossom.h"

namespace obvid {
namespace {

/// Weights of the control points of span k in its Bezier point number `part`.
BezierRow row_of(int degree, const std::vector<double>& knots, std::size_t k, int part) {
  const auto p = static_cast<std::size_t>(degree);
  return {k - p, blossom_weights<kMaxNurbsDegree + 1>(knots, k, p, static_cast<std::size_t>(part),
                                                      knots[k + 1], knots[k])};
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
