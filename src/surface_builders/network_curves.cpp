// SPDX-License-Identifier: Apache-2.0
#include "network_curves.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "obvid/geom/internal/box.h"

namespace obvid {

Result<void> check_tolerance(double tolerance) {
  if (tolerance > 0.0 && std::isfinite(tolerance)) return {};
  return error(ErrorCode::kBadOption, fmt::format("tolerance {:g} is not above 0", tolerance))
      .value(tolerance);
}

Result<void> check_curves(const std::vector<SpaceCurve>& curves, const std::string& kind) {
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (auto good = check(curves[i]); !good) {
      Error error = good.error();
      error.what = fmt::format("curve {}{}: {}", i + 1, kind, error.what);
      error.index = static_cast<std::ptrdiff_t>(i);
      return fail(std::move(error));
    }
  }
  return {};
}

bool is_point(const SpaceCurve& curve, double tolerance) {
  Box3 box;
  box.add_all(curve.points);
  return box.diagonal() <= tolerance;
}

}  // namespace obvid
