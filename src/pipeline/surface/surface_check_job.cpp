// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/surface_check_job.h"

#include "obvid/pipeline/internal/surface_report_json.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "obvid/core/files.h"
#include "surface/cloud_input.h"

namespace obvid {
namespace {

struct Reference {
  Units units;
  std::optional<SurfaceModel> surface;
  std::vector<Vec3> points;
};

/// What a file of measured points or a stored surface holds.
Result<Reference> reference_of(const SurfaceInput& against, std::vector<std::string>& warnings,
                               const RunContext& run) {
  SurfaceInput input = against;
  if (input.is_file()) {
    auto text = read_file(input.name);
    OBVID_TRY(text);
    input.text = std::move(*text);
  }
  Reference out;
  if (input.text && pipeline_detail::holds_surface(*input.text, input.name)) {
    auto surface = read_surface(input, warnings, run);
    OBVID_TRY(surface);
    out.units = surface->units;
    out.surface = std::move(*surface);
    return out;
  }
  auto cloud = pipeline_detail::cloud_of(input);
  OBVID_TRY(cloud);
  if (!cloud->assumed.empty()) {
    warnings.push_back(fmt::format("{}: {}", input.name, cloud->assumed));
  }
  out.units = cloud->points.units;
  out.points = std::move(cloud->points.points);
  return out;
}

Result<SurfaceDeviation> measured_against_it(const SurfaceModel& model, const SurfaceInput& against,
                                             Result<Reference> reference, std::size_t samples,
                                             const RunContext& run) {
  OBVID_TRY(reference);
  const std::array both{model.units, reference->units};
  OBVID_TRY(common_units(both, against.name));
  OBVID_TRY(tell(run, "deviation", 0.0));
  SurfaceDeviation out;
  out.against = against.name;
  const NearestOnModel on_this(model);
  if (!reference->surface) {
    out.points = true;
    auto found = deviation_of(reference->points, on_this, run);
    OBVID_TRY(found);
    out.found = std::move(*found);
    for (std::size_t i = 0; i < reference->points.size(); ++i) {
      out.shown.dots.push_back({reference->points[i], out.found.offs[i]});
    }
  } else {
    const auto other = std::make_shared<const SurfaceModel>(std::move(*reference->surface));
    const auto on_other = std::make_shared<const NearestOnModel>(*other);
    auto found = deviation_of(model, *on_other, samples, run);
    OBVID_TRY(found);
    out.found = std::move(*found);
    OBVID_TRY(tell(run, "deviation", 0.5));
    auto back = deviation_of(*other, on_this, samples, run);
    OBVID_TRY(back);
    out.back = std::move(*back);
    out.shown.of_place = [other, on_other](Vec3 p) { return on_other->at(p).off; };
  }
  out.shown.title = fmt::format("{} {}", out.points ? "Points of" : "Distance from", against.name);
  out.shown.told = {out.found.least.off, out.found.most.off};
  return out;
}

}  // namespace

Result<SurfaceDeviation> measured_against(const SurfaceModel& model, const SurfaceInput& against,
                                          std::size_t samples, std::vector<std::string>& warnings,
                                          const RunContext& run) {
  return measured_against_it(model, against, reference_of(against, warnings, run), samples, run);
}

Result<CheckedSurface> check_surface(const SurfaceModel& model, const SurfaceCheckJob& job,
                                     const RunContext& run) {
  CheckedSurface out;
  std::optional<Reference> reference;  // what cannot be read is told before anything is measured
  if (job.against) {
    auto found = reference_of(*job.against, out.warnings, run);
    OBVID_TRY(found);
    reference = std::move(*found);
  }
  auto check = check_surface(model, job.check, run);
  OBVID_TRY(check);
  out.check = std::move(*check);
  if (is_trimmed(model)) {
    out.warnings.push_back(
        "trimmed patches: areas and ranges of curvature are those inside the trims; lines of "
        "constant parameters run over whole patches");
  }
  if (!job.against) return out;
  auto deviation =
      measured_against_it(model, *job.against, std::move(*reference), job.check.samples, run);
  OBVID_TRY(deviation);
  out.deviation = std::move(*deviation);
  return out;
}

void show_findings(const CheckedSurface& checked, SurfaceExportOptions& formats) {
  if (checked.deviation) formats.deviation = checked.deviation->shown;
  if (!checked.check.patches.empty()) formats.extremes = extremes_of(checked.check);
}

}  // namespace obvid
