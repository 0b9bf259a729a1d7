// SPDX-License-Identifier: Apache-2.0
// Tensor product of parabolic splines: docs/methods/idspline.md, section 4.
#include "obvid/idspline/internal/id_spline_2d.h"

#include <optional>
#include <utility>

#include "checks.h"
#include "integrate.h"
#include "local_polynomial.h"
#include "smooth.h"

namespace obvid {
namespace {

/// Every `stride`-th number of a table from `first` on: a row or a column.
struct Line {
  std::size_t first, stride;
};

void read(const std::vector<double>& table, const Line& line, std::vector<double>& out) {
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = table[line.first + k * line.stride];
}

void write(const std::vector<double>& in, const Line& line, std::vector<double>& table) {
  for (std::size_t k = 0; k < in.size(); ++k) table[line.first + k * line.stride] = in[k];
}

Line row(std::size_t j, std::size_t width) { return {j * width, 1}; }
Line column(std::size_t i, std::size_t width) { return {i, width}; }

std::optional<Error> refuse_table(const IdSpline2dData& d) {
  if (auto error = idspline::refuse_nodes(d.x, "column")) return error;
  if (auto error = idspline::refuse_nodes(d.y, "row")) return error;
  const std::size_t nx = d.x.size(), ny = d.y.size();
  using idspline::refuse_data;
  if (auto error = refuse_data(d.values, nx * ny, "value")) return error;
  if (d.along_x.empty() && d.along_y.empty() && d.cells.empty()) return std::nullopt;
  if (auto error = refuse_data(d.along_x, (nx - 1) * ny, "integral along x")) return error;
  if (auto error = refuse_data(d.along_y, nx * (ny - 1), "integral along y")) return error;
  return refuse_data(d.cells, (nx - 1) * (ny - 1), "integral over a cell");
}

constexpr int kParabola = 2;

/// Integrals from values along x, then of both along y.
void fill_integrals(IdSpline2d& s) {
  const std::size_t nx = s.x.size(), ny = s.y.size();
  s.along_x.resize((nx - 1) * ny);
  s.along_y.resize(nx * (ny - 1));
  s.cells.resize((nx - 1) * (ny - 1));
  std::vector<double> in_row(nx), in_column(ny);
  for (std::size_t j = 0; j < ny; ++j) {
    read(s.values, row(j, nx), in_row);
    write(idspline::local_integrals(s.x, in_row, kParabola), row(j, nx - 1), s.along_x);
  }
  for (std::size_t i = 0; i < nx; ++i) {
    read(s.values, column(i, nx), in_column);
    write(idspline::local_integrals(s.y, in_column, kParabola), column(i, nx), s.along_y);
  }
  for (std::size_t i = 0; i + 1 < nx; ++i) {
    read(s.along_x, column(i, nx - 1), in_column);
    write(idspline::local_integrals(s.y, in_column, kParabola), column(i, nx - 1), s.cells);
  }
}

/// Smooths the values on one line after the other.
class LineSmoother {
 public:
  explicit LineSmoother(const std::vector<double>& nodes) {
    spline_.nodes = nodes;
    spline_.values.resize(nodes.size());
    spline_.integrals.resize(nodes.size() - 1);
  }

  void run(std::vector<double>& values, const Line& at, const std::vector<double>& integrals,
           const Line& over) {
    read(values, at, spline_.values);
    read(integrals, over, spline_.integrals);
    idspline::smooth(spline_, 0);
    write(spline_.values, at, values);
  }

 private:
  IdSpline spline_;
};

/// The operator of one variable on every row, then on every column; in the other order the result
/// is the same, because they act on different indices.
void smooth_both(IdSpline2d& s) {
  const std::size_t nx = s.x.size(), ny = s.y.size();
  LineSmoother along_x(s.x), along_y(s.y);
  for (std::size_t j = 0; j < ny; ++j) {
    along_x.run(s.values, row(j, nx), s.along_x, row(j, nx - 1));
    if (j + 1 < ny) along_x.run(s.along_y, row(j, nx), s.cells, row(j, nx - 1));
  }
  for (std::size_t i = 0; i < nx; ++i) {
    along_y.run(s.values, column(i, nx), s.along_y, column(i, nx));
    if (i + 1 < nx) along_y.run(s.along_x, column(i, nx - 1), s.cells, column(i, nx - 1));
  }
}

std::optional<Error> refuse_large_table(const IdSpline2d& s) {
  using idspline::refuse_overflow;
  if (auto error = refuse_overflow(s.values, "value")) return error;
  if (auto error = refuse_overflow(s.along_x, "integral along x")) return error;
  if (auto error = refuse_overflow(s.along_y, "integral along y")) return error;
  return refuse_overflow(s.cells, "integral over a cell");
}

/// Cell i, j as three polynomials of x: at its lower edge, at its upper edge, and the mean over y.
struct CellRows {
  CellPolynomial low, high, mean;
};

CellRows rows_of(const IdSpline2d& s, std::size_t i, std::size_t j) {
  const std::size_t nx = s.x.size(), at = j * nx + i, edge = j * (nx - 1) + i;
  const double hx = s.x[i + 1] - s.x[i], hy = s.y[j + 1] - s.y[j];
  const auto make = [&](double left, double right, double mean_value) {
    return integral_cell(s.x[i], hx, 1, {left}, {right}, mean_value);
  };
  return {make(s.values[at], s.values[at + 1], s.along_x[edge] / hx),
          make(s.values[at + nx], s.values[at + nx + 1], s.along_x[edge + nx - 1] / hx),
          make(s.along_y[at] / hy, s.along_y[at + 1] / hy, s.cells[edge] / hx / hy)};
}

CellPolynomial along_y(const IdSpline2d& s, std::size_t j, double low, double high, double mean_y) {
  return integral_cell(s.y[j], s.y[j + 1] - s.y[j], 1, {low}, {high}, mean_y);
}

}  // namespace

Result<IdSpline2d> id_spline_2d(IdSpline2dData data, bool smooth) {
  if (auto error = refuse_table(data)) return fail(std::move(*error));
  IdSpline2d s = std::move(data);
  if (s.cells.empty()) fill_integrals(s);
  if (smooth) smooth_both(s);
  if (auto error = refuse_large_table(s)) return fail(std::move(*error));
  return s;
}

GridJet evaluate(const IdSpline2d& s, double x, double y) {
  const std::size_t i = cell_index(s.x, x), j = cell_index(s.y, y);
  const CellRows rows = rows_of(s, i, j);
  const ScalarJet low = evaluate(rows.low, x), high = evaluate(rows.high, x),
                  mid = evaluate(rows.mean, x);
  const ScalarJet f = evaluate(along_y(s, j, low.value, high.value, mid.value), y);
  const ScalarJet fx = evaluate(along_y(s, j, low.d1, high.d1, mid.d1), y);
  const double fxx = value(along_y(s, j, low.d2, high.d2, mid.d2), y);
  return {f.value, fx.value, f.d1, fxx, fx.d1, f.d2};
}

double integral(const IdSpline2d& s, double x0, double x1, double y0, double y1) {
  const auto over_x = [&](std::size_t j, double low, double high) {
    const auto part = [&](std::size_t i, double a, double b) {
      const CellRows rows = rows_of(s, i, j);
      return integral(along_y(s, j, integral(rows.low, a, b), integral(rows.high, a, b),
                              integral(rows.mean, a, b)),
                      low, high);
    };
    const auto whole = [&](std::size_t i) {
      const bool all = low == s.y[j] && high == s.y[j + 1];
      return all ? s.cells[j * (s.x.size() - 1) + i] : part(i, s.x[i], s.x[i + 1]);
    };
    return idspline::integrate(s.x, x0, x1, whole, part);
  };
  return idspline::integrate(
      s.y, y0, y1, [&](std::size_t j) { return over_x(j, s.y[j], s.y[j + 1]); }, over_x);
}

IdSpline section_along_x(const IdSpline2d& s, double y) {
  const std::size_t nx = s.x.size(), j = cell_index(s.y, y);
  const double hy = s.y[j + 1] - s.y[j];
  IdSpline out;
  out.nodes = s.x;
  for (std::size_t i = 0; i < nx; ++i) {
    const std::size_t at = j * nx + i;
    out.values.push_back(
        value(along_y(s, j, s.values[at], s.values[at + nx], s.along_y[at] / hy), y));
  }
  for (std::size_t i = 0; i + 1 < nx; ++i) {
    const std::size_t at = j * (nx - 1) + i;
    out.integrals.push_back(
        value(along_y(s, j, s.along_x[at], s.along_x[at + nx - 1], s.cells[at] / hy), y));
  }
  return out;
}

IdSpline section_along_y(const IdSpline2d& s, double x) {
  const std::size_t nx = s.x.size(), ny = s.y.size(), i = cell_index(s.x, x);
  const double hx = s.x[i + 1] - s.x[i];
  const auto at_x = [&](double left, double right, double integral_x) {
    return value(integral_cell(s.x[i], hx, 1, {left}, {right}, integral_x / hx), x);
  };
  IdSpline out;
  out.nodes = s.y;
  for (std::size_t j = 0; j < ny; ++j) {
    const std::size_t at = j * nx + i, edge = j * (nx - 1) + i;
    out.values.push_back(at_x(s.values[at], s.values[at + 1], s.along_x[edge]));
    if (j + 1 < ny) {
      out.integrals.push_back(at_x(s.along_y[at], s.along_y[at + 1], s.cells[edge]));
    }
  }
  return out;
}

std::array<std::array<double, 3>, 3> bezier_ordinates(const IdSpline2d& s, std::size_t i,
                                                      std::size_t j) {
  // of (1 - u) a + u b + u (1 - u) e: a, (a + b + e)/2, b
  const auto ordinates = [](const CellPolynomial& c) {
    return std::array<double, 3>{c.left[0], 0.5 * (c.left[0] + c.right[0] + c.left[1]), c.right[0]};
  };
  const CellRows rows = rows_of(s, i, j);
  const auto low = ordinates(rows.low), high = ordinates(rows.high), mid = ordinates(rows.mean);
  std::array<std::array<double, 3>, 3> out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column_k = ordinates(along_y(s, j, low[k], high[k], mid[k]));
    for (std::size_t l = 0; l < 3; ++l) out[l][k] = column_k[l];
  }
  return out;
}

}  // namespace obvid
