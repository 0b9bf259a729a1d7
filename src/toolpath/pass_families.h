// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "leftover.h"
#include "obvid/core/run_context.h"
#include "passes.h"
#include "steps.h"

namespace obvid::toolpath {

inline constexpr double kMostLevels = 20'000.0;  ///< more is a typing error in a length
/// Height of a tip that rests on nothing.
inline constexpr double kNothing = -std::numeric_limits<double>::infinity();

/// Passes side by side; neighbours in the list are neighbours on the part. An empty pass stands
/// between groups that have nothing to do with each other.
using Family = std::vector<Pass>;

/// Normals with a larger z belong to places flatter than the angle from which on walls are cut on
/// levels; nothing: no levels are asked for.
[[nodiscard]] std::optional<double> flat_from(const ToolpathOptions& options);

/// `left`: passes only where an earlier cutter left something; null: everywhere.
[[nodiscard]] Result<Family> zigzag(const Part& part, const ToolpathOptions& options,
                                    const StepRule& rule, Walker& walker, const Leftover* left,
                                    const RunContext& run);
[[nodiscard]] Result<Family> isoparametric(const Part& part, const ToolpathOptions& options,
                                           const StepRule& rule, Walker& walker,
                                           const Leftover* left, const RunContext& run);
[[nodiscard]] Result<Family> constant_scallop(const Part& part, const ToolpathOptions& options,
                                              const StepRule& rule, Walker& walker,
                                              const Leftover* left, const RunContext& run);

/// The field of the axis in the directions of the passes: a along them, b across.
struct PassFrame {
  Vec2 along{1.0, 0.0};
  double a0 = 0.0, a1 = 0.0, b0 = 0.0, b1 = 0.0;
  PassPlane plane = PassPlane::kNone;  ///< of straight passes
  [[nodiscard]] Vec2 across() const { return left_normal(along); }
  [[nodiscard]] Vec2 at(double a, double b) const { return a * along + b * across(); }
};
[[nodiscard]] PassFrame pass_frame(const Part& part, double angle_deg);

}  // namespace obvid::toolpath
