// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>
#include <variant>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/idspline/internal/id_spline_2d.h"
#include "obvid/surface/nurbs_surface.h"

namespace obvid {

/// Ruled surface between two curves, at v = 0 and v = 1: S(u, v) = (1 - v) first(u) + v second(u),
/// both read over their own domain scaled to [0, 1]. A second curve of one point makes a cone.
struct RuledSurface {
  SpaceCurve first;
  SpaceCurve second;
};

/// Ruled surface of a directrix and a field of directions: S(u, v) = directrix(u) + v direction(u),
/// v in [from, to], both over their own domains scaled to [0, 1]. Plane, cone, cylinder,
/// hyperboloid.
struct DirectedSurface {
  SpaceCurve directrix;
  SpaceCurve direction;  ///< its points are vectors
  double from = 0.0;
  double to = 1.0;
};

/// A curve turned about an axis by `angle` (0 < |angle| <= 2 pi). u runs along the profile, v in
/// [0, 1] around the axis: exact rational arcs.
struct RevolutionSurface {
  SpaceCurve profile;
  Vec3 axis_point;
  Vec3 axis_direction{0.0, 0.0, 1.0};  ///< any length but 0
  double angle = 0.0;                  ///< rad
};

/// Bilinearly blended patch of four curves that meet in the corners: along u at v = 0 and 1, along
/// v at u = 0 and 1, each over its own domain scaled to [0, 1].
struct CoonsPatch {
  SpaceCurve u_at_v0, u_at_v1;
  SpaceCurve v_at_u0, v_at_u1;
};

/// Network of crossing curves: `along_u[j]` lies at v = `v_at[j]`, `along_v[i]` at u = `u_at[i]`,
/// all over domains scaled to [0, 1]; parameters ascending from 0 to 1, at least two each.
struct GordonSurface {
  std::vector<SpaceCurve> along_u;
  std::vector<SpaceCurve> along_v;
  std::vector<double> v_at;
  std::vector<double> u_at;
};

/// All points at a distance along the normal du x dv (negative: the other side).
struct OffsetSurface {
  NurbsSurface base;
  double distance = 0.0;
};

/// Three integro-differential splines over one grid of parameters: x, y and z of a point.
struct IdSurface {
  IdSpline2d x, y, z;
};

using Surface = std::variant<NurbsSurface, RuledSurface, DirectedSurface, RevolutionSurface,
                             CoonsPatch, GordonSurface, OffsetSurface, IdSurface>;

/// Cylinder over a curve (or plane over a line): along `direction` by its length.
[[nodiscard]] DirectedSurface cylinder_over(const SpaceCurve& directrix, Vec3 direction);
/// Cone from a curve to a point.
[[nodiscard]] RuledSurface cone_over(const SpaceCurve& directrix, Vec3 apex);

/// "ruled surface between two curves", ...
[[nodiscard]] std::string kind_of(const Surface& surface);
[[nodiscard]] Range domain_u(const Surface& surface);
[[nodiscard]] Range domain_v(const Surface& surface);
/// Point and derivatives straight from the definition, not by way of `to_nurbs`, of a surface that
/// `to_nurbs` accepts. Where the base of an offset has no normal, as in a pole, the point is the
/// limit from inside and the derivatives are those of the base.
[[nodiscard]] SurfaceJet evaluate(const Surface& surface, double u, double v);

/// A surface as NURBS, over the same parameters, and how far they are apart at most.
struct NurbsForm {
  NurbsSurface surface;
  double deviation = 0.0;  ///< units; 0: exactly the same surface apart from rounding
};

/// Ruled and directed surfaces, revolutions, Coons and Gordon of polynomial curves and ID surfaces
/// become NURBS exactly, offsets of planes too. Between rational curves of different weights the
/// degrees add; where the sum is above `kMaxNurbsDegree` the rulings of a ruled surface are the
/// same, but v runs along each of them projectively, and `deviation` tells how far that is. Other
/// offsets and Coons or Gordon of rational curves come within the tolerance (units), measured
/// between the samples too.
///
/// Errors: E203 curves that do not meet (`value`: the gap), parameters out of order, a zero axis or
/// angle, directed surfaces of rational curves whose degrees are too high together; E303 numbers
/// that are not finite; E312 too few curves; E502 the tolerance cannot be reached within the limit
/// of knots; those of `check` for each curve.
[[nodiscard]] Result<NurbsForm> to_nurbs(const Surface& surface, double tolerance);

/// A closed line in the plane of a patch's parameters (x is u, y is v): each curve begins where the
/// one before ends, the first where the last one does. What is there lies to its left.
struct TrimLoop {
  std::vector<NurbsCurve> curves;
};

/// One patch of a model with its name, and what of it is there: the parameters that an odd number
/// of loops goes around; without loops all of it.
struct SurfacePatch {
  std::string name;
  NurbsSurface surface;
  std::vector<TrimLoop> trims{};
  double trims_within = 0.0;  ///< units: how far trims may lie from what they stand for, along the
                              ///< surface; 0: exact, or not known
};

/// The surface as `check(NurbsSurface)` has it, and its loops: curves as `check(NurbsCurve)` has
/// them, that meet end to end within 1e-9 of the domain and do not leave it by more. Errors: those
/// of both; E203 otherwise.
[[nodiscard]] Result<void> check(const SurfacePatch& patch);

/// What is written to files: patches in order, neighbours share borders where they meet.
struct SurfaceModel {
  std::string name = "surface";
  Units units;
  std::vector<SurfacePatch> patches;
};

[[nodiscard]] bool is_trimmed(const SurfaceModel& model);

/// The surfaces of all patches, in order; valid as long as the model is.
[[nodiscard]] std::vector<const NurbsSurface*> surfaces_of(const SurfaceModel& model);

/// Diagonal of the box of all control points, units; 0 without any.
[[nodiscard]] double size_of(const SurfaceModel& model);
[[nodiscard]] double size_of(const std::vector<const NurbsSurface*>& surfaces);

}  // namespace obvid
