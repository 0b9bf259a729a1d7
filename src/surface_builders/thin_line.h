// SPDX-License-Identifier: Apache-2.0
// Knots that are not needed go away, one after the other.
#pragma once

#include <vector>

#include "approximate_line.h"
#include "obvid/core/internal/watch.h"
#include "row_hull.h"

namespace obvid {

/// Rows of data over ascending parameters, what is kept at both ends, and the other direction, by
/// which errors are measured: that of a parameter is the length of the longest mix of its row,
/// times the strictness there.
struct ThinData {
  const std::vector<double>& at;
  const Rows& data;
  const std::vector<double>& strictness;
  const LineEnds& kept;
  const RowHull& hull;
};

struct ThinLine {
  int degree = 0;
  std::vector<double> knots;  ///< inner ones single
  Rows coefficients;
};

/// Takes single knots away while the errors stay within `aim`: first those that matter least. The
/// coefficients near a knot follow by weighted least squares, whose weights grow where the error is
/// large (from least squares to the least largest error, [Lawson 1961]); all others stay. A few
/// passes over all knots, until none goes. False when it was cancelled.
[[nodiscard]] bool thin_out(ThinLine& line, const ThinData& given, double aim, Watch& watch);

/// Brings the errors near some places down to `aim` without more knots, where weights can do that:
/// in the same way, the coefficients near each place follow. False where one stays above.
[[nodiscard]] bool come_nearer(ThinLine& line, const ThinData& given,
                               const std::vector<double>& places, double aim);

}  // namespace obvid
