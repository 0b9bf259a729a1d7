// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/geom/vec3.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// All points p with dot(normal, p) = offset; the normal has length 1.
struct CutPlane {
  Vec3 normal{0.0, 0.0, 1.0};
  double offset = 0.0;  ///< units
};

/// A place of a section, and where it lies on its patch.
struct SectionPoint {
  Vec3 point;
  std::size_t patch = 0;
  double u = 0.0, v = 0.0;  ///< native parameters of the patch
  /// The next place is the same one with the parameters of the patch that the branch goes on in;
  /// only while a section is made.
  bool stands_again = false;
};

/// One branch of a section.
struct SectionBranch {
  std::vector<SectionPoint> points;  ///< of closed ones the first is not repeated
  bool closed = false;
  double gap = 0.0;        ///< units: largest distance of borders and trims that it passes
  double deviation = 0.0;  ///< units: largest distance of the chords from the section, as measured
};

/// What a plane has in common with a model.
struct PlaneSection {
  std::vector<SectionBranch> branches;
  /// Where the surface touches the plane or nearly does: places of a part smaller than 4e-6 of the
  /// size, such where branches come so near to each other that they were not told apart before
  /// cells of 1/65,536 of a knot span, and points of branches where the tangent plane is the
  /// cutting one within 1e-5 rad. At most 16, each farther than 1e-4 of the size from the others.
  std::vector<Vec3> touching;
  /// Lines along which the surface touches the plane within 1e-5 rad, once each as far as 1e-4 of
  /// the size can tell; they are no branches, and `touching` has places of them.
  std::size_t touching_lines = 0;
  /// Cells that stayed undecided at the smallest size: the surface touches the plane along a line,
  /// and what lies in them is not there.
  std::size_t undecided = 0;
  std::vector<std::size_t> in_plane;  ///< patches that lie in the plane wholly; nothing of these
  double residual = 0.0;              ///< units: largest distance of a point from the plane
};

struct PlaneSectionOptions {
  double tolerance = 0.0;  ///< units, > 0: of the chords between neighbouring points
};

/// Cuts a model by any number of planes.
///
/// - Bezier parts whose control points lie on one side are empty by their convex hull; the others
///   are divided until the distance from the plane rises or falls all over a part along u or v, by
///   the signs of the coefficients of its derivative. Such a part holds no loop, and its branches
///   follow from the roots at its sides. So no loop is missed that is larger than 4e-6 of the size;
///   smaller ones are `touching`.
/// - How branches run is decided 1e-12 of the size (64 roundings of the largest coordinate where
///   that is more) beside the plane: on the side of the normal, or on the other where nothing of
///   the model lies there. Knots, borders and corners in the plane are met in this way once and not
///   twice. Points are then moved into the plane by Newton's method, to rounding where surface and
///   plane cross at an angle; `residual` tells the largest distance.
/// - A border that lies in the plane is a branch (or a part of one), exactly.
/// - Branches go on across borders that `topology_of` joins, in the order along the border; other
///   ends are joined when nearer than 1e-6 of the size.
/// - Of trimmed patches there is what lies inside of the trims. Branches end where the chord from
/// the
///   last place inside to the first outside, moved into the plane, crosses the trim: to rounding
///   along the surface. Ends at trims are joined with others as those of patches are. A
///   branch that leaves what is there and comes back between two neighbours of at least 512 places
///   along it is not parted.
/// The parameters of a point that two patches have are those of one of them. Same model, same
/// sections. Reentrant.
class ModelCutter {
 public:
  /// `model` has to live as long as this.
  explicit ModelCutter(const SurfaceModel& model);
  ~ModelCutter();
  ModelCutter(const ModelCutter&) = delete;
  ModelCutter& operator=(const ModelCutter&) = delete;

  /// Errors: E203 a normal that has not length 1 within 1e-12, a tolerance that is not above 0;
  /// E303 an offset that is not finite; E304 a model without size; E103.
  [[nodiscard]] Result<PlaneSection> section(const CutPlane& plane,
                                             const PlaneSectionOptions& options,
                                             const RunContext& run = {}) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace obvid
