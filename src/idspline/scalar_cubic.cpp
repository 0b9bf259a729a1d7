// SPDX-License-Identifier: Apache-2.0
// Cubic splines for comparison: docs/methods/idspline.md, section 5.
#include "obvid/idspline/internal/scalar_cubic.h"

#include <algorithm>
#include <utility>

#include "checks.h"
#include "integrate.h"
#include "local_polynomial.h"
#include "obvid/numeric/internal/tridiagonal.h"

namespace obvid {
namespace {

using System = TridiagonalSystem<double, double>;

/// Linear in one unknown that stands apart.
struct LinearIn {
  double value = 0.0, by = 0.0;
};
LinearIn operator*(double a, const LinearIn& b) { return {a * b.value, a * b.by}; }
LinearIn operator-(const LinearIn& a, const LinearIn& b) {
  return {a.value - b.value, a.by - b.by};
}

/// Length and mean slope of a cell.
struct Step {
  double h, slope;
};

Step step(const ScalarCubic& s, std::size_t i) {
  const double h = s.nodes[i + 1] - s.nodes[i];
  return {h, (s.values[i + 1] - s.values[i]) / h};
}

std::optional<Error> refuse_cubic(const ScalarCubic& s) {
  if (auto error = idspline::refuse_nodes(s.nodes)) return error;
  return idspline::refuse_data(s.values, s.nodes.size(), "value");
}

Result<ScalarCubic> checked(ScalarCubic s) {
  if (auto error = idspline::refuse_overflow(s.slopes, "slope")) return fail(std::move(*error));
  return s;
}

/// Derivative at the first or last node: the given one, or that of the cubic through four nodes.
double end_derivative(const ScalarCubic& s, bool last, int order,
                      const std::optional<double>& given) {
  if (given) return *given;
  const std::size_t n = s.nodes.size(), count = std::min<std::size_t>(n, 4);
  const auto c = idspline::local_polynomial(s.nodes, s.values, last ? n - count : 0, count,
                                            last ? s.nodes.back() : s.nodes.front());
  return order == 2 ? 2.0 * c[2] : c[1];
}

/// Solves `row(before, after)` at each inner node between given first and last unknowns.
template <class AddRow>
std::vector<double> solve(const ScalarCubic& s, double first, double last, const AddRow& add_row) {
  const std::size_t n = s.nodes.size();
  System system(n);
  system.set_first(1.0, 0.0, first);
  for (std::size_t i = 1; i + 1 < n; ++i) add_row(system, i, step(s, i - 1), step(s, i));
  system.add(n - 1, 0.0, 1.0, 0.0, last);
  return system.solve();
}

}  // namespace

Result<ScalarCubic> local_cubic(std::vector<double> nodes, std::vector<double> values) {
  ScalarCubic s{std::move(nodes), std::move(values), {}};
  if (auto error = refuse_cubic(s)) return fail(std::move(*error));
  constexpr int kParabolaDegree = 2;
  s.slopes = idspline::local_derivatives(s.nodes, s.values, kParabolaDegree, 1);
  return checked(std::move(s));
}

Result<ScalarCubic> global_cubic_by_slopes(std::vector<double> nodes, std::vector<double> values,
                                           const CubicEnds& ends) {
  ScalarCubic s{std::move(nodes), std::move(values), {}};
  if (auto error = refuse_cubic(s)) return fail(std::move(*error));
  const auto row = [](System& system, std::size_t i, const Step& a, const Step& b) {
    system.add(i, b.h, 2.0 * (a.h + b.h), a.h, 3.0 * (b.h * a.slope + a.h * b.slope));
  };
  s.slopes =
      solve(s, end_derivative(s, false, 1, ends.start), end_derivative(s, true, 1, ends.end), row);
  return checked(std::move(s));
}

Result<ScalarCubic> global_cubic_by_seconds(std::vector<double> nodes, std::vector<double> values,
                                            const CubicEnds& ends) {
  ScalarCubic s{std::move(nodes), std::move(values), {}};
  if (auto error = refuse_cubic(s)) return fail(std::move(*error));
  const auto row = [](System& system, std::size_t i, const Step& a, const Step& b) {
    system.add(i, a.h, 2.0 * (a.h + b.h), b.h, 6.0 * (b.slope - a.slope));
  };
  const auto seconds =
      solve(s, end_derivative(s, false, 2, ends.start), end_derivative(s, true, 2, ends.end), row);
  const std::size_t last = s.nodes.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {  // (16) at the nearest end of a cell
    const Step c = step(s, std::min(i, last - 1));
    s.slopes.push_back(i < last ? c.slope - c.h / 6.0 * (2.0 * seconds[i] + seconds[i + 1])
                                : c.slope + c.h / 6.0 * (seconds[i - 1] + 2.0 * seconds[i]));
  }
  return checked(std::move(s));
}

Result<ScalarCubic> periodic_cubic(std::vector<double> nodes, std::vector<double> values) {
  ScalarCubic s{std::move(nodes), std::move(values), {}};
  if (!s.values.empty()) s.values.back() = s.values.front();
  if (auto error = refuse_cubic(s)) return fail(std::move(*error));
  const std::size_t cells = s.nodes.size() - 1;
  if (cells == 1) {
    s.slopes = {0.0, 0.0};
    return s;
  }
  // (14) at each node, around; the last slope stands apart, and all others are linear in it
  struct Row {
    double before, here, behind, right;
  };
  const auto row = [&](std::size_t i) {
    const Step a = step(s, (i + cells - 1) % cells), b = step(s, i);
    return Row{b.h, 2.0 * (a.h + b.h), a.h, 3.0 * (b.h * a.slope + a.h * b.slope)};
  };
  const std::size_t last = cells - 1;
  TridiagonalSystem<double, LinearIn> system(last);
  for (std::size_t i = 0; i < last; ++i) {
    const Row r = row(i);
    const double of_last = (i == 0 ? r.before : 0.0) + (i + 1 == last ? r.behind : 0.0);
    if (i == 0)
      system.set_first(r.here, r.behind, {r.right, -of_last});
    else
      system.add(i, r.before, r.here, r.behind, {r.right, -of_last});
  }
  const std::vector<LinearIn> others = system.solve();
  const Row r = row(last);
  const LinearIn before = others.back(), behind = others.front();
  const double slope = (r.right - r.before * before.value - r.behind * behind.value) /
                       (r.here + r.before * before.by + r.behind * behind.by);
  for (const LinearIn& other : others) s.slopes.push_back(other.value + other.by * slope);
  s.slopes.push_back(slope);
  s.slopes.push_back(s.slopes.front());
  return checked(std::move(s));
}

CellPolynomial cell(const ScalarCubic& s, std::size_t i) {
  return hermite_cell(s.nodes[i], s.nodes[i + 1] - s.nodes[i], 2, {s.values[i], s.slopes[i]},
                      {s.values[i + 1], s.slopes[i + 1]});
}

ScalarJet evaluate(const ScalarCubic& spline, double x) {
  return evaluate(cell(spline, cell_index(spline.nodes, x)), x);
}

double integral(const ScalarCubic& s, double a, double b) {
  return idspline::integrate(
      s.nodes, a, b,
      [&s](std::size_t i) {
        const CellPolynomial c = cell(s, i);
        return c.length * mean(c);
      },
      [&s](std::size_t i, double low, double high) { return integral(cell(s, i), low, high); });
}

}  // namespace obvid
