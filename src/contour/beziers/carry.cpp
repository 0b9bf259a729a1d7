// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/contour/beziers.h"
#include "obvid/contour/common/internal/carried_parts.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::contour_detail {
namespace {

/// The joint after which the curvature changes its sign first.
std::optional<std::size_t> inflection(const Contour& spirals) {
  double sign = 0.0;
  std::size_t last = 0;
  for (std::size_t j = 0; j < spirals.joints.size(); ++j) {
    const double kappa = spirals.joints[j].element.kappa;
    if (kappa == 0.0) continue;
    if (sign * kappa < 0.0) return last;
    sign = kappa;
    last = j;
  }
  return std::nullopt;
}

/// Every parabola that keeps its curvature monotone changes it by a part that grows with the square
/// of its turning: a piece that turns and hardly changes its curvature would need more of them than
/// anyone wants.
Error hardly_bends(Error error, const Contour& spirals, std::size_t i) {
  if (error.code != ErrorCode::kToleranceNotReached) return error;
  const Element& a = spirals.joints[i].element;
  const Element& b = spirals.joints[i + 1 < spirals.joints.size() ? i + 1 : 0].element;
  const double larger = std::max(std::abs(a.kappa), std::abs(b.kappa));
  error.what = fmt::format(
      "the contour is nearly an arc there (it turns by {:.2g} degrees while its radius changes by "
      "{:.2g} %), which no chain of monotone parabolas follows",
      std::abs(turn_between(a.theta, b.theta)) / kOneDegree,
      100.0 * std::abs(b.kappa - a.kappa) / larger);
  return error;
}

}  // namespace

Result<Carried> carry_beziers(const Contour& spirals, const CarryOptions& options) {
  if (const auto joint = inflection(spirals)) {
    return at_point(error(ErrorCode::kNoSpiral,
                          "the contour has an inflection, which no chain of parabolas has"),
                    spirals, static_cast<std::ptrdiff_t>(*joint), kOtherCarriers);
  }
  Carried out{like(spirals, Carrier::kBeziers), {}};
  const std::vector<int> direction = piece_directions(spirals);
  std::vector<int> directions;
  for (std::size_t i = 0; i < spirals.pieces.size(); ++i) {
    if (options.watch.cancelled()) return fail(cancelled_error());
    out.contour.joints.push_back(spirals.joints[i]);
    if (std::holds_alternative<LinePiece>(spirals.pieces[i])) {
      out.contour.pieces.push_back(spirals.pieces[i]);
      directions.push_back(0);
      continue;
    }
    if (direction[i] == 0) {
      return at_point(error(ErrorCode::kNoSpiral, "no chain of parabolas has constant curvature"),
                      spirals, static_cast<std::ptrdiff_t>(i), kOtherCarriers);
    }
    const auto chain = condense_piece(spirals.pieces[i], direction[i], options.tolerance);
    if (!chain) {
      return at_point(hardly_bends(chain.error(), spirals, i), spirals,
                      static_cast<std::ptrdiff_t>(i), kOtherCarriers);
    }
    add_free_pieces(chain->parabolas, out.contour);
    directions.insert(directions.end(), chain->parabolas.size(), direction[i]);
  }
  out.contour.joints.push_back(spirals.joints.back());
  out.contour.runs = collect_runs(directions);
  keep_joint_curvatures(out.contour);
  return out;
}

}  // namespace obvid::contour_detail
