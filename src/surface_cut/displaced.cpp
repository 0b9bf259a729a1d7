// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_cut/internal/displaced.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "branches.h"
#include "cells.h"
#include "integrals.h"
#include "obvid/geom/internal/box.h"
#include "obvid/numeric/internal/gauss.h"
#include "obvid/surface/internal/topology.h"
#include "openings.h"
#include "trim_joints.h"
#include "trimmed_integrals.h"

namespace obvid::afloat {
namespace {

/// The plane that tells wet cells from dry ones lies this far below the water, of the size and of
/// the rounding of heights: a face in the waterplane is dry, and not cut.
constexpr double kBelowOfSize = 1e-12, kBelowOfRounding = 16.0;
/// Roundings of the wetted surface: a waterplane that is no more is what the parts of a closed
/// surface, which cancel, leave of their sum.
constexpr double kCancelled = 256.0;

/// Integrals of one patch below the water.
class PatchIntegrals {
 public:
  PatchIntegrals(const CutPatch& patch, const PlaneFoot& foot, Vec3 origin, double size)
      : patch_(patch), foot_(foot), origin_(origin), small_(small_integrals(size)) {}

  void take(const SectionCell& cell, CellKind kind) {
    const Range u{patch_.u.at(cell.span_u, cell.shares_u().from),
                  patch_.u.at(cell.span_u, cell.shares_u().to)};
    const Range v{patch_.v.at(cell.span_v, cell.shares_v().from),
                  patch_.v.at(cell.span_v, cell.shares_v().to)};
    if (kind == CellKind::kBelow) {
      sum.add(refined(u, small_, [&](Range part, auto rule, int halvings) {
        return over_panels(v, halvings, [&](Range some) { return strip(part, some, rule); });
      }));
    } else if (kind == CellKind::kOverU || kind == CellKind::kOverV) {
      take_cut(cell, kind == CellKind::kOverU, u, v);
    } else if (kind == CellKind::kUndecided) {
      ++undecided;
    }
  }

  Sum sum;
  std::size_t undecided = 0;

 private:
  /// Over a rectangle.
  template <std::size_t N>
  [[nodiscard]] Integrals strip(Range u, Range v, Rule<N>) const {
    const auto us = nodes<N>(u), vs = nodes<N>(v);
    std::array<SurfacePoint, N * N> points;
    evaluate_raster(*patch_.surface, us, vs, points);
    Integrals out{};
    for (std::size_t j = 0; j < N; ++j) {
      for (std::size_t i = 0; i < N; ++i) {
        const double w = 0.25 * u.length() * v.length() * weight<N>(i) * weight<N>(j);
        const Integrals here = integrands(points[j * N + i], origin_);
        for (std::size_t k = 0; k < kIntegrals; ++k) out[k] += w * here[k];
      }
    }
    return out;
  }

  /// A cell in which the branch is a function of one parameter: below it, or above.
  void take_cut(const SectionCell& cell, bool over_u, Range u, Range v) {
    const Range along = over_u ? u : v, across = over_u ? v : u;
    const StrandOfCell found =
        strand_of_cell(cell, patch_.u.degree, patch_.v.degree, over_u, across);
    const Strand& strand = found.strand;
    const std::vector<double>& ends = found.cuts;
    const auto below = [&](double t, double other) {
      const SurfaceJet jet =
          over_u ? evaluate(*patch_.surface, t, other) : evaluate(*patch_.surface, other, t);
      return foot_.height(jet.point) < 0.0;
    };
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const Range part{along.at(ends[i - 1]), along.at(ends[i])};
      if (!(part.length() > 0.0)) continue;
      const bool low = below(part.at(0.5), across.from), high = below(part.at(0.5), across.to);
      if (!low && !high) continue;
      if (low && high) {
        sum.add(refined(part, small_, [&](Range some, auto rule, int halvings) {
          return over_panels(across, halvings, [&](Range other) {
            return over_u ? strip(some, other, rule) : strip(other, some, rule);
          });
        }));
        continue;
      }
      sum.add(refined(part, small_, [&](Range some, auto rule, int halvings) {
        return up_to_water(some, strand, low, rule, halvings);
      }));
    }
  }

  template <std::size_t N>
  [[nodiscard]] Integrals up_to_water(Range along, const Strand& strand, bool low_is_below, Rule<N>,
                                      int halvings) const {
    Integrals out{};
    const auto ts = nodes<N>(along);
    for (std::size_t i = 0; i < N; ++i) {
      const SectionPoint root =
          foot_.on_strand(patch_, strand, ts[i], 0.5 * (strand.least + strand.most));
      const double at_water =
          std::clamp(strand.over_u ? root.v : root.u, strand.least, strand.most);
      const Range wet = low_is_below ? Range{strand.least, at_water} : Range{at_water, strand.most};
      const double w = 0.5 * along.length() * weight<N>(i);
      const Integrals line = over_panels(wet, halvings, [&](Range some) {
        return across_line(*patch_.surface, origin_, ts[i], some, strand.over_u, Rule<N>{});
      });
      for (std::size_t k = 0; k < kIntegrals; ++k) out[k] += w * line[k];
    }
    return out;
  }

  const CutPatch& patch_;
  const PlaneFoot& foot_;
  Vec3 origin_;
  Integrals small_{};
};

/// Whether an edge runs counter-clockwise round a patch.
double runs_round(const EdgeUse& use) {
  const bool with = use.side == kVStart || use.side == kUEnd;
  return with == use.along ? 1.0 : -1.0;
}

Turned turned_alike(const Topology& topology) {
  const std::size_t count = topology.edge_of.size();
  Turned out{std::vector<double>(count, 0.0), std::vector<std::size_t>(count, 0), 0, 0};
  for (std::size_t first = 0; first < count; ++first) {
    if (out.sign[first] != 0.0) continue;
    std::vector<std::size_t> open{first};
    out.sign[first] = 1.0;
    while (!open.empty()) {
      const std::size_t patch = open.back();
      open.pop_back();
      out.part[patch] = out.parts;
      for (const PatchSide side : kPatchSides) {
        const TopologyEdge& edge = topology.edges[topology.edge_of[patch][side]];
        if (edge.point || edge.uses.size() != 2) continue;
        const EdgeUse& own = topology.use(patch, side);
        const EdgeUse& other = &own == &edge.uses[0] ? edge.uses[1] : edge.uses[0];
        const double wanted = -out.sign[patch] * runs_round(own) * runs_round(other);
        if (out.sign[other.patch] == 0.0) {
          out.sign[other.patch] = wanted;
          open.push_back(other.patch);
        } else if (out.sign[other.patch] != wanted && &own == &edge.uses[0]) {
          ++out.twisted;
        }
      }
    }
    ++out.parts;
  }
  return out;
}

MeasuredFigure quotient(double a, double a_error, double b, double b_error, double shift) {
  constexpr double kNothing = 8.0;  // errors
  if (std::abs(b) <= kNothing * b_error || b == 0.0)
    return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  const double value = a / b;
  return {shift + value, (a_error + std::abs(value) * b_error) / std::abs(b)};
}

/// Of a model without trims all edges; those of one patch are open.
Result<TrimJoints> joints_of(const SurfaceModel& model, const RunContext& run) {
  if (is_trimmed(model)) return trim_joints_of(model, run);
  TrimJoints out;
  out.open = topology_of(model);
  out.turned = turned_alike(out.open);
  return out;
}

}  // namespace
}  // namespace obvid::afloat

namespace obvid {

Result<Displaced> displaced(const SurfaceModel& model, const DisplacedOptions& options,
                            const RunContext& run) {
  using namespace afloat;
  if (!std::isfinite(options.water)) {
    return error(ErrorCode::kNotFinite, "the waterplane lies at no finite height");
  }
  Box3 box;
  double heaviest = 1.0;
  for (const NurbsSurface* surface : surfaces_of(model)) {
    box.add_all(surface->points);
    for (const double w : surface->weights) heaviest = std::max(heaviest, w);
  }
  const double size = box.diagonal();
  if (!(size > 0.0)) return error(ErrorCode::kTooFewPoints, "the surface has no size");
  const double largest =
      std::max({std::abs(box.low.z), std::abs(box.high.z), std::abs(options.water)});
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * largest;
  const CutPlane plane{{0.0, 0.0, 1.0}, options.water};
  const double below = std::max(kBelowOfSize * size, kBelowOfRounding * rounding);
  const CutPlane decided{plane.normal, options.water - below};
  const PlaneFoot foot(plane, 0.25 * rounding);
  const double middle_y = options.mirror ? 0.0 : box.middle().y;
  const Vec3 origin{box.middle().x, middle_y, options.water};
  auto joints = joints_of(model, run);
  OBVID_TRY(joints);
  const Turned& turned = joints->turned;
  std::vector<Sum> parts(turned.parts);
  Displaced out;
  out.parts = turned.parts;
  out.twisted = turned.twisted;
  out.trimmed = is_trimmed(model);
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    OBVID_TRY(
        tell(run, "measuring", static_cast<double>(i) / static_cast<double>(model.patches.size())));
    const CutPatch patch = cut_patch(model.patches[i].surface);
    const auto integrate = [&](auto& integrals) -> Result<void> {
      return divide(patch, heights_of(*patch.surface, decided), rounding * heaviest, run,
                    [&](const SectionCell& cell, CellKind kind) { integrals.take(cell, kind); });
    };
    Sum sum;
    if (model.patches[i].trims.empty()) {
      PatchIntegrals integrals(patch, foot, origin, size);
      OBVID_TRY(integrate(integrals));
      sum = integrals.sum;
      out.undecided += integrals.undecided;
    } else {
      TrimmedIntegrals integrals(model.patches[i], joints->loops[i], patch, foot, decided, origin,
                                 size);
      OBVID_TRY(integrate(integrals));
      integrals.finish();
      sum = integrals.sum;
      out.undecided += integrals.undecided;
    }
    for (std::size_t k = 1; k < kIntegrals; ++k) sum.value[k] *= turned.sign[i];
    parts[turned.part[i]].add(sum);
  }
  Sum all;
  for (Sum& part : parts) {
    if (part.value[kVolume] < 0.0) {
      for (std::size_t k = 1; k < kIntegrals; ++k) part.value[k] = -part.value[k];
    }
    all.add(part);
  }
  const double nothing = kCancelled * std::numeric_limits<double>::epsilon() * all.value[kArea];
  if (std::abs(all.value[kFlat]) <= std::max(nothing, out.trimmed ? all.error[kFlat] : 0.0)) {
    for (const std::size_t k : {kFlat, kFlatX, kFlatY, kFlatYy}) all.value[k] = 0.0;
  }
  // with the outward normal the flux of (0, 0, 1) through the hull is less than nothing
  const double flat_sign = -1.0, sides = options.mirror ? 2.0 : 1.0;
  const auto figure = [&](std::size_t k, double sign) {
    return MeasuredFigure{sign * sides * all.value[k], sides * all.error[k]};
  };
  out.volume = figure(kVolume, 1.0);
  // a trim in the waterplane lies below it by no more than it is known
  double known = 0.0;
  for (const SurfacePatch& patch : model.patches) known = std::max(known, patch.trims_within);
  const auto open = openings_below(joints->open, options.water - known, size, options.mirror, run);
  OBVID_TRY(open);
  out.open_volume = sides * open->volume;
  out.open_width = open->width;
  out.open_at = open->at;
  out.wetted = figure(kArea, 1.0);
  out.waterplane = figure(kFlat, flat_sign);
  const auto centre = [&](std::size_t k, std::size_t of, double shift) {
    return quotient(all.value[k], all.error[k], all.value[of], all.error[of], shift);
  };
  out.centre_x = centre(kMomentX, kVolume, origin.x);
  out.centre_y = options.mirror ? MeasuredFigure{} : centre(kMomentY, kVolume, origin.y);
  out.centre_z = centre(kMomentZ, kVolume, origin.z);
  out.plane_x = centre(kFlatX, kFlat, origin.x);
  out.plane_y = options.mirror ? MeasuredFigure{} : centre(kFlatY, kFlat, origin.y);
  const bool in_middle = options.mirror || all.value[kFlat] == 0.0;
  const double off = in_middle ? 0.0 : out.plane_y.value - origin.y;
  out.inertia_x = {sides * (flat_sign * all.value[kFlatYy] -
                            (off == 0.0 ? 0.0 : off * off * flat_sign * all.value[kFlat])),
                   sides * (all.error[kFlatYy] + off * off * all.error[kFlat])};
  return out;
}

}  // namespace obvid
