// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/surface/internal/trim.h"
#include "obvid/surface_cut/internal/trim.h"
#include "surface/surface_kinds.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kTrimTolerance = 1e-6;  ///< of the size

/// The contour in the plane across the axis. One that lies in z = 0 is taken in the coordinates of
/// that plane, as `surface cut` writes sections: y, z across x; x, z across y.
ProjectedContour projected(const SpaceCurve& curve, std::size_t along) {
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const std::array<Frame, 3> frames = {Frame{{}, y, z}, Frame{{}, x, z}, Frame{{}, x, y}};
  const Frame& frame = frames[along];
  const bool flat =
      std::all_of(curve.points.begin(), curve.points.end(), [](Vec3 p) { return p.z == 0.0; });
  NurbsCurve plane{curve.degree, curve.knots, {}, curve.weights};
  for (const Vec3 p : curve.points)
    plane.points.push_back(flat ? Vec2{p.x, p.y} : frame.in_plane(p));
  return {frame, {std::move(plane)}};
}

struct Sums {
  std::size_t trims = 0;
  PatchArea area;
};

Result<Sums> sums_of(const SurfaceModel& model, const RunContext& run) {
  Sums out;
  for (const SurfacePatch& patch : model.patches) {
    const auto area = area_of(patch, run);
    OBVID_TRY(area);
    out.area.value += area->value;
    out.area.error += area->error;
    out.area.of_trims += area->of_trims;
    out.trims += patch.trims.size();
  }
  return out;
}

}  // namespace

Result<MadeSurface> made_trimmed(const TrimmedBy& by, const SurfaceJob& job,
                                 const RunContext& run) {
  auto read = as_read(job, run);
  OBVID_TRY(read);
  MadeSurface made = std::move(*read);
  const TrimOptions options{job.tolerance.value_or(kTrimTolerance * size_of(made.model)),
                            by.keep_positive};
  const std::size_t cuts = by.planes.size() + (by.contour ? 1 : 0);
  std::string followed;
  const auto take = [&](const std::string& cut, Result<TrimmedModel> part) -> Result<void> {
    OBVID_TRY(part);
    made.deviation = std::max(made.deviation, part->deviation);
    made.facts.emplace_back(
        cuts == 1 ? "left" : "left by the " + cut,
        fmt::format("{} whole, {} trimmed, {} gone", part->whole, part->cut, part->dropped));
    made.model = std::move(part->model);
    return {};
  };
  if (by.contour) {
    auto curve = read_space_curve(*by.contour, job.curves, run);
    OBVID_TRY(curve);
    const std::array both{made.model.units, curve->units};
    OBVID_TRY(common_units(both, curve->name));
    made.warnings.insert(made.warnings.end(), curve->warnings.begin(), curve->warnings.end());
    OBVID_TRY(
        take("contour", trimmed(made.model, projected(curve->curve, by.along), options, run)));
    if (curve->deviation > 0.0) {
      followed = fmt::format("; the contour is followed within {} {}",
                             significant_above(curve->deviation, 3), made.model.units.text());
    }
    made.kind = fmt::format("part {} a contour", by.keep_positive ? "inside" : "outside");
  }
  for (std::size_t i = 0; i < by.planes.size(); ++i) {
    const std::string cut = by.planes.size() == 1 ? "plane" : fmt::format("plane {}", i + 1);
    OBVID_TRY(take(cut, trimmed(made.model, by.planes[i], options, run)));
    made.kind = fmt::format("part {} {}", by.keep_positive ? "above" : "below",
                            by.planes.size() == 1 ? "a plane" : "planes");
  }
  const auto sums = sums_of(made.model, run);
  OBVID_TRY(sums);
  const std::string unit = made.model.units.text();
  made.facts.emplace_back("trims",
                          fmt::format("{}, within {} {} of the cut, as measured{}",
                                      counted(sums->trims, "loop", "loops"),
                                      significant_above(made.deviation, 3), unit, followed));
  made.facts.emplace_back(
      "area",
      fmt::format("{} {}^2, within {}: the last step of its sum changed {}, the trims' own "
                  "distance makes {}",
                  significant(sums->area.value, 10), unit, significant_above(sums->area.error, 2),
                  significant(sums->area.error - sums->area.of_trims, 2),
                  significant(sums->area.of_trims, 2)));
  return made;
}

}  // namespace obvid::pipeline_detail
