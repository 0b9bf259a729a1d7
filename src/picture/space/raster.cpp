// SPDX-License-Identifier: Apache-2.0
#include "space/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "obvid/geom/internal/box.h"
#include "obvid/geom/internal/directions.h"
#include "obvid/surface/internal/trim.h"

namespace obvid::picture {
namespace {

/// Places at which a direction is explored, and rows of them.
constexpr std::size_t kLeastPlaces = 48, kMostPlaces = 400;
constexpr std::size_t kPlacesPerSpan = 4;
constexpr std::size_t kRows = 7;
/// A turn of the normal by one radian counts as much as this part of the size.
constexpr double kTurnWeight = 0.25;
/// What every stretch of the parameters counts at least, part of the whole.
constexpr double kLeastShare = 0.05;
constexpr std::size_t kMostRasterCells = 500;  // in one direction of a patch

/// How much a patch is worth drawing along one direction: sums up to each explored parameter.
struct Effort {
  std::vector<double> parameters;
  std::vector<double> sums;
  [[nodiscard]] double total() const { return sums.back(); }

  /// Parameters that divide the effort into equal parts.
  [[nodiscard]] std::vector<double> divided(std::size_t cells) const {
    std::vector<double> at{parameters.front()};
    std::size_t k = 1;
    for (std::size_t i = 1; i < cells; ++i) {
      const double wanted = total() * static_cast<double>(i) / static_cast<double>(cells);
      while (k + 1 < sums.size() && sums[k] < wanted) ++k;
      const double step = sums[k] - sums[k - 1];
      const double part = step > 0.0 ? (wanted - sums[k - 1]) / step : 0.0;
      at.push_back(parameters[k - 1] + part * (parameters[k] - parameters[k - 1]));
    }
    at.push_back(parameters.back());
    return at;
  }
};

Effort effort_along(const NurbsSurface& surface, bool along_u, double patch_size, double model_size,
                    Watch* watch) {
  const Range range = along_u ? domain_u(surface) : domain_v(surface);
  const Range across = along_u ? domain_v(surface) : domain_u(surface);
  const std::size_t count = along_u ? surface.count_u() : surface.count_v();
  const std::size_t places = std::clamp(kPlacesPerSpan * count, kLeastPlaces, kMostPlaces);
  Effort effort;
  std::vector<double> steps(places, 0.0);
  for (std::size_t i = 0; i <= places; ++i) {
    effort.parameters.push_back(range.at(static_cast<double>(i) / static_cast<double>(places)));
  }
  for (std::size_t row = 0; row < kRows && !is_to_end(watch); ++row) {
    const double w = across.at(static_cast<double>(row) / (kRows - 1));
    Vec3 last_point, last_normal;
    for (std::size_t i = 0; i <= places; ++i) {
      const double t = effort.parameters[i];
      const double u = along_u ? t : w, v = along_u ? w : t;
      const Vec3 point = evaluate(surface, u, v).point;
      const Vec3 normal = curvature_at(surface, patch_size, u, v).normal;
      if (i > 0) {
        // turns count by the size of the patch: a small ball needs few facets
        steps[i - 1] += norm(point - last_point) / model_size +
                        kTurnWeight * angle_between(last_normal, normal) * patch_size / model_size;
      }
      last_point = point;
      last_normal = normal;
    }
  }
  double total = 0.0;
  for (const double step : steps) total += step / kRows;
  const double least = kLeastShare * total / static_cast<double>(places);
  effort.sums.push_back(0.0);
  for (const double step : steps) effort.sums.push_back(effort.sums.back() + step / kRows + least);
  return effort;
}

struct Plan {
  Effort u, v;
  [[nodiscard]] double share() const { return u.total() * v.total(); }
};

std::size_t cells(double wanted) {
  return std::clamp(static_cast<std::size_t>(std::max(1.0, std::floor(wanted))), std::size_t{1},
                    kMostRasterCells);
}

void add_vertex(const NurbsSurface& surface, double size, double u, double v,
                SurfaceColouring colouring, DrawnPatch& patch) {
  const SurfaceCurvature k = curvature_at(surface, size, u, v);
  patch.points.push_back(evaluate(surface, u, v).point);
  patch.normals.push_back(k.normal);
  if (is_curvature(colouring)) {
    patch.values.push_back(quantity(colouring, principal_at(surface, size, u, v)));
  }
}

/// The bands of a trimmed patch, n x m cells over the whole domain; rows are nearer to each other
/// towards the ends of a band, where trims may turn.
void add_bands(const SurfacePatch& patch, std::size_t number, std::size_t n, std::size_t m,
               SurfaceColouring colouring, Watch* watch, std::vector<DrawnPatch>& out) {
  constexpr double kLeastCells = 8.0;
  const NurbsSurface& surface = patch.surface;
  const double size = size_of(surface);
  const TrimRegion region(patch);
  for (const TrimBand& band : region.bands()) {
    const double high = band.v.length() / domain_v(surface).length();
    const double wide = region.across(band, band.v.at(0.5)).length() / domain_u(surface).length();
    const auto cells_of = [&](double share, std::size_t all) {
      return std::ceil(std::max(kLeastCells, share * static_cast<double>(all)));
    };
    DrawnPatch drawn;
    drawn.patch = number;
    const double columns = cells_of(wide, n), rows = cells_of(high, m);
    for (double k = 0.0; k <= columns; ++k) drawn.us.push_back(k / columns);
    for (double k = 0.0; k <= rows; ++k) {
      drawn.vs.push_back(0.5 - 0.5 * std::cos(std::numbers::pi * k / rows));
    }
    for (const double part : drawn.vs) {
      if (is_to_end(watch)) return;
      const double v = band.v.at(part);
      const Range across = region.across(band, v);
      for (const double s : drawn.us) {
        add_vertex(surface, size, across.at(s), v, colouring, drawn);
      }
    }
    out.push_back(std::move(drawn));
  }
}

DrawnPatch evaluated(const NurbsSurface& surface, double size, std::vector<double> us,
                     std::vector<double> vs, SurfaceColouring colouring, Watch* watch) {
  DrawnPatch patch;
  for (const double v : vs) {
    if (is_to_end(watch)) break;
    for (const double u : us) add_vertex(surface, size, u, v, colouring, patch);
  }
  patch.us = std::move(us);
  patch.vs = std::move(vs);
  return patch;
}

}  // namespace

std::vector<DrawnPatch> drawn_patches(const SurfaceModel& model, SurfaceColouring colouring,
                                      std::size_t most_facets, Watch* watch) {
  const double size = std::max(size_of(model), std::numeric_limits<double>::min());
  std::vector<Plan> plans;
  double shares = 0.0;
  for (const SurfacePatch& patch : model.patches) {
    const double own = size_of(patch.surface);
    plans.push_back({effort_along(patch.surface, true, own, size, watch),
                     effort_along(patch.surface, false, own, size, watch)});
    if (has_ended(watch)) return {};
    shares += plans.back().share();
  }
  std::vector<DrawnPatch> patches;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const Plan& plan = plans[i];
    const double facets =
        shares > 0.0 ? static_cast<double>(most_facets) * plan.share() / shares : 1.0;
    const double ratio = plan.v.total() > 0.0 ? plan.u.total() / plan.v.total() : 1.0;
    const std::size_t n = cells(std::sqrt(facets * ratio));
    const std::size_t m = cells(facets / static_cast<double>(n));
    if (!model.patches[i].trims.empty()) {
      add_bands(model.patches[i], i, n, m, colouring, watch, patches);
      continue;
    }
    const NurbsSurface& surface = model.patches[i].surface;
    patches.push_back(evaluated(surface, size_of(surface), plan.u.divided(n), plan.v.divided(m),
                                colouring, watch));
    patches.back().patch = i;
  }
  return patches;
}

ValueScale scale_of(const std::vector<DrawnPatch>& patches, SurfaceColouring colouring) {
  std::vector<WeighedValue> values;
  Box3 box;
  for (const DrawnPatch& patch : patches) {
    box.add_all(patch.points);
    for (std::size_t j = 0; j + 1 < patch.vs.size(); ++j) {
      for (std::size_t i = 0; i + 1 < patch.us.size(); ++i) {
        const std::size_t corners[] = {patch.vertex(i, j), patch.vertex(i + 1, j),
                                       patch.vertex(i + 1, j + 1), patch.vertex(i, j + 1)};
        const Vec3 a = patch.points[corners[2]] - patch.points[corners[0]];
        const Vec3 b = patch.points[corners[3]] - patch.points[corners[1]];
        const double quarter = norm(cross(a, b)) / 8.0;
        for (const std::size_t c : corners) values.push_back({patch.values[c], quarter});
      }
    }
  }
  return value_scale(std::move(values), resolution_of(colouring, box.diagonal()));
}

}  // namespace obvid::picture
