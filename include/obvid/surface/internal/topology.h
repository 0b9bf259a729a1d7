// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// Corners and borders nearer to each other than this part of the model's size are the same: in
/// meshes, CAD files, pages and tool paths. `check` says which these are (`shared`), and measures
/// all that come as near as `kMeeting` (docs/decisions/0015).
inline constexpr double kSameBorder = 1e-7;

/// The sides of a patch; each runs with its parameter.
enum PatchSide : std::size_t { kUStart, kUEnd, kVStart, kVEnd };
inline constexpr std::array<PatchSide, 4> kPatchSides = {kUStart, kUEnd, kVStart, kVEnd};
[[nodiscard]] constexpr bool runs_along_u(PatchSide side) { return side >= kVStart; }
[[nodiscard]] constexpr bool is_far_end(PatchSide side) { return side % 2 == 1; }
[[nodiscard]] constexpr PatchSide opposite(PatchSide side) { return kPatchSides[side ^ 1U]; }

/// A side as a curve, exact.
[[nodiscard]] SpaceCurve border_of(const NurbsSurface& surface, PatchSide side);

/// Where corners of patches meet.
struct TopologyVertex {
  Vec3 point;        ///< the first of the corners
  double gap = 0.0;  ///< units: largest distance of the others from it
};

/// A patch at an edge.
struct EdgeUse {
  std::size_t patch = 0;
  PatchSide side = kUStart;
  bool along = true;              ///< the side runs as the edge does
  bool other_parameters = false;  ///< the same curve, parametrised differently
  double gap = 0.0;               ///< units: largest distance of the side from the edge's curve
};

/// A border, of one patch or of several.
struct TopologyEdge {
  SpaceCurve curve;              ///< the first side
  std::size_t from = 0, to = 0;  ///< vertices; the same for closed curves and points
  bool point = false;            ///< the side shrinks to a point
  std::vector<EdgeUse> uses;     ///< the first one first; none but that for a point
};

/// How the patches of a model meet.
struct Topology {
  std::vector<TopologyVertex> vertices;
  std::vector<TopologyEdge> edges;
  std::vector<std::array<std::size_t, 4>> edge_of;  ///< of each patch and `PatchSide`

  /// How a patch lies at the edge of one of its sides.
  [[nodiscard]] const EdgeUse& use(std::size_t patch, PatchSide side) const;
};

/// Corners within the tolerance (units, >= 0) are one vertex. Sides between the same vertices are
/// one edge when they are the same curve within the tolerance, in either direction: point for point
/// at the same parts of their parameters, or else each point on the other curve, in order. Sides
/// meet as wholes only: one that meets parts of two others has an edge of its own. The tolerance
/// holds towards the first side and corner; compared at every knot and three places between, so a
/// difference inside one span may be missed. O(patches + border spans), apart from many borders
/// between the same two vertices. Reentrant.
[[nodiscard]] Topology topology_of(const std::vector<const NurbsSurface*>& patches,
                                   double tolerance);
/// With `kSameBorder` of the model's size.
[[nodiscard]] Topology topology_of(const SurfaceModel& model);

/// The parameter of a curve's point that is nearest to a point (of several the first found), from
/// the nearest of some places per span.
[[nodiscard]] double nearest_parameter(const SpaceCurve& curve, Vec3 point);

}  // namespace obvid
