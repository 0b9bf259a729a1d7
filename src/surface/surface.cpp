// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/surface.h"

#include "kinds.h"
#include "obvid/geom/internal/box.h"

namespace obvid {

std::string kind_of(const Surface& surface) { return name_of_any(surface); }

Range domain_u(const Surface& surface) { return ranges_of_any(surface)[0]; }
Range domain_v(const Surface& surface) { return ranges_of_any(surface)[1]; }

SurfaceJet evaluate(const Surface& surface, double u, double v) {
  return evaluate_any(surface, u, v);
}

Result<NurbsForm> to_nurbs(const Surface& surface, double tolerance) {
  return nurbs_of_any(surface, tolerance);
}

Result<NurbsForm> nurbs_of(const NurbsSurface& s, double) {
  OBVID_TRY(check(s));
  return NurbsForm{s, 0.0};
}

std::vector<const NurbsSurface*> surfaces_of(const SurfaceModel& model) {
  std::vector<const NurbsSurface*> surfaces;
  for (const SurfacePatch& patch : model.patches) surfaces.push_back(&patch.surface);
  return surfaces;
}

double size_of(const SurfaceModel& model) { return size_of(surfaces_of(model)); }

double size_of(const std::vector<const NurbsSurface*>& surfaces) {
  Box3 box;
  for (const NurbsSurface* surface : surfaces) box.add_all(surface->points);
  return box.diagonal();
}

}  // namespace obvid
