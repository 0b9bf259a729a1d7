// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/internal/collocation.h"
#include "skin_report.h"

namespace obvid {

/// What a stretch is fair across for.
struct FairAcross {
  double fine = 0.0;             ///< units, > 0: height of the shallowest bulges that count
  double tolerance = 0.0;        ///< units, > 0: how far each section may move
  const std::vector<double>& v;  ///< parameters of the sections
  const Collocation& across;     ///< of the sections: its own cubic
  const ForcedAcross& forced;    ///< what the given points force, on the lines of the breaks
  std::array<bool, 2> fixed{};   ///< the border at u = 0, at u = 1 stays where it is
  std::array<bool, 2> smooth{};  ///< and its first and second derivatives by u: a seam
};

struct FairedStretch {
  NurbsSurface surface;
  /// What was added, on its own few knots along; none where the given surface stays.
  std::optional<NurbsSurface> correction;
  /// Bound of the distance of each section of the surface from where it was, at the same
  /// parameter, units: of the control points of the difference, by the convex hull.
  std::vector<double> moved;
  double reach = 0.0;   ///< how far any section may move, units: the tolerance, or a share of the
                        ///< longest one's length where that is less
  bool enough = false;  ///< there were changes enough to move sections for
};

/// The sum of two polynomial surfaces with the same degrees and the same knots across, on the knots
/// along of both.
[[nodiscard]] NurbsSurface sum_of(const NurbsSurface& surface, const NurbsSurface& added);

/// The surface of a stretch with a correction that keeps every section within the tolerance of
/// where it was, such that lines across change their bending seldom and curvature along the
/// sections keeps to the runs of the contours: docs/methods/skin.md. The net keeps its knots.
/// Smaller tolerances are tried as well, and a larger one is taken only where it has no more
/// changes than they. Where no correction makes less waves than the given surface has, that stays.
/// `from`, `to`: part of the work that is told. Error: E103.
[[nodiscard]] Result<FairedStretch> faired_across(const SkinStretch& stretch,
                                                  const FairAcross& wanted, const RunContext& run,
                                                  double from, double to);

/// A stretch that is light and fair across.
struct LightAndFair {
  FairedStretch fair;        ///< `moved`: of each section, from where the exact skin has it
  double light_moved = 0.0;  ///< bound of how far the few knots alone moved any point, units
};

/// Few control points along, the given ones across, such that lines across change their bending
/// seldom: the correction is looked for in the space of the few knots that the exact surface has
/// within `light`, its control points in boxes that leave room for what these knots miss, so that
/// every section stays within the tolerance all in all. Where more than a
/// twentieth of the forced changes is left beyond them (and no more than a seventh) there are more
/// knots; and where that does not help, the one that is made fair within the rest of the tolerance
/// and then light is tried, too, and the one with the fewest changes taken. Runs of curvature are
/// wished for, not kept. Error: E103.
[[nodiscard]] Result<LightAndFair> light_and_fair(const SkinStretch& stretch,
                                                  const FairAcross& wanted, double light,
                                                  const RunContext& run, double from, double to);

}  // namespace obvid
