// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/surface_job.h"

#include <fmt/format.h>

#include "surface/surface_kinds.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

Result<MadeSurface> made_by(const SurfaceJob& job, const RunContext& run) {
  switch (job.kind) {
    case SurfaceKind::kRuled:
      return make_ruled(job, run);
    case SurfaceKind::kRevolve:
      return make_revolution(job);
    case SurfaceKind::kCoons:
      return make_coons(job);
    case SurfaceKind::kGordon:
      return make_gordon(job);
    case SurfaceKind::kGrid:
      return make_grid(job, run);
    case SurfaceKind::kSkin:
      return make_skin(job, run);
    case SurfaceKind::kOffset:
      return make_offset(job);
    case SurfaceKind::kId:
      return make_id(job);
    case SurfaceKind::kConvert:
      return make_converted(job);
  }
  return fail({ErrorCode::kInternal, "unknown kind of surface", "", "", -1, 0.0});
}

}  // namespace

Result<MadeSurface> make_surface(const SurfaceJob& job, const RunContext& run) {
  auto made = made_by(job, run);
  if (made && job.units) {
    if (auto told = take_units(made->model.units, *job.units)) made->warnings.push_back(*told);
  }
  return made;
}

std::optional<Error> not_proved(const MadeSurface& made) {
  if (!made.skin) return std::nullopt;
  const std::size_t fair = made.skin->skin.sections.size() - made.skin->points - made.skin->plain;
  if (made.skin->proved == fair) return std::nullopt;
  return Error{ErrorCode::kNotProved,
               fmt::format("{} of {} section contours were formed but not proved",
                           fair - made.skin->proved, fair),
               "", ""};
}

}  // namespace obvid
