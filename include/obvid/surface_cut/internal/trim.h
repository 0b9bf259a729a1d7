// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/surface.h"
#include "obvid/surface_cut/internal/plane_section.h"

namespace obvid {

struct TrimOptions {
  double tolerance = 0.0;     ///< units, > 0: of the trims from the exact cut
  bool keep_positive = true;  ///< what lies where the normal of a plane points to; inside a contour
};

/// A part of a model.
struct TrimmedModel {
  SurfaceModel model;
  double deviation = 0.0;   ///< units: of trims from the exact cut along the surface, as measured
  // a patch that became two halves counts as two
  std::size_t whole = 0;    ///< patches left as they were
  std::size_t cut = 0;      ///< patches that are trimmed by this
  std::size_t dropped = 0;  ///< patches of which nothing is left
};

/// The part of a model on one side of a plane. The lines are those of `ModelCutter`, as cubic
/// curves of the parameters within the tolerance; a new trim goes along old ones where these are on
/// that side. Patches that close on themselves and are cut become two halves, so that no trim
/// crosses a seam. A patch that only touches the plane stays whole or goes.
///
/// Errors: those of `ModelCutter` (E203 the tolerance); E310 a cut that ends elsewhere than on the
/// border of what is there, or a closed patch with trims (`where`: the patch); E311 nothing is
/// left; E502 a line that does not come within the tolerance; E103.
[[nodiscard]] Result<TrimmedModel> trimmed(const SurfaceModel& model, const CutPlane& plane,
                                           const TrimOptions& options, const RunContext& run = {});

/// A closed curve in a plane, projected along the normal of the frame.
struct ProjectedContour {
  Frame frame;
  std::vector<NurbsCurve> curves;  ///< end to end, in coordinates of the frame; not crossing itself
};

/// The part of a model inside of a contour, or outside. Each patch is looked at on a raster of at
/// least 8 x 8 places in every span (256 x 256 in all): parts of it inside or outside that hold no
/// place of the raster are missed, which is measured nowhere. The distance from a contour is that
/// of its nearest point. Errors: as above; E203 a contour that is not closed.
[[nodiscard]] Result<TrimmedModel> trimmed(const SurfaceModel& model,
                                           const ProjectedContour& contour,
                                           const TrimOptions& options, const RunContext& run = {});

/// A line along a patch, from border to border or closed, and on which side of it the patch stays.
struct LineAlong {
  SpaceCurve curve;                  ///< within the tolerance of the patch
  std::function<Vec3(double)> kept;  ///< direction of what stays at a parameter of the curve
  /// Parameters of the patch along the curve, in order, dense enough for chords to tell one part of
  /// it from another. On patches that close on themselves they go on beyond the domain. A closed
  /// line ends with its first place again, or where this is one turn farther.
  std::vector<Vec2> places;
  bool closed = false;
};

/// What stays of a patch beside lines that do not cross. Which side a place is on is asked of the
/// nearest point of all lines, in space: a patch that comes back to itself nearer than its own
/// curvature radii may be refused for that. `keep_positive` is not asked. Errors as above.
[[nodiscard]] Result<TrimmedModel> trimmed(const SurfacePatch& patch,
                                           const std::vector<LineAlong>& lines,
                                           const TrimOptions& options, const RunContext& run = {});

}  // namespace obvid
