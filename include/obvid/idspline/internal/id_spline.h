// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/idspline/internal/cell.h"

namespace obvid {

/// Integro-differential spline of degree 2 m (Kireev): on each cell the polynomial with the given
/// value and first m - 1 derivatives at both nodes and the given integral over the cell.
struct IdSpline {
  int degree = 2;                 ///< 2, 4 or 6
  std::vector<double> nodes;      ///< ascending, at least two
  std::vector<double> values;     ///< one per node
  std::vector<double> slopes;     ///< one per node from degree 4 on, else empty
  std::vector<double> seconds;    ///< second derivatives at degree 6, else empty
  std::vector<double> integrals;  ///< one per cell
};

/// What is known of a function. Empty vectors stand for what is not: it is taken from polynomials
/// through degree + 1 neighbouring values (fewer when there are fewer nodes), so the order of
/// approximation stays that of the spline (docs/methods/idspline.md, section 2).
struct IdSplineData {
  std::vector<double> nodes;
  std::vector<double> values;
  std::vector<double> integrals{};  ///< one per cell
  std::vector<double> slopes{};     ///< degree 4 and 6
  std::vector<double> seconds{};    ///< degree 6
};

/// Which node data give way to smoothness. Data at both end nodes and all integrals are always
/// kept. With degree 2 m:
enum class IdSmoothing {
  kNone,        ///< all data kept, C^(m-1)
  kValuesKept,  ///< derivatives at inner nodes give way, C^(2m-2); from degree 4 on
  kValuesFree,  ///< values at inner nodes too ("weak smoothing"), C^(2m-1)
};

struct IdSplineOptions {
  int degree = 2;  ///< 2, 4 or 6
  IdSmoothing smoothing = IdSmoothing::kNone;
};

/// Forms the spline. The integral over each cell is met to rounding with every choice.
/// With smoothing, inner slopes and second derivatives are found; with `kValuesFree` inner values
/// are found too, and differ from the given ones by what a smooth curve with these integrals
/// needs. O(n): a tridiagonal system with blocks of at most 3 x 3, symmetric and positive definite
/// up to the scale of its rows.
/// Errors: E201 numbers of data that do not belong together, or data that the degree has no use
/// for; E203 a degree that is not 2, 4 or 6, or `kValuesKept` at degree 2; E303 not finite
/// (`index`: the node or cell); E304 fewer than two nodes; E309 steps or data so large or small
/// that the spline has no finite data; E402 nodes that do not ascend (`index`: the first that is
/// not greater than the one before); E405 at degree 6 with `kValuesFree` when neighbouring steps
/// differ by a factor of more than 100,000 (`value`: the factor): the equations would lose more
/// than half of the digits there.
[[nodiscard]] Result<IdSpline> id_spline(IdSplineData data, const IdSplineOptions& options = {});

/// Polynomial on cell i.
[[nodiscard]] CellPolynomial cell(const IdSpline& spline, std::size_t i);

/// Cell that holds x (at an inner node the right one), or the nearest one.
[[nodiscard]] std::size_t cell_index(const std::vector<double>& nodes, double x);

/// Value and derivatives; outside the nodes the end pieces go on. O(log n).
[[nodiscard]] ScalarJet evaluate(const IdSpline& spline, double x);

/// Values at many places, written to `out` (of the same size). Ascending ones need no search. Its
/// cost then is O(n + m).
void evaluate_sorted(const IdSpline& spline, std::span<const double> x, std::span<double> out);

/// Integral from a to b, negative when b < a; O(log n + cells between). A whole cell counts with
/// its given integral exactly. Outside the nodes the end pieces go on.
[[nodiscard]] double integral(const IdSpline& spline, double a, double b);

}  // namespace obvid
