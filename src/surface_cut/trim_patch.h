// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface/internal/topology.h"
#include "obvid/surface/surface.h"
#include "trim_line.h"

namespace obvid {

/// A line along which a patch is cut, as places of it in order.
struct CutLine {
  std::vector<Vec2> places;  ///< of closed ones the first is not repeated
  bool closed = false;
};

/// The point that a side is, where its control points lie no farther apart than `small`.
[[nodiscard]] std::optional<Vec3> pole_of(const NurbsSurface& surface, PatchSide side,
                                          double small);

/// What is left of a patch, and what was measured of its new trims.
struct TrimmedPatch {
  bool there = false;  ///< else nothing is left
  bool cut = false;    ///< else it is as it was
  std::vector<TrimLoop> trims;
  double deviation = 0.0;  ///< units
};

/// The part of a patch on the positive side of the field, or on the other. `lines`: all along which
/// the whole surface is cut, open ones from border to border. Lengths: `tolerance` of the trims,
/// `small` for what counts as one place. Errors: E310 lines that do not end where the border of
/// what is there changes sides; those of `trim_line`.
[[nodiscard]] Result<TrimmedPatch> trimmed_patch(const SurfacePatch& patch,
                                                 const CuttingField& field,
                                                 const std::vector<CutLine>& lines,
                                                 bool keep_positive, double tolerance,
                                                 double small);

}  // namespace obvid
