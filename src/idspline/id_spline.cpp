// SPDX-License-Identifier: Apache-2.0
// Integro-differential splines of even degree: docs/methods/idspline.md.
#include "obvid/idspline/internal/id_spline.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "checks.h"
#include "integrate.h"
#include "local_polynomial.h"
#include "smooth.h"

namespace obvid {
namespace {

using idspline::refuse_data;

Error bad_option(const char* what, const char* hint, int degree) {
  return error(ErrorCode::kBadOption, what).hint(hint).value(static_cast<double>(degree));
}

/// Derivatives that the degree has no place for, or wrong numbers of those that it has.
std::optional<Error> refuse_derivatives(const std::vector<double>& data, std::size_t nodes,
                                        bool used, const char* name) {
  if (data.empty()) return std::nullopt;
  return refuse_data(data, used ? nodes : 0, name);
}

/// Steps of such different lengths side by side lose half of all digits in the equations of degree
/// 6 with free values (docs/methods/idspline.md, section 3).
constexpr double kLargestStepRatio = 1e5;

std::optional<Error> refuse_steps(const std::vector<double>& x, const IdSplineOptions& options) {
  if (options.degree < 6 || options.smoothing != IdSmoothing::kValuesFree) return std::nullopt;
  for (std::size_t i = 2; i < x.size(); ++i) {
    const double a = x[i - 1] - x[i - 2], b = x[i] - x[i - 1];
    if (a <= kLargestStepRatio * b && b <= kLargestStepRatio * a) continue;
    return error(ErrorCode::kRoundingDecides,
                 "neighbouring steps differ more than free values of degree 6 bear")
        .where("node " + std::to_string(i))
        .hint("keep the values, or take degree 4")
        .point(i - 1)
        .value(std::max(a / b, b / a));
  }
  return std::nullopt;
}

std::optional<Error> refuse_id_data(const IdSplineData& data, const IdSplineOptions& options) {
  const int degree = options.degree;
  if (degree != 2 && degree != 4 && degree != 6) {
    return bad_option("the degree of an integro-differential spline is 2, 4 or 6", "choose one",
                      degree);
  }
  if (degree == 2 && options.smoothing == IdSmoothing::kValuesKept) {
    return bad_option("a parabola has no data to smooth except values",
                      "free the values, or take degree 4", degree);
  }
  const std::size_t n = data.nodes.size();
  if (auto error = idspline::refuse_nodes(data.nodes)) return error;
  if (auto error = refuse_steps(data.nodes, options)) return error;
  if (auto error = refuse_data(data.values, n, "value")) return error;
  if (!data.integrals.empty()) {
    if (auto error = refuse_data(data.integrals, n - 1, "integral")) return error;
  }
  if (auto error = refuse_derivatives(data.slopes, n, degree >= 4, "slope")) return error;
  return refuse_derivatives(data.seconds, n, degree >= 6, "second derivative");
}

std::optional<Error> refuse_large(const IdSpline& s) {
  using idspline::refuse_overflow;
  if (auto error = refuse_overflow(s.values, "value")) return error;
  if (auto error = refuse_overflow(s.integrals, "integral")) return error;
  if (auto error = refuse_overflow(s.slopes, "slope")) return error;
  return refuse_overflow(s.seconds, "second derivative");
}

}  // namespace

Result<IdSpline> id_spline(IdSplineData data, const IdSplineOptions& options) {
  if (auto error = refuse_id_data(data, options)) return fail(std::move(*error));
  IdSpline s;
  s.degree = options.degree;
  s.integrals = data.integrals.empty()
                    ? idspline::local_integrals(data.nodes, data.values, s.degree)
                    : std::move(data.integrals);
  s.slopes = std::move(data.slopes);
  s.seconds = std::move(data.seconds);
  if (s.degree >= 4 && s.slopes.empty()) {
    s.slopes = idspline::local_derivatives(data.nodes, data.values, s.degree, 1);
  }
  if (s.degree >= 6 && s.seconds.empty()) {
    s.seconds = idspline::local_derivatives(data.nodes, data.values, s.degree, 2);
  }
  s.nodes = std::move(data.nodes);
  s.values = std::move(data.values);
  if (options.smoothing != IdSmoothing::kNone) {
    idspline::smooth(s, options.smoothing == IdSmoothing::kValuesKept ? 1 : 0);
  }
  if (auto error = refuse_large(s)) return fail(std::move(*error));
  return s;
}

CellPolynomial cell(const IdSpline& s, std::size_t i) {
  assert(i + 1 < s.nodes.size());
  const auto jet = [&s](std::size_t k) {
    return NodeJet{s.values[k], s.degree >= 4 ? s.slopes[k] : 0.0,
                   s.degree >= 6 ? s.seconds[k] : 0.0};
  };
  const double h = s.nodes[i + 1] - s.nodes[i];
  return integral_cell(s.nodes[i], h, s.degree / 2, jet(i), jet(i + 1), s.integrals[i] / h);
}

std::size_t cell_index(const std::vector<double>& nodes, double x) {
  const auto inner = nodes.begin() + 1, end = nodes.end() - 1;
  return static_cast<std::size_t>(std::upper_bound(inner, end, x) - inner);
}

ScalarJet evaluate(const IdSpline& spline, double x) {
  return evaluate(cell(spline, cell_index(spline.nodes, x)), x);
}

void evaluate_sorted(const IdSpline& spline, std::span<const double> x, std::span<double> out) {
  assert(x.size() == out.size());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t last = spline.nodes.size() - 2;
  double low = kInfinity, high = -kInfinity;  // of no cell yet
  std::size_t i = 0;
  CellPolynomial here;
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (!(x[j] >= low && x[j] < high)) {
      // mostly the next cell: no need to search
      const bool next = low < high && x[j] >= high && (i + 1 == last || x[j] < spline.nodes[i + 2]);
      i = next ? i + 1 : cell_index(spline.nodes, x[j]);
      here = cell(spline, i);
      low = i == 0 ? -kInfinity : spline.nodes[i];
      high = i == last ? kInfinity : spline.nodes[i + 1];
    }
    out[j] = value(here, x[j]);
  }
}

double integral(const IdSpline& s, double a, double b) {
  return idspline::integrate(
      s.nodes, a, b, [&s](std::size_t i) { return s.integrals[i]; },
      [&s](std::size_t i, double low, double high) { return integral(cell(s, i), low, high); });
}

}  // namespace obvid
