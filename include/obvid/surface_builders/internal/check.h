// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/run_context.h"
#include "obvid/surface/internal/topology.h"
#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// A place of a patch.
struct SurfacePlace {
  double u = 0.0, v = 0.0;
  Vec3 point;
};

/// Smallest and largest value of a quantity over a patch; infinite where it was found to have no
/// bound on that side.
struct Extent {
  double least = 0.0;
  double most = 0.0;
  SurfacePlace least_at, most_at;  ///< where; the point of a pole where there is no bound
};

/// Least and greatest curvatures of a patch.
struct CurvatureExtents {
  Extent gaussian;                 ///< 1/units^2
  Extent mean, k1, k2;             ///< 1/units
  std::size_t without_normal = 0;  ///< samples where the surface has no tangent plane (poles)
};

/// Between which figures the curvatures of a patch lie: looked for at about `samples` places per
/// direction, two or more in each span, and climbed to from the best of them (three, each the best
/// of a sixteenth of the patch; to some 1e-9 of the extreme). Not proved: an extreme between the
/// places can be missed. Towards borders and corners
/// where du x dv vanishes (poles) each quantity is followed over eight halvings of the distance:
/// one whose steps do not shrink by then (a tenth each) has no bound on that side. Poles inside a
/// patch are not looked for. All 0 without a tangent plane.
[[nodiscard]] CurvatureExtents curvature_extents(const NurbsSurface& surface,
                                                 std::size_t samples = 65);
/// Of what is there of a patch. Error: E103.
[[nodiscard]] Result<CurvatureExtents> curvature_extents(const SurfacePatch& patch,
                                                         const RunContext& run);

/// Curvature along the lines of one family of parameters.
struct LineReport {
  std::size_t lines = 0;
  std::size_t monotone = 0;       ///< lines whose curvature has no extremum inside
  std::size_t vertices = 0;       ///< curvature extrema on all lines together
  std::size_t most_vertices = 0;  ///< on one line
  std::size_t inflections = 0;    ///< changes of the sign of the curvature, on all lines together
};

struct PatchReport {
  std::string name;
  int degree_u = 0, degree_v = 0;
  std::size_t count_u = 0, count_v = 0;  ///< control points
  int order_u = 0, order_v = 0;  ///< of continuity at inner knots, by their multiplicities; the
                                 ///< degree where there are none
  bool rational = false;
  std::size_t trims = 0;           ///< loops; 0: the whole patch is there
  double area = 0.0;               ///< units^2, by quadrature
  double area_error = 0.0;         ///< what the last step of it changed, of trimmed patches also
                                   ///< what lies between the trims and what they stand for
  Extent gaussian, mean, k1, k2;   ///< as of `curvature_extents`; 1/units^2 and 1/units
  std::size_t without_normal = 0;  ///< samples where the surface has no tangent plane (poles)
  LineReport along_u;              ///< lines v = const
  LineReport along_v;              ///< lines u = const
};

/// Two borders that meet.
struct JointReport {
  std::array<std::size_t, 2> patch{};
  std::array<PatchSide, 2> side{};
  bool shared = true;  ///< one edge of `topology_of`: meshes and CAD files join it; else the gap
                       ///< is larger than `kSameBorder` of the size
  double gap = 0.0;    ///< largest distance of corresponding points, units
  double angle = 0.0;  ///< largest angle between the tangent planes, rad
  double curvature = 0.0;  ///< largest step of the normal curvature across the border, as a share
                           ///< of the largest curvature beside it; neither this nor the angle is
                           ///< looked at beside points in which the border ends (poles)
  int order = 0;           ///< 0 G0, 1 G1, 2 G2, by the limits named below
  Vec3 gap_at, angle_at, curvature_at;  ///< where on the first patch each of the three is largest
  std::size_t places = 0;               ///< that were looked at before the extremes were climbed to
};

/// Two faces that run along each other, one or both of them trimmed; or one trimmed face twice, at
/// the seam where it is closed.
struct TrimJointReport {
  std::array<std::size_t, 2> patch{};
  double gap = 0.0;        ///< largest distance of a border from the other face, units
  double angle = 0.0;      ///< largest angle between the tangent planes there, rad; not looked at
                           ///< beside points in which a border ends
  int order = 0;           ///< 0 G0, 1 G1 or more, by the limit named below
  Vec3 gap_at, angle_at;   ///< where on a border each of the two is largest
  double length = 0.0;     ///< of the border they have in common, units, by its places
  std::size_t places = 0;  ///< that were looked at before the extremes were climbed to
};

/// Borders of all trimmed patches together.
struct TrimmedBorders {
  double length = 0.0;        ///< units, by their places
  double free = 0.0;          ///< of this, what runs along no face
  double longest_free = 0.0;  ///< the longest stretch of that
  Vec3 free_at;               ///< its middle, where there is one
};

/// Up to these a border counts as smooth.
inline constexpr double kSmoothAngle = 1e-3;      ///< rad
inline constexpr double kSmoothCurvature = 1e-2;  ///< share

struct SurfaceCheck {
  double size = 0.0;  ///< diagonal of the control points' box, units
  std::vector<PatchReport> patches;
  std::vector<JointReport> joints;           ///< of patches that are not trimmed
  std::vector<TrimJointReport> trim_joints;  ///< in the order of the patches
  TrimmedBorders trimmed_borders;            ///< all 0 where no patch is trimmed
  // sides of patches that are not trimmed; those that are a point are none of these
  std::size_t met_borders = 0;    ///< that a joint is at, or trimmed faces from end to end
  std::size_t apart_borders = 0;  ///< of these, that share their edge with none
  std::size_t free_borders = 0;   ///< that meet none
};

struct CheckOptions {
  std::size_t samples = 65;  ///< per direction and patch for curvature, and lines of each family
  std::optional<double>
      meeting{};  ///< units: borders nearer than this meet [`kMeeting` of the size]
};

inline constexpr double kMeeting = 1e-5;

/// What can be measured about a model: curvature, continuity inside patches and across borders,
/// vertices of the lines of constant parameters. Figures are sampled, not proved: a feature smaller
/// than a step of the raster can be missed. Borders meet as wholes only: a border that meets parts
/// of two others is not found; those that are the same curve with other parameters are. Along a
/// joint, gap, angle and step of curvature are looked for at four places or more in every span of
/// both borders and climbed to from the best; where the borders run at different speeds, in fewer
/// spans when there are more than 256. Curvature of lines is that of curves in space, with the sign
/// that their mean plane gives; steps below 1e-6 of a line's largest curvature are rounding.
/// Of trimmed patches area and ranges of curvature are those of what is there (a raster of the
/// whole patch, its places outside left out; climbing stays inside; all 0 where no place of it is
/// inside); lines run over the whole patch. Each of their trims is looked at, and each side of an
/// untrimmed patch beside a trimmed one, at 64 places or more, four or more in every span: where
/// two places one after the other lie within `meeting` of another face, and the distance changes by
/// no more than half of the step and the nearest place goes on by at least that (a border that
/// leaves a corner does not run along what is there), gap and angle are measured at the nearest
/// place of that face and climbed to from the two best, unless they are the same all along (to
/// `kSameBorder` of the size, 1e-9 rad). The distance of a place is as exact as that of
/// `NearestOnModel`; between places gap and angle are as
/// sampled. Of a face that is closed its trims along the seam are compared with each other.
[[nodiscard]] Result<SurfaceCheck> check_surface(const SurfaceModel& model,
                                                 const CheckOptions& options = {},
                                                 const RunContext& run = {});

}  // namespace obvid
