// SPDX-License-Identifier: Apache-2.0
// Surfaces near points in any order.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "surface/cloud_input.h"
#include "surface/surface_kinds.h"

namespace obvid::pipeline_detail {
namespace {

std::string place(Vec3 p) {
  p = p + Vec3{};  // -0 becomes 0
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

std::string left_out_text(const ScatteredSurface& made, const std::vector<Vec3>& points,
                          bool dropped, const std::string& units) {
  constexpr std::size_t kMostNamed = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMostNamed, made.outliers.size()); ++k) {
    const ScatterOutlier& one = made.outliers[k];
    text += fmt::format("{}{} {} by {:+.4g} {}", k == 0 ? "" : ", ", one.point + 1,
                        place(points[one.point]), one.off, units);
  }
  text += and_more(made.outliers.size(), kMostNamed);
  return fmt::format(
      "{}: {} off their neighbours: {}",
      dropped ? "--drop-outliers: left out" : "kept, --drop-outliers leaves them out",
      made.outliers.size() == 1 ? "a point" : "points", text);
}

std::string empty_text(const EmptyParts& empty, const std::string& units) {
  return fmt::format(
      "{:.3g} % of the rectangle ({} places looked at) lie farther than {:.4g} {} from every "
      "point, "
      "at most {}: at {}",
      100.0 * empty.share, empty.raster, empty.reach, units, significant_above(empty.farthest, 4),
      place(empty.where));
}

}  // namespace

Result<MadeSurface> made_near_points(ScatterOptions options, const std::optional<Vec3>& up,
                                     const SurfaceJob& job, const RunContext& run) {
  if (job.inputs.size() != 1) {
    return error(ErrorCode::kUsage, "one file of points is needed")
        .value(static_cast<double>(job.inputs.size()));
  }
  auto cloud = cloud_of(job.inputs.front());
  OBVID_TRY(cloud);
  const std::vector<Vec3>& points = cloud->points.points;
  options.up = up ? *up : plane_of(points).normal();
  auto fitted = scattered(points, options, run);
  if (!fitted) {
    Error refused = fitted.error();
    if (refused.where.empty()) refused.where = job.inputs.front().name;
    return fail(refused);
  }
  MadeSurface made;
  made.kind = fmt::format("near {} points in no order", fitted->used);
  made.model.name = cloud->points.name.empty() ? "surface" : cloud->points.name;
  made.model.units = cloud->points.units;
  made.model.patches.push_back({made.model.name, std::move(fitted->surface)});
  const Units said = job.units.value_or(cloud->points.units);
  const std::string units = said.text();
  const std::string& name = job.inputs.front().name;
  if (!cloud->assumed.empty()) {
    made.warnings.push_back(fmt::format("{}: {}", name, cloud->assumed));
  }
  made.facts.emplace_back("heights along",
                          fmt::format("{}, {}", place(fitted->plane.normal()),
                                      up ? "as given" : "normal of the best plane (--up)"));
  made.facts.emplace_back("rectangle",
                          fmt::format("{:.6g} x {:.6g} {}", fitted->width, fitted->depth, units));
  made.facts.emplace_back(
      "from the points",
      fmt::format("{} {} at most (point {}), root mean square {} {}, along the heights",
                  significant_above(fitted->deviation, 4), units, fitted->farthest + 1,
                  significant(fitted->root_mean_square, 3), units));
  made.facts.emplace_back("bending", fmt::format("{:.4g}; weight {:.3g} {}^2 beside the sum of "
                                                 "squares",
                                                 fitted->bending, fitted->weight, units));
  made.facts.emplace_back("outliers",
                          fitted->outliers.empty()
                              ? "none"
                              : fmt::format("{}, {}", fitted->outliers.size(),
                                            options.drop_outliers ? "left out" : "kept"));
  const EmptyParts& empty = fitted->empty;
  if (!fitted->outliers.empty()) {
    made.warnings.push_back(name + ": " +
                            left_out_text(*fitted, points, options.drop_outliers, units));
  }
  if (empty.share > 0.0) {
    made.facts.emplace_back("without data", empty_text(empty, units));
    made.warnings.push_back(
        fmt::format("{}: {:.3g} % of the surface has no points near it and is only the smoothest "
                    "there; the report says where",
                    name, 100.0 * empty.share));
  }
  made.scatter = std::move(*fitted);
  return made;
}

}  // namespace obvid::pipeline_detail
