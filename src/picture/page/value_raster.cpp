// SPDX-License-Identifier: Apache-2.0
#include "page/value_raster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "obvid/core/internal/parallel.h"
#include "obvid/curve/internal/basis.h"
#include "space/facets.h"

namespace obvid::picture {
namespace {

/// Cells of a span; where there are too many nodes fewer, then spans are taken together.
constexpr std::size_t kCellsOfSpan = 6, kFewestCells = 3, kMostCells = 512;
/// Spans shorter than this part of the domain are no spans to single precision.
constexpr double kShortestSpan = 1e-6;
/// How far inside its span a node at a break is, part of the span.
constexpr double kInset = 1e-6;
/// Of all rasters together; more than the spans need only up to the second.
constexpr std::size_t kMostNodes = 300'000, kMostRefined = 150'000;
/// Deviations cost a search each: so many nodes at least and, where finer ones are only hoped to
/// show more, at most.
constexpr std::size_t kLeastSearches = 10'000, kMostSearches = 60'000;
/// Part of the told range of the deviation that nodes have to meet.
constexpr double kMet = 0.95;
/// Part of the cells whose middle may lie off.
constexpr double kOffCells = 0.02;
constexpr std::size_t kLot = 64;  // nodes between two questions whether to go on

RasterSide side_of(const std::vector<double>& knots, Range domain, std::size_t degree) {
  RasterSide side;
  side.breaks = {0.0};
  for (const double knot : distinct(knots)) {
    const double part = (knot - domain.from) / domain.length();
    if (part > side.breaks.back() + kShortestSpan && part < 1.0 - kShortestSpan) {
      side.breaks.push_back(part);
    }
  }
  side.breaks.push_back(1.0);
  side.cells = std::clamp(degree + 1, kCellsOfSpan, kMostCells);
  return side;
}

/// Every so many breaks, evenly.
void thin(RasterSide& side, std::size_t spans) {
  if (spans >= side.spans()) return;
  std::vector<double> kept;
  for (std::size_t i = 0; i <= spans; ++i) kept.push_back(side.breaks[i * side.spans() / spans]);
  side.breaks = std::move(kept);
}

/// Fewer nodes: `part` of them.
void reduce(ValueRaster& raster, double part) {
  const double wanted = part * static_cast<double>(raster.nodes());
  for (RasterSide* side : {&raster.u, &raster.v}) {
    while (side->cells > kFewestCells && static_cast<double>(raster.nodes()) > wanted) {
      --side->cells;
    }
  }
  const double over = std::sqrt(static_cast<double>(raster.nodes()) / wanted);
  if (over <= 1.0) return;
  for (RasterSide* side : {&raster.u, &raster.v}) {
    const double spans = std::floor(static_cast<double>(side->spans()) / over);
    thin(*side, std::max<std::size_t>(1, static_cast<std::size_t>(spans)));
  }
}

void double_cells(ValueRaster& raster) {
  raster.u.cells = std::min(2 * raster.u.cells + 1, kMostCells);
  raster.v.cells = std::min(2 * raster.v.cells + 1, kMostCells);
}

std::size_t nodes_of(const std::vector<ValueRaster>& rasters) {
  std::size_t nodes = 0;
  for (const ValueRaster& raster : rasters) nodes += raster.nodes();
  return nodes;
}

/// So many cells that a patch has the wanted nodes, as square as its sides allow.
void refine_to(ValueRaster& raster, const NurbsSurface& surface, double wanted) {
  const Range us = domain_u(surface), vs = domain_v(surface);
  const SurfaceJet jet = evaluate(surface, us.at(0.5), vs.at(0.5));
  const double long_u = norm(jet.du) * us.length(), long_v = norm(jet.dv) * vs.length();
  const double ratio =
      long_u > 0.0 && long_v > 0.0 ? std::clamp(long_u / long_v, 0.01, 100.0) : 1.0;
  const auto raise = [](RasterSide& side, double nodes) {
    const double cells = std::ceil(nodes / static_cast<double>(side.spans()));
    side.cells = std::clamp(static_cast<std::size_t>(std::max(1.0, cells)), side.cells, kMostCells);
  };
  raise(raster.u, std::sqrt(wanted * ratio));
  raise(raster.v, std::sqrt(wanted / ratio));
}

struct Value {
  PrincipalCurvatures k;
  double off = 0.0;
};

/// Works on the nodes of all rasters.
class Filling {
 public:
  Filling(const SurfaceModel& model, const std::optional<ShownDeviation>& deviation,
          const RunContext& run)
      : model_(model),
        deviation_(deviation && deviation->of_place ? &*deviation : nullptr),
        run_(run) {
    for (const SurfacePatch& patch : model.patches) sizes_.push_back(size_of(patch.surface));
  }

  [[nodiscard]] bool searches() const { return deviation_ != nullptr; }

  Result<void> fill(std::size_t patch, ValueRaster& raster) const {
    const NurbsSurface& surface = model_.patches[patch].surface;
    const Range us = domain_u(surface), vs = domain_v(surface);
    const std::size_t n = raster.u.nodes();
    raster.k.assign(raster.nodes(), {});
    raster.normals.assign(raster.nodes(), {});
    raster.areas.assign(raster.nodes(), 0.0);
    raster.offs.assign(searches() ? raster.nodes() : 0, 0.0);
    return in_lots(raster.nodes(), kLot, run_, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        const double u = us.at(raster.u.at(i % n)), v = vs.at(raster.v.at(i / n));
        const SurfaceJet jet = evaluate(surface, u, v);
        const SurfaceCurvature k = curvature_at(surface, sizes_[patch], u, v);
        raster.k[i] = principal_at(surface, sizes_[patch], u, v);
        raster.normals[i] = is_finite(k.normal) ? k.normal : Vec3{};
        raster.areas[i] = norm(cross(jet.du, jet.dv)) * us.length() * vs.length() *
                          width(raster.u, i % n) * width(raster.v, i / n);
        if (searches()) raster.offs[i] = deviation_->of_place(jet.point);
      }
    });
  }

  /// Largest parts of the scales by which middles of cells are off, the few worst left out.
  Result<double> off_at_middles(std::size_t patch, const ValueRaster& raster,
                                const std::array<double, 5>& ranges) const {
    const NurbsSurface& surface = model_.patches[patch].surface;
    const Range us = domain_u(surface), vs = domain_v(surface);
    const std::size_t columns = raster.u.spans() * raster.u.cells;
    std::vector<double> worst(columns * raster.v.spans() * raster.v.cells, 0.0);
    OBVID_TRY(in_lots(worst.size(), kLot, run_, [&](std::size_t from, std::size_t to) {
      for (std::size_t c = from; c < to; ++c) {
        const std::size_t i = node_of(raster.u, c % columns), j = node_of(raster.v, c / columns);
        const double u = us.at(0.5 * (raster.u.at(i) + raster.u.at(i + 1)));
        const double v = vs.at(0.5 * (raster.v.at(j) + raster.v.at(j + 1)));
        Value there{principal_at(surface, sizes_[patch], u, v), 0.0};
        if (searches()) there.off = deviation_->of_place(evaluate(surface, u, v).point);
        worst[c] = off_by(raster, i, j, there, ranges);
      }
    }));
    const auto nth = worst.begin() + static_cast<std::ptrdiff_t>(
                                         (1.0 - kOffCells) * static_cast<double>(worst.size() - 1));
    std::nth_element(worst.begin(), nth, worst.end());
    return *nth;
  }

 private:
  static std::size_t node_of(const RasterSide& side, std::size_t cell) {
    return cell / side.cells * (side.cells + 1) + cell % side.cells;
  }
  /// Part of the domain that a node stands for.
  static double width(const RasterSide& side, std::size_t node) {
    const std::size_t span = node / (side.cells + 1), at = node % (side.cells + 1);
    const double cell =
        (side.breaks[span + 1] - side.breaks[span]) / static_cast<double>(side.cells);
    return at == 0 || at == side.cells ? 0.5 * cell : cell;
  }
  double off_by(const ValueRaster& raster, std::size_t i, std::size_t j, const Value& there,
                const std::array<double, 5>& ranges) const {
    const std::size_t n = raster.u.nodes();
    const std::size_t corners[] = {j * n + i, j * n + i + 1, (j + 1) * n + i, (j + 1) * n + i + 1};
    PrincipalCurvatures k;
    double off = 0.0;
    for (const std::size_t c : corners) {
      k.k1 += 0.25 * raster.k[c].k1;
      k.k2 += 0.25 * raster.k[c].k2;
      if (searches()) off += 0.25 * raster.offs[c];
    }
    double worst = 0.0;
    for (std::size_t q = 0; q < kPageQuantities.size(); ++q) {
      const double by = quantity(kPageQuantities[q], k) - quantity(kPageQuantities[q], there.k);
      if (ranges[q] > 0.0) worst = std::max(worst, std::abs(by) / ranges[q]);
    }
    if (ranges.back() > 0.0) worst = std::max(worst, std::abs(off - there.off) / ranges.back());
    return worst;
  }

  const SurfaceModel& model_;
  const ShownDeviation* deviation_;
  const RunContext& run_;
  std::vector<double> sizes_;
};

/// Takes the area from nodes that lie in no triangle: outside the trims.
void keep_inside(const Mesh& mesh, const NurbsSurface& surface, ValueRaster& raster) {
  const Range us = domain_u(surface), vs = domain_v(surface);
  std::vector<double> at_u, at_v;
  for (std::size_t i = 0; i < raster.u.nodes(); ++i) at_u.push_back(us.at(raster.u.at(i)));
  for (std::size_t j = 0; j < raster.v.nodes(); ++j) at_v.push_back(vs.at(raster.v.at(j)));
  std::vector<bool> inside(raster.nodes(), false);
  const auto between = [](const std::vector<double>& at, double a, double b, double c) {
    const auto [low, high] = std::minmax({a, b, c});
    return std::pair{std::lower_bound(at.begin(), at.end(), low) - at.begin(),
                     std::upper_bound(at.begin(), at.end(), high) - at.begin()};
  };
  for (const auto& t : mesh.triangles) {
    const MeshVertex &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const auto [i0, i1] = between(at_u, a.u, b.u, c.u);
    const auto [j0, j1] = between(at_v, a.v, b.v, c.v);
    const auto turn = [](const MeshVertex& p, const MeshVertex& q, double u, double v) {
      return (q.u - p.u) * (v - p.v) - (q.v - p.v) * (u - p.u);
    };
    for (auto j = j0; j < j1; ++j) {
      for (auto i = i0; i < i1; ++i) {
        const double u = at_u[static_cast<std::size_t>(i)], v = at_v[static_cast<std::size_t>(j)];
        const double x = turn(a, b, u, v), y = turn(b, c, u, v), z = turn(c, a, u, v);
        if ((x >= 0.0 && y >= 0.0 && z >= 0.0) || (x <= 0.0 && y <= 0.0 && z <= 0.0)) {
          inside[static_cast<std::size_t>(j) * at_u.size() + static_cast<std::size_t>(i)] = true;
        }
      }
    }
  }
  if (std::none_of(inside.begin(), inside.end(), [](bool in) { return in; })) return;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (!inside[i]) raster.areas[i] = 0.0;
  }
}

/// Lengths of the scales, at least what is 0 within rounding; 0 where there is none.
std::array<double, 5> ranges_of(const std::vector<ValueRaster>& rasters, double size) {
  std::array<double, 5> ranges{};
  for (std::size_t q = 0; q < ranges.size(); ++q) {
    const bool off = q == kPageQuantities.size();
    const ValueScale scale =
        off ? scale_of_offs(rasters, size) : scale_of(rasters, kPageQuantities[q], size);
    ranges[q] = scale.high - scale.low;
  }
  return ranges;
}

/// Whether the nodes meet the told extremes.
bool meets_told(const std::vector<ValueRaster>& rasters, Range told) {
  if (!(std::isfinite(told.length()) && told.length() > 0.0)) return true;
  double least = told.to, most = told.from;
  for (const ValueRaster& raster : rasters) {
    for (const double off : raster.offs) {
      least = std::min(least, off);
      most = std::max(most, off);
    }
  }
  return most - least >= kMet * told.length();
}

}  // namespace

double RasterSide::at(std::size_t node) const {
  const std::size_t span = node / (cells + 1), within = node % (cells + 1);
  const double from = breaks[span], to = breaks[span + 1];
  double part = static_cast<double>(within) / static_cast<double>(cells);
  if (within == 0 && span > 0) part = kInset;
  if (within == cells && span + 1 < spans()) part = 1.0 - kInset;
  return within == cells && span + 1 == spans() ? to : from + part * (to - from);
}

ValueScale scale_of(const std::vector<ValueRaster>& rasters, SurfaceColouring colouring,
                    double size) {
  std::vector<WeighedValue> values;
  for (const ValueRaster& raster : rasters) {
    for (std::size_t i = 0; i < raster.k.size(); ++i) {
      if (raster.areas[i] > 0.0) {
        values.push_back({quantity(colouring, raster.k[i]), raster.areas[i]});
      }
    }
  }
  return value_scale(std::move(values), resolution_of(colouring, size));
}

ValueScale scale_of_offs(const std::vector<ValueRaster>& rasters, double size) {
  std::vector<WeighedValue> values;
  for (const ValueRaster& raster : rasters) {
    for (std::size_t i = 0; i < raster.offs.size(); ++i) {
      if (raster.areas[i] > 0.0) values.push_back({raster.offs[i], raster.areas[i]});
    }
  }
  return value_scale(std::move(values), resolution_of(SurfaceColouring::kDeviation, size));
}

Result<std::vector<ValueRaster>> value_rasters(const SurfaceModel& model,
                                               const std::vector<Mesh>& meshes,
                                               const std::optional<ShownDeviation>& deviation,
                                               const RunContext& run) {
  const Filling filling(model, deviation, run);
  std::vector<ValueRaster> rasters(model.patches.size());
  for (std::size_t i = 0; i < rasters.size(); ++i) {
    const NurbsSurface& s = model.patches[i].surface;
    rasters[i].u = side_of(s.knots_u, domain_u(s), static_cast<std::size_t>(s.degree_u));
    rasters[i].v = side_of(s.knots_v, domain_v(s), static_cast<std::size_t>(s.degree_v));
    if (!filling.searches()) continue;
    const double share = static_cast<double>(kLeastSearches) / static_cast<double>(rasters.size());
    if (static_cast<double>(rasters[i].nodes()) < share) refine_to(rasters[i], s, share);
  }
  if (const std::size_t all = nodes_of(rasters); all > kMostNodes) {
    for (ValueRaster& raster : rasters) {
      reduce(raster, static_cast<double>(kMostNodes) / static_cast<double>(all));
    }
  }
  const auto fill = [&](std::size_t i) -> Result<void> {
    OBVID_TRY(filling.fill(i, rasters[i]));
    if (!model.patches[i].trims.empty()) {
      keep_inside(meshes[i], model.patches[i].surface, rasters[i]);
    }
    return {};
  };
  const std::size_t most = filling.searches() ? kMostSearches : kMostRefined;
  for (std::size_t i = 0; i < rasters.size(); ++i) {
    OBVID_TRY(fill(i));
    const double part = 0.5 * static_cast<double>(i + 1) / static_cast<double>(rasters.size());
    OBVID_TRY(tell(run, "page", part));
  }
  while (filling.searches() && !meets_told(rasters, deviation->told) &&
         4 * nodes_of(rasters) <= most) {
    for (std::size_t i = 0; i < rasters.size(); ++i) {
      double_cells(rasters[i]);
      OBVID_TRY(fill(i));
    }
  }
  constexpr double kHalfBand = 0.5 / kBands;
  const std::array<double, 5> ranges = ranges_of(rasters, size_of(model));
  std::size_t all = nodes_of(rasters);
  for (std::size_t i = 0; i < rasters.size(); ++i) {
    while (all + 3 * rasters[i].nodes() <= most) {
      const auto off = filling.off_at_middles(i, rasters[i], ranges);
      OBVID_TRY(off);
      if (*off <= kHalfBand) break;
      const std::size_t before = rasters[i].nodes();
      double_cells(rasters[i]);
      if (rasters[i].nodes() == before) break;
      OBVID_TRY(fill(i));
      all += rasters[i].nodes() - before;
    }
    const double part =
        0.5 + 0.5 * static_cast<double>(i + 1) / static_cast<double>(rasters.size());
    OBVID_TRY(tell(run, "page", part));
  }
  return rasters;
}

}  // namespace obvid::picture
