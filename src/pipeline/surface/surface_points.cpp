// SPDX-License-Identifier: Apache-2.0
// Surfaces of points: grids, sections, integro-differential splines.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/geom/internal/box.h"
#include "obvid/surface/internal/enclosed.h"
#include "obvid/surface_builders/internal/approximate.h"
#include "surface/surface_inputs.h"
#include "surface/surface_kinds.h"

namespace obvid::pipeline_detail {
namespace {

MadeSurface of_one_patch(const PointGrid& grid, NurbsSurface surface) {
  MadeSurface made;
  made.model.name = grid.name.empty() ? "surface" : grid.name;
  made.model.units = grid.units;
  made.model.patches.push_back({made.model.name, std::move(surface)});
  turn_outward(made.model.patches);
  made.facts.emplace_back("grid", fmt::format("{} rows of {} points", grid.count_v, grid.count_u));
  return made;
}

Result<MadeSurface> near(const PointGrid& grid, const SurfaceJob& job, const RunContext& run) {
  const double tolerance =
      job.tolerance.value_or(kSurfaceTolerance * bounding_diagonal(grid.points));
  auto surface = approximated(grid, tolerance, run);
  OBVID_TRY(surface);
  MadeSurface made = of_one_patch(grid, std::move(surface->surface));
  const std::string units = job.units.value_or(grid.units).text();
  made.kind = "least squares near a grid of points";
  made.facts.emplace_back(
      "from the points",
      fmt::format("{} {} at most, root mean square {} {}", significant_above(surface->deviation, 4),
                  units, significant(surface->root_mean_square, 3), units));
  return made;
}

/// Nodes, and one coordinate at them.
IdSpline2dData id_data(const PointGrid& grid, const std::vector<double>& u,
                       const std::vector<double>& v, double Vec3::*coordinate) {
  IdSpline2dData data;
  data.x = u;
  data.y = v;
  for (const Vec3& p : grid.points) data.values.push_back(p.*coordinate);
  return data;
}

/// Lines of the skin at its sections: through all patches, one after the other.
std::vector<ScenePolyline> drawn_sections(const Skin& skin) {
  std::vector<ScenePolyline> lines;
  for (const SkinSectionReport& section : skin.sections) {
    ScenePolyline line{{}, "section"};
    for (const SurfacePatch& patch : skin.patches) {
      const ScenePolyline part = drawn(isocurve_at_v(patch.surface, section.parameter));
      line.points.insert(line.points.end(), part.points.begin(), part.points.end());
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// A matrix may be something else than heights, say one coordinate of a grid.
void say_of_heights(const PointGrid& grid, const GridReading& reading, MadeSurface& made) {
  if (!grid.of_heights || reading.spacing) return;
  made.warnings.push_back(
      fmt::format("{} rows of {} numbers are taken for heights, x and y for column and row; "
                  "--spacing says how far these are apart, and files of x, y and z belong together "
                  "by names that differ in one letter (_x, _y, _z)",
                  grid.count_v, grid.count_u));
}

}  // namespace

Result<MadeSurface> make_kind(const GridKind& kind, const SurfaceJob& job, const RunContext& run) {
  const auto grid = grid_of(job.inputs, kind.reading);
  OBVID_TRY(grid);
  if (kind.use == GridUse::kNear) {
    auto made = near(*grid, job, run);
    if (made) say_of_heights(*grid, kind.reading, *made);
    return made;
  }
  const bool control = kind.use == GridUse::kControl;
  auto surface = control ? from_control_points(*grid) : interpolated(*grid, kind.reading.spread);
  OBVID_TRY(surface);
  MadeSurface made = of_one_patch(*grid, std::move(*surface));
  say_of_heights(*grid, kind.reading, made);
  if (control) {
    const NurbsSurface& net = made.model.patches.front().surface;
    made.facts.emplace_back("assumed", fmt::format("degree {} along rows, {} across, uniform knots",
                                                   net.degree_u, net.degree_v));
  }
  made.kind = control ? "controlled by a grid of points" : "through a grid of points";
  return made;
}

Result<MadeSurface> make_kind(const IdKind& kind, const SurfaceJob& job, const RunContext&) {
  const auto grid = grid_of(job.inputs, kind.reading);
  OBVID_TRY(grid);
  const auto u = grid_parameters(*grid, true, kind.reading.spread);
  OBVID_TRY(u);
  const auto v = grid_parameters(*grid, false, kind.reading.spread);
  OBVID_TRY(v);
  IdSurface surface;
  for (const auto& [spline, coordinate] :
       {std::pair{&surface.x, &Vec3::x}, {&surface.y, &Vec3::y}, {&surface.z, &Vec3::z}}) {
    auto made = id_spline_2d(id_data(*grid, *u, *v, coordinate), kind.smooth);
    OBVID_TRY(made);
    *spline = std::move(*made);
  }
  auto made = made_of(surface, grid->name.empty() ? "surface" : grid->name,
                      bounding_diagonal(grid->points), job);
  if (made) {
    made->model.units = grid->units;
    say_of_heights(*grid, kind.reading, *made);
    made->facts.emplace_back("grid",
                             fmt::format("{} rows of {} points", grid->count_v, grid->count_u));
  }
  return made;
}

Result<MadeSurface> make_kind(const SkinKind& kind, const SurfaceJob& job, const RunContext& run) {
  std::vector<std::string> assumed;
  const auto sections = sections_of(job.inputs, kind.spacing, &assumed, run);
  OBVID_TRY(sections);
  std::vector<Units> units;
  for (const SpaceSeries& section : *sections) units.push_back(section.units);
  auto unit = common_units(units, job.inputs.front().name);
  OBVID_TRY(unit);
  SkinJob how;
  how.units = *unit;
  how.sections = job.curves.sections;
  how.tolerance = job.tolerance;
  how.matching = kind.matching;
  how.straight_across = kind.straight_across;
  how.light = kind.light;
  how.fair_across = kind.fair_across;
  how.plain_when_refused = job.curves.plain_when_refused;
  auto fitted = fit_skin(*sections, how, run);
  // stations with cells of their own show a knuckle here and none there
  const bool table = !assumed.empty() && how.sections.find_corners;
  if (!fitted && table && fitted.error().code == ErrorCode::kBadOption) {
    how.sections.find_corners = false;
    if (auto smooth = fit_skin(*sections, how, run)) {
      assumed.push_back(
          fmt::format("{}: the stations differ in their number of corners, so none is "
                      "looked for (--no-corners)",
                      job.inputs.front().name));
      fitted = std::move(smooth);
    }
  }
  OBVID_TRY(fitted);
  MadeSurface made;
  made.kind = fmt::format("skin through {} sections", sections->size());
  const std::string stem = std::filesystem::path(job.inputs.front().name).stem().string();
  made.model.name = job.inputs.size() == 1 ? stem : "skin";
  made.model.units = std::move(*unit);
  made.model.patches = fitted->skin.patches;
  made.lines = drawn_sections(fitted->skin);
  made.warnings = std::move(assumed);
  made.warnings.insert(made.warnings.end(), fitted->warnings.begin(), fitted->warnings.end());
  made.beside_longitudinals.before = std::move(fitted->skin.exact);
  for (const SkinSectionReport& section : fitted->skin.sections) {
    made.beside_longitudinals.sections.push_back(section.parameter);
  }
  made.skin = std::move(*fitted);
  return made;
}

Result<MadeSurface> make_kind(const ScatterKind& kind, const SurfaceJob& job,
                              const RunContext& run) {
  ScatterOptions options;
  options.tolerance = job.tolerance.value_or(0.0);
  options.steepest = kind.steepest;
  options.drop_outliers = kind.drop_outliers;
  return made_near_points(options, kind.up, job, run);
}

}  // namespace obvid::pipeline_detail
