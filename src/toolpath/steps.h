// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "part.h"

namespace obvid::toolpath {

/// Shares of a scallop: passes are laid out for the first; where more than the second stays, others
/// are put between them; the survey may overlook the third above it, and printing adds the fourth.
inline constexpr double kScallopAim = 0.88;
inline constexpr double kScallopLimit = 0.95;
inline constexpr double kScallopWithin = 0.02;
inline constexpr double kScallopPrint = 0.04;

/// How far printed blocks may lie from the points of passes.
[[nodiscard]] double print_within(const ToolpathOptions& options);

/// How far the next pass may lie, seen from above, as a quadratic form: directions d with
/// xx dx^2 + 2 xy dx dy + yy dy^2 = 1.
struct StepForm {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  [[nodiscard]] double along(Vec2 direction) const;  ///< step in a direction of length 1
};

/// Steps between passes for a greatest scallop, from the bends of cutter and surface across the
/// pass. Between `floor` and `level`, the step of a level place.
class StepRule {
 public:
  /// Scallop or step_over or both; the smaller step counts.
  StepRule(const CutterShape& cutter, const ToolpathOptions& options);

  [[nodiscard]] double level() const { return level_; }
  [[nodiscard]] double floor() const { return floor_; }
  [[nodiscard]] StepForm level_form() const;
  [[nodiscard]] StepForm form(const Part& part, const Place& place) const;
  /// Distance of passes along the surface where the pass runs in the unit direction `along`.
  [[nodiscard]] double across(const Part& part, const Place& place, Vec3 along) const;
  /// Distance of levels on a wall whose normal's z is `cosine`; bends of the surface at `place`
  /// count where it leans alike.
  [[nodiscard]] double down(const Part& part, const Place& place, double cosine) const;

 private:
  [[nodiscard]] double tip_step(double cutter_bend, double bend) const;
  [[nodiscard]] double on_surface(double cutter_bend, double bend) const;

  CutterShape cutter_;
  double scallop_ = 0.0;  ///< 0: none asked for
  double level_ = 0.0, floor_ = 0.0;
};

}  // namespace obvid::toolpath
