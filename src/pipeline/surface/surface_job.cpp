// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/surface_job.h"

#include <fmt/format.h>

#include "fit/prepare.h"
#include "surface/surface_kinds.h"

namespace obvid {

Result<MadeSurface> make_surface(const SurfaceJob& job, const RunContext& run) {
  OBVID_TRY(pipeline_detail::check_noise_in_space(job.curves.sections));
  OBVID_TRY(may_go_on(run));
  auto made = std::visit(
      [&](const auto& kind) { return pipeline_detail::make_kind(kind, job, run); }, job.kind);
  if (made && job.units) {
    if (auto told = take_units(made->model.units, *job.units)) made->warnings.push_back(*told);
  }
  return made;
}

std::optional<Error> not_proved(const MadeSurface& made) {
  if (!made.skin) return std::nullopt;
  const std::size_t fair = made.skin->skin.sections.size() - made.skin->points - made.skin->plain;
  if (made.skin->proved == fair) return std::nullopt;
  return error(ErrorCode::kNotProved,
               fmt::format("{} of {} section contours were formed but not proved",
                           fair - made.skin->proved, fair));
}

}  // namespace obvid
