// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "obvid/pipeline/compare_curves.h"

namespace obvid {

Result<CurvesJob> curves_job(const std::string& align) {
  if (align.empty() || align == "chord") return CurvesJob{!align.empty()};
  return error(ErrorCode::kBadOption, "unknown choice '" + align + "'")
      .where("--align")
      .hint("one of chord");
}

Result<void> check_enlarge(const std::optional<double>& enlarge) {
  if (!enlarge || (*enlarge > 0.0 && std::isfinite(*enlarge))) return {};
  return error(ErrorCode::kBadOption, "a positive factor is expected")
      .where("--enlarge")
      .hint("for example 50");
}

}  // namespace obvid
