// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "obvid/contour/bsplines/monotone.h"
#include "obvid/contour/common/internal/carried_parts.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/runs.h"

namespace obvid::contour_detail {
namespace {

/// Pieces [first, end) of a contour as a contour of their own.
Contour stretch_of(const Contour& spirals, const std::vector<int>& directions, std::size_t first,
                   std::size_t end) {
  Contour out = like(spirals, Carrier::kSpiral);
  const auto at = [](std::size_t k) { return static_cast<std::ptrdiff_t>(k); };
  out.pieces.assign(spirals.pieces.begin() + at(first), spirals.pieces.begin() + at(end));
  out.joints.assign(spirals.joints.begin() + at(first), spirals.joints.begin() + at(end) + 1);
  out.runs = collect_runs({directions.begin() + at(first), directions.begin() + at(end)});
  return out;
}

/// The monotone B-spline along a stretch, all but its last joint.
Result<void> add_spline(const Contour& stretch, const CarryOptions& options, Carried& out,
                        std::vector<int>& direction) {
  if (only<LinePiece>(stretch)) {
    for (std::size_t i = 0; i < stretch.pieces.size(); ++i) {
      out.contour.joints.push_back(stretch.joints[i]);
      out.contour.pieces.push_back(stretch.pieces[i]);
      direction.push_back(0);
    }
    return {};
  }
  const auto spline = monotone_spline(stretch, options.tolerance, options.watch);
  OBVID_TRY(spline);
  std::size_t next = 0;  // joint of the spirals that may be the next knot
  for (std::size_t k = 0; k < spline->spans.size(); ++k) {
    const Element& e = spline->elements[k];
    Joint joint{e, std::nullopt, {}};
    for (std::size_t j = next; j < stretch.joints.size(); ++j) {
      if (!(stretch.joints[j].element.point == e.point)) continue;
      joint.source = stretch.joints[j].source;
      next = j + 1;
      break;
    }
    out.contour.joints.push_back(joint);
    if (spline->direction[k] == 0) {  // straight: rounding would bend a quintic
      out.contour.pieces.emplace_back(LinePiece{e.point, spline->elements[k + 1].point});
    } else {
      out.contour.pieces.emplace_back(spline->spans[k]);
    }
    direction.push_back(spline->direction[k]);
  }
  return {};
}

}  // namespace

Result<Carried> carry_bspline(const Contour& spirals, const CarryOptions& options) {
  Carried out{like(spirals, Carrier::kBspline), {}};
  const std::vector<int> directions = piece_directions(spirals);
  std::vector<int> direction;
  const std::size_t n = spirals.pieces.size();
  for (std::size_t i = 0; i < n;) {
    if (std::holds_alternative<ArcPiece>(spirals.pieces[i])) {  // no polynomial is a circle
      out.contour.joints.push_back(spirals.joints[i]);
      out.contour.pieces.push_back(spirals.pieces[i]);
      direction.push_back(0);
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    // what was given at a point is met where the point is a knot
    while (end < n && !std::holds_alternative<ArcPiece>(spirals.pieces[end]) &&
           given_at(spirals.joints[end], options.given) == nullptr) {
      ++end;
    }
    if (auto done = add_spline(stretch_of(spirals, directions, i, end), options, out,
                               direction);
        !done) {
      return at_point(done.error(), spirals, static_cast<std::ptrdiff_t>(i) + done.error().index,
                      kOtherCarriers);
    }
    i = end;
  }
  out.contour.joints.push_back(spirals.joints.back());
  out.contour.runs = collect_runs(direction);
  keep_joint_curvatures(out.contour);
  return out;
}

}  // namespace obvid::contour_detail
