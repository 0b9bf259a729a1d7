// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/surface_builders/internal/check.h"

namespace obvid {

/// Nearer to a point in which a border ends (a pole, an apex) than where du x dv is this part of
/// the largest one on it curvature may have no bound, and its step and the angle between tangent
/// planes are those of rounding: they are left out.
inline constexpr double kBesidePoint = 1e-3;

/// All pairs of sides that meet within `nearness` (units), in the order of the patches; those that
/// `same` has as one edge are shared. Error: E103.
[[nodiscard]] Result<std::vector<JointReport>> joints_of(const SurfaceModel& model,
                                                         const Topology& same, double nearness,
                                                         const RunContext& run);

}  // namespace obvid
