// SPDX-License-Identifier: Apache-2.0
#include "page/values.h"

#include "obvid/surface/internal/topology.h"

namespace obvid::picture {
namespace {

/// How far inside normals are compared: part of the domain.
constexpr double kInside = 1e-4;
/// Cosine of the angle between the normals of both sides of a smooth seam: 1.8 degrees.
constexpr double kSmooth = 0.9995;
constexpr int kPlaces = 12;

/// The normal beside a border, by the part of the domain along it.
Vec3 normal_beside(const NurbsSurface& s, PatchSide side, double along) {
  const Range u = domain_u(s), v = domain_v(s);
  const double across = is_far_end(side) ? 1.0 - kInside : kInside;
  const SurfaceJet jet = runs_along_u(side) ? evaluate(s, u.at(along), v.at(across))
                                            : evaluate(s, u.at(across), v.at(along));
  return curvature(jet).normal;
}

/// A closed patch goes on smoothly on the other side; the ends may be poles.
bool is_smooth_seam(const NurbsSurface& s, PatchSide side) {
  for (int k = 1; k < kPlaces; ++k) {
    const double along = static_cast<double>(k) / kPlaces;
    const Vec3 here = normal_beside(s, side, along);
    if (dot(here, normal_beside(s, opposite(side), along)) < kSmooth) return false;
  }
  return true;
}

/// The patch meets itself there and nothing else.
bool is_seam(const TopologyEdge& edge) {
  return edge.uses.size() == 2 && edge.uses[0].patch == edge.uses[1].patch &&
         edge.uses[0].along == edge.uses[1].along &&
         opposite(edge.uses[0].side) == edge.uses[1].side;
}

}  // namespace

std::vector<std::array<bool, 4>> real_borders(const SurfaceModel& model) {
  const Topology topology = topology_of(model);
  std::vector<std::array<bool, 4>> real(model.patches.size());
  for (std::size_t i = 0; i < real.size(); ++i) {
    const NurbsSurface& surface = model.patches[i].surface;
    for (const PatchSide side : kPatchSides) {
      const TopologyEdge& edge = topology.edges[topology.edge_of[i][side]];
      real[i][side] = !edge.point && !(is_seam(edge) && is_smooth_seam(surface, side));
    }
  }
  return real;
}

}  // namespace obvid::picture
