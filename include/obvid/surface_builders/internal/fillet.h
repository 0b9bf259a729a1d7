// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// What side of a face the ball is on.
enum class BallSide {
  kAutomatic,  ///< where the faces bend to each other along the border that they share
  kFront,      ///< where its normal du x dv points to
  kBack,
};

struct FilletOptions {
  double radius = 0.0;      ///< units, > 0
  double radius_end = 0.0;  ///< units, > 0: at the other end; linear along the spine's arc length
  std::array<BallSide, 2> sides{BallSide::kAutomatic, BallSide::kAutomatic};
  double tolerance = 0.0;  ///< units, > 0
};

/// How a blend meets one of its faces.
struct FilletContact {
  /// Parameters of the face where the ball touches it, in order. Faces that close on themselves: on
  /// beyond the domain, by whole turns. Closed lines end with their first place again.
  std::vector<Vec2> places;
  Range along;            ///< v of the blend that lies on the face
  double distance = 0.0;  ///< units: largest distance of the blend's border from the face
  double angle = 0.0;     ///< rad: largest angle between the tangent planes there
  Vec3 distance_at, angle_at;
  std::size_t measured = 0;  ///< places that were measured before the extremes were climbed to
};

/// The surface that a ball leaves free as it rolls along two faces.
struct Fillet {
  /// u from the first face (0) to the second (1), an arc of a circle; v in [0, 1] along the spine
  /// by arc length.
  NurbsSurface surface;
  std::vector<TrimLoop> trims;  ///< where the contact with one face ends before that with the other
  bool closed = false;
  double length = 0.0;     ///< units, of the spine
  double deviation = 0.0;  ///< units: largest distance found from the exact arcs, measured at three
                           ///< places of each span along v and five across
  Vec3 from, to;           ///< ends of the spine
  double radius_from = 0.0, radius_to = 0.0;  ///< of the balls there
  std::array<FilletContact, 2> contacts;
};

/// All blends of a rolling ball between two faces: its centre runs where the offsets of both cross
/// (the spine), which is traced by Runge-Kutta's steps of at most 0.1 rad, corrected by Newton's
/// method; sections are the arcs of the characteristic circles of the balls (derivation:
/// docs/methods/blends.md), exact as rational quadratics (Piegl, Tiller 1997, 7.3), and tangent to
/// both faces for a radius that varies, too; along the spine C2 cubics of the homogeneous
/// coordinates through as many sections as `tolerance` needs. Where one face ends before the other
/// the blend's end is trimmed.
///
/// Spines are looked for on rasters of 49 x 49 places of both faces: those that cross none of
/// their cells are missed, and of several within a cell all but one. A hole of a face in the ball's
/// way is refused where one of 31 places between two steps shows it. That the ball touches nothing
/// but the two places is not looked at elsewhere than near them. Distances, angles and deviation
/// are measured, not proved.
///
/// Errors: E203 radii or tolerance, sides that have to be told; E310 a face that ends long before
/// the other, arcs near a half circle; E311 no ball of this radius touches
/// both faces; E408 a face bends more than the ball (`value`: its radius), the blend folds, or the
/// ball cannot go on; E502 more than 2,000 sections; E103.
[[nodiscard]] Result<std::vector<Fillet>> fillets_between(
    const std::array<const SurfacePatch*, 2>& faces, const FilletOptions& options,
    const RunContext& run = {});

/// The border of a blend on a face (0 or 1), as far as it lies on it.
[[nodiscard]] SpaceCurve contact_curve(const Fillet& fillet, std::size_t face);

}  // namespace obvid
