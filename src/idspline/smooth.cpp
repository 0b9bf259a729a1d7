// SPDX-License-Identifier: Apache-2.0
// Continuity of the highest derivatives: docs/methods/idspline.md, section 3.
#include "smooth.h"

#include <algorithm>
#include <cmath>

#include "obvid/numeric/internal/tridiagonal.h"
#include "obvid/numeric/internal/wide.h"
#include "small_matrix.h"

namespace obvid::idspline {
namespace {

using numeric::Wide;

constexpr std::size_t kMostOrders = 3;  // value, slope, second derivative

/// Derivative 2m - 1 - j of the unit cell at its left end (index j), by the data at the left end,
/// at the right end, and by the mean value: small integers.
struct EndDerivatives {
  using Row = std::array<double, kMostOrders>;
  std::array<Row, kMostOrders> near{}, far{};
  Row by_mean{};
};

/// One column of the table: the cell of one unit datum.
EndDerivatives::Row unit_column(int m, const NodeJet& left, const NodeJet& right,
                                double mean_value) {
  const auto power = power_coefficients(integral_cell(0.0, 1.0, m, left, right, mean_value));
  EndDerivatives::Row out{};
  for (int j = 0; j < m; ++j) {
    const int order = 2 * m - 1 - j;
    double factorial = 1.0;
    for (int k = 2; k <= order; ++k) factorial *= k;
    // integers but for the rounding of 1/3 and the like
    out[static_cast<std::size_t>(j)] =
        std::round(factorial * power[static_cast<std::size_t>(order)]);
  }
  return out;
}

EndDerivatives end_derivatives(int m) {
  EndDerivatives table;
  for (std::size_t l = 0; l < static_cast<std::size_t>(m); ++l) {
    NodeJet unit{};
    unit[l] = 1.0;
    const auto near = unit_column(m, unit, {}, 0.0), far = unit_column(m, {}, unit, 0.0);
    for (std::size_t j = 0; j < kMostOrders; ++j) {
      table.near[j][l] = near[j];
      table.far[j][l] = far[j];
    }
  }
  table.by_mean = unit_column(m, {}, {}, 1.0);
  return table;
}

/// The system for a spline whose node data from order M - K on are free. Unknowns are derivatives
/// times powers of the shorter neighbouring step, so that no row and no column depends on units.
///
/// `Real` is wider than double from degree 4 on: where neighbouring steps differ by a factor r, the
/// equations of degree 2 m lose digits like r^(2m - 2), though the spline itself does not.
template <class Real, std::size_t M, std::size_t K>
class Smoother {
 public:
  explicit Smoother(IdSpline& spline)
      : spline_(spline), last_(spline.nodes.size() - 1), table_(end_derivatives(M)) {}

  void run() {
    if (last_ < 2) return;  // no inner node
    TridiagonalSystem<SmallMatrix<Real, K>, SmallColumn<Real, K>> system(last_ - 1);
    for (std::size_t i = 1; i < last_; ++i) {
      Row row;
      add_side(i, i, i + 1, Real(1), row, row.behind);
      add_side(i, i - 1, i - 1, Real(-1), row, row.before);
      if (i == 1) {
        system.set_first(row.here, row.behind, row.right);
      } else {
        system.add(i - 1, row.before, row.here, row.behind, row.right);
      }
    }
    const auto found = system.solve();
    for (std::size_t i = 1; i < last_; ++i) store(i, found[i - 1]);
  }

 private:
  static constexpr std::size_t kFirst = M - K;

  struct Row {
    SmallMatrix<Real, K> before, here, behind;
    SmallColumn<Real, K> right;
  };

  [[nodiscard]] Real h(std::size_t i) const {
    return Real(spline_.nodes[i + 1]) - Real(spline_.nodes[i]);
  }

  /// Unit of length at a node.
  [[nodiscard]] Real scale(std::size_t i) const {
    if (i == 0) return h(0);
    return i == last_ ? h(i - 1) : std::min(h(i - 1), h(i));
  }

  std::vector<double>& data(std::size_t order) {
    return order == 0 ? spline_.values : order == 1 ? spline_.slopes : spline_.seconds;
  }

  /// Adds what cell `c` on one side of node i says about its derivatives there. The left cell is
  /// seen in the mirror, where derivatives of odd order change sign.
  void add_side(std::size_t i, std::size_t c, std::size_t other, Real side, Row& row,
                SmallMatrix<Real, K>& beyond) {
    const Real length = h(c), to_here = side * (scale(i) / length);
    // the other way round, because divisions are dear
    const Real from_here = side * (length / scale(i)), from_there = side * (length / scale(other));
    const Real mean_value = spline_.integrals[c] / length;
    const bool end = other == 0 || other == last_;
    Real weight = side;
    for (std::size_t k = 0; k < M; ++k) weight *= to_here;  // orders from M on
    for (std::size_t j = M; j-- > kFirst; weight *= to_here) {
      const std::size_t r = j - kFirst;
      Real here = weight, there = weight;
      for (std::size_t l = 0; l < M; ++l, here *= from_here, there *= from_there) {
        const Real a = here * table_.near[j][l], b = there * table_.far[j][l];
        if (l < kFirst) {
          row.right.at[r] -= a * scaled(i, l);
        } else {
          row.here.row[r][l - kFirst] += a;
        }
        if (l < kFirst || end) {
          row.right.at[r] -= b * scaled(other, l);
        } else {
          beyond.row[r][l - kFirst] += b;
        }
      }
      row.right.at[r] -= weight * table_.by_mean[j] * mean_value;
    }
  }

  [[nodiscard]] Real scaled(std::size_t node, std::size_t order) {
    Real out = data(order)[node];
    for (std::size_t k = 0; k < order; ++k) out *= scale(node);
    return out;
  }

  void store(std::size_t i, const SmallColumn<Real, K>& found) {
    for (std::size_t l = kFirst; l < M; ++l) {
      Real out = found.at[l - kFirst];
      for (std::size_t k = 0; k < l; ++k) out /= scale(i);
      data(l)[i] = static_cast<double>(out);
    }
  }

  IdSpline& spline_;
  std::size_t last_;
  EndDerivatives table_;
};

}  // namespace

void smooth(IdSpline& spline, int first_free) {
  switch (spline.degree + first_free) {
    case 2:
      return Smoother<double, 1, 1>(spline).run();
    case 4:
      return Smoother<Wide, 2, 2>(spline).run();
    case 5:
      return Smoother<Wide, 2, 1>(spline).run();
    case 6:
      return Smoother<Wide, 3, 3>(spline).run();
    case 7:
      return Smoother<Wide, 3, 2>(spline).run();
    default:
      return;
  }
}

}  // namespace obvid::idspline
