// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/offset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "offset_raster.h"

namespace obvid {
namespace {

constexpr double kSettledCurvature = 1e-3;  // part of the greatest curvatures
constexpr std::size_t kFirstSteps = 32;     // of the whole raster, each direction, and
constexpr std::size_t kFewestInSpan = 2;    // in each span
// points of a refined raster: the first refinement takes a second or two, a surface of unbounded
// curvature, which never settles, less than that
constexpr std::size_t kMostPoints = 1'000'000, kMostPointsOnce = 4'000'000;
constexpr std::size_t kMostClimbed = 200;  // regions; of more, the raster's worst points stand

struct Raster {
  std::vector<double> u, v;
  std::vector<double> folding;  ///< distance * k where that is >= 1, otherwise 0
  Bend along, against;          ///< greatest ones

  [[nodiscard]] double step_u(std::size_t i) const {
    return i + 1 < u.size() ? u[i + 1] - u[i] : u[i] - u[i - 1];
  }
  [[nodiscard]] double step_v(std::size_t j) const {
    return j + 1 < v.size() ? v[j + 1] - v[j] : v[j] - v[j - 1];
  }
};

Raster raster_of(const Bending& bending, std::vector<double> us, std::vector<double> vs,
                 double distance) {
  Raster raster{std::move(us), std::move(vs), {}, {}, {}};
  raster.folding.assign(raster.u.size() * raster.v.size(), 0.0);
  std::size_t at = 0;
  Bend along, against;
  double step_u[2] = {0, 0}, step_v[2] = {0, 0};
  for (std::size_t j = 0; j < raster.v.size(); ++j) {
    for (std::size_t i = 0; i < raster.u.size(); ++i, ++at) {
      const Bending::Sides bend = bending.at(raster.u[i], raster.v[j]);
      const double folding = std::abs(distance) * (distance > 0.0 ? bend.along : bend.against);
      if (folding >= 1.0) raster.folding[at] = folding;
      const auto keep = [&](Bend& most, double value, int side) {
        if (!(value > most.value)) return;
        most = {raster.u[i], raster.v[j], value};
        step_u[side] = raster.step_u(i);
        step_v[side] = raster.step_v(j);
      };
      keep(along, bend.along, 0);
      keep(against, bend.against, 1);
    }
  }
  const Range all_u{raster.u.front(), raster.u.back()}, all_v{raster.v.front(), raster.v.back()};
  raster.along = bending.climbed(along, step_u[0], step_v[0], +1, all_u, all_v);
  raster.against = bending.climbed(against, step_u[1], step_v[1], -1, all_u, all_v);
  return raster;
}

bool settled(double before, double now) {
  return std::abs(now - before) <= kSettledCurvature * now;
}

Raster settled_raster(const NurbsSurface& surface, const Bending& bending, double distance) {
  const std::size_t spans_u = span_count(surface.knots_u), spans_v = span_count(surface.knots_v);
  std::size_t steps_u = std::max(kFewestInSpan, kFirstSteps / spans_u);
  std::size_t steps_v = std::max(kFewestInSpan, kFirstSteps / spans_v);
  const auto make = [&] {
    return raster_of(bending, raster_parameters(surface.knots_u, surface.degree_u, steps_u),
                     raster_parameters(surface.knots_v, surface.degree_v, steps_v), distance);
  };
  Raster raster = make();
  std::size_t limit = kMostPointsOnce;
  while (4 * raster.u.size() * raster.v.size() <= limit) {
    limit = kMostPoints;
    const Bend along = raster.along, against = raster.against;
    steps_u *= 2;
    steps_v *= 2;
    raster = make();
    if (settled(along.value, raster.along.value) && settled(against.value, raster.against.value)) {
      break;
    }
  }
  return raster;
}

/// A connected part of the raster that folds, as numbers of its lines.
struct Part {
  std::size_t u0, u1, v0, v1;
  std::size_t worst_i, worst_j;
  double worst;
};

/// Flood filling with a list instead of recursion; takes the marks away.
Part part_at(Raster& raster, std::size_t i, std::size_t j) {
  const std::size_t nu = raster.u.size(), nv = raster.v.size();
  Part part{i, i, j, j, i, j, 0.0};
  std::vector<std::pair<std::size_t, std::size_t>> open;
  const auto visit = [&](std::size_t a, std::size_t b) {
    const double folding = std::exchange(raster.folding[b * nu + a], 0.0);
    if (!(folding > 0.0)) return;
    open.emplace_back(a, b);
    if (folding > part.worst) {
      part.worst = folding;
      part.worst_i = a;
      part.worst_j = b;
    }
  };
  visit(i, j);
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    part.u0 = std::min(part.u0, a);
    part.u1 = std::max(part.u1, a);
    part.v0 = std::min(part.v0, b);
    part.v1 = std::max(part.v1, b);
    for (std::size_t y = b - std::min<std::size_t>(b, 1); y <= std::min(b + 1, nv - 1); ++y) {
      for (std::size_t x = a - std::min<std::size_t>(a, 1); x <= std::min(a + 1, nu - 1); ++x) {
        visit(x, y);
      }
    }
  }
  return part;
}

Range between_lines(const std::vector<double>& at, std::size_t first, std::size_t last) {
  return {at[first > 0 ? first - 1 : 0], at[std::min(last + 1, at.size() - 1)]};
}

FoldedRegion region_of(const Raster& raster, const Part& part, const Bending& bending, int side,
                       bool climb) {
  FoldedRegion region{between_lines(raster.u, part.u0, part.u1),
                      between_lines(raster.v, part.v0, part.v1), 0.0, 0.0, 0.0};
  const std::size_t i = part.worst_i, j = part.worst_j;
  Bend worst{raster.u[i], raster.v[j], bending.at(raster.u[i], raster.v[j], side)};
  if (climb) {
    worst = bending.climbed(worst, raster.step_u(i), raster.step_v(j), side, region.u, region.v);
  }
  region.worst_u = worst.u;
  region.worst_v = worst.v;
  region.curvature = side * worst.value;
  return region;
}

/// A fold that lies between the lines of the raster: the mesh around it.
FoldedRegion region_around(const Raster& raster, const Bend& worst, int side) {
  const auto line_before = [](const std::vector<double>& at, double t) {
    const auto next = std::upper_bound(at.begin(), at.end() - 1, t) - at.begin();
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - 1, 0));
  };
  const std::size_t i = line_before(raster.u, worst.u), j = line_before(raster.v, worst.v);
  return {between_lines(raster.u, i, i), between_lines(raster.v, j, j), worst.u, worst.v,
          side * worst.value};
}

bool inside(const FoldedRegion& region, const Bend& place) {
  return region.u.from <= place.u && place.u <= region.u.to && region.v.from <= place.v &&
         place.v <= region.v.to;
}

std::vector<FoldedRegion> folds_of(Raster& raster, const Bending& bending, double distance) {
  const int side = distance > 0.0 ? 1 : -1;
  std::vector<FoldedRegion> folds;
  for (std::size_t j = 0; j < raster.v.size(); ++j) {
    for (std::size_t i = 0; i < raster.u.size(); ++i) {
      if (!(raster.folding[j * raster.u.size() + i] > 0.0)) continue;
      const bool climb = folds.size() < kMostClimbed;
      folds.push_back(region_of(raster, part_at(raster, i, j), bending, side, climb));
    }
  }
  const Bend& worst = side > 0 ? raster.along : raster.against;
  const bool known = std::any_of(folds.begin(), folds.end(),
                                 [&](const FoldedRegion& fold) { return inside(fold, worst); });
  if (!known && std::abs(distance) * worst.value >= 1.0) {
    folds.push_back(region_around(raster, worst, side));
  }
  return folds;
}

double radius(double curvature) {
  return curvature > 0.0 ? 1.0 / curvature : std::numeric_limits<double>::infinity();
}

}  // namespace

OffsetCheck check_offset(const NurbsSurface& surface, double distance) {
  const Bending bending(surface);
  Raster raster = settled_raster(surface, bending, distance);
  return {folds_of(raster, bending, distance), radius(raster.against.value),
          radius(raster.along.value)};
}

}  // namespace obvid
