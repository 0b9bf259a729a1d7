// SPDX-License-Identifier: Apache-2.0
// A band eliminated on two threads.
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/numeric/internal/banded_cholesky.h"

namespace obvid {

/// A symmetric positive definite band that is eliminated from both ends at a time, each on a thread
/// of its own; where they meet, as many unknowns as the band is wide are left, and solved last
/// (van der Vorst, Parallel Computing 5 (1987)). The same figures for any number of threads.
class BandedHalves {
 public:
  explicit BandedHalves(const BandedCholesky& matrix);

  /// False when the matrix is not positive definite in double precision. Error: E103.
  [[nodiscard]] Result<bool> factor(const RunContext& run);

  /// Solution for a right side, of the factored matrix.
  [[nodiscard]] std::vector<double> solve(const std::vector<double>& right) const;

 private:
  std::size_t n_, between_, first_, last_;  ///< unknowns: all, in the middle, before and behind it
  BandedCholesky down_, up_;                ///< from the first unknown on, from the last one on
  BandedCholesky middle_;
};

}  // namespace obvid
