// SPDX-License-Identifier: Apache-2.0
// Convex quadratic programs of tensor splines.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"

namespace obvid {

/// Linear forms in the unknowns x[row][column] that see at most four neighbouring rows with the
/// same shares: y = sum of share[j] x[first_row + j], each form a run of coefficients over y.
struct FormGroup {
  std::size_t first_row = 0;
  std::array<double, 4> share{};
  struct Form {
    std::size_t first_column = 0;
    std::vector<double> coefficient;
    double wanted = 0.0;  ///< value, least value or half width of the box
    double weight = 0.0;  ///< of the square of the difference; of what is missing; not of boxes
  };
  std::vector<Form> near;      ///< weight / 2 (form - wanted)^2 in the aim
  std::vector<Form> at_least;  ///< weight max(0, wanted - form) in the aim
  std::vector<Form> box;       ///< |form| < wanted, always
};

struct BandedProgram {
  std::size_t rows = 0, columns = 0;
  std::vector<FormGroup> groups;
  /// Begun with boxes as far from their bounds as soft rows are, with short steps led back to the
  /// middle, and solved column after column where that makes the band narrower: for programs of
  /// which most boxes are narrow, or that have more columns than rows.
  bool centred = false;
};

/// Least aim within the boxes, row after row. Interior points, primal and dual, as Wright (1997),
/// begun at 0: every iterate, the last one too, lies inside all boxes, however early it ends. Each
/// step factors a matrix of rows * columns unknowns whose band is some 3 * columns wide to each
/// side. Steps tell how far they are as a part of [from, to] of the work. Not guaranteed: that the
/// least aim is reached within the steps that are taken. Error: E103.
[[nodiscard]] Result<std::vector<double>> solved(const BandedProgram& program,
                                                 const RunContext& run, double from, double to);

}  // namespace obvid
