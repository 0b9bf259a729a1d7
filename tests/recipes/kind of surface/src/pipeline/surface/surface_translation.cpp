// SPDX-License-Identifier: Apache-2.0
// Only for tests/recipes: one curve moved along another.
#include "obvid/geom/internal/box.h"
#include "surface/surface_kinds.h"

namespace obvid::pipeline_detail {

Result<MadeSurface> make_kind(const TranslationKind& /*kind*/, const SurfaceJob& job,
                              const RunContext& /*run*/) {
  if (job.inputs.size() != 2) return fail(error(ErrorCode::kUsage, "two curves are needed"));
  const auto one = read_space_curve(job.inputs.front(), job.curves);
  OBVID_TRY(one);
  const auto other = read_space_curve(job.inputs.back(), job.curves);
  OBVID_TRY(other);
  SpaceCurve way = other->curve;
  const Vec3 start = way.points.front();
  for (Vec3& p : way.points) p = p - start;
  auto made =
      made_of(TranslationSurface{one->curve, way}, "translation",
              farthest_from_first(one->curve.points) + farthest_from_first(way.points), job);
  if (made) made->model.units = one->units;
  return made;
}

}  // namespace obvid::pipeline_detail
