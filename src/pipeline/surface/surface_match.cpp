// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/surface/internal/match.h"
#include "obvid/surface/internal/topology.h"
#include "obvid/surface_builders/internal/check.h"
#include "surface/surface_kinds.h"

namespace obvid::pipeline_detail {
namespace {

/// Both borders as `surface check` measures them.
Result<JointReport> measured_joint(const SurfacePatch& patch, PatchSide side,
                                   const SurfacePatch& to, PatchSide to_side,
                                   const RunContext& run) {
  SurfaceModel both;
  both.patches = {patch, to};
  CheckOptions options;
  options.samples = 3;  // joints are measured in every span, whatever this is
  const auto check = check_surface(both, options, run);
  OBVID_TRY(check);
  for (const JointReport& one : check->joints) {
    if (one.patch[0] == 0 && one.patch[1] == 1 && one.side[0] == side && one.side[1] == to_side) {
      return one;
    }
  }
  return error(ErrorCode::kToleranceNotReached, "the borders do not meet after all")
      .where(patch.name)
      .hint("the border it should follow may be a point, or much longer than the patch");
}

/// Borders of a patch that met others before it was changed and do not now.
std::vector<std::string> lost_joints(const SurfaceModel& model, const Topology& before,
                                     std::size_t changed) {
  std::vector<std::string> out;
  const Topology now = topology_of(model);
  for (const PatchSide side : kPatchSides) {
    for (const EdgeUse& use : before.edges[before.edge_of[changed][side]].uses) {
      if (use.patch == changed) continue;
      const auto& left = now.edges[now.edge_of[changed][side]].uses;
      const bool meets = std::any_of(left.begin(), left.end(), [&](const EdgeUse& one) {
        return one.patch == use.patch && one.side == use.side;
      });
      if (meets) continue;
      out.push_back(
          fmt::format("{} met {} at another border, and no longer does: match that one, too",
                      model.patches[changed].name, model.patches[use.patch].name));
    }
  }
  return out;
}

}  // namespace

Result<MadeSurface> made_matched(const MatchedBorders& by, const SurfaceJob& job,
                                 const RunContext& run) {
  auto read = as_read(job, run);
  OBVID_TRY(read);
  MadeSurface made = std::move(*read);
  const auto at = face_named(made.model, by.border.face, "--border");
  OBVID_TRY(at);
  const auto to = face_named(made.model, by.to.face, "--to");
  OBVID_TRY(to);
  if (*at == *to) {
    return error(ErrorCode::kBadOption, "a patch is matched to another one").where("--to");
  }
  SurfacePatch& patch = made.model.patches[*at];
  const SurfacePatch& other = made.model.patches[*to];
  for (const SurfacePatch* one : {&std::as_const(patch), &other}) {
    if (one->trims.empty()) continue;
    return error(ErrorCode::kUnsupported, "borders of trimmed patches are not matched")
        .where(one->name);
  }
  auto matched_patch =
      matched({patch.surface, by.border.side}, {other.surface, by.to.side}, by.order);
  if (!matched_patch) {
    Error error = matched_patch.error();
    if (error.where.empty()) error.where = patch.name;
    return fail(std::move(error));
  }
  const std::string unit = made.model.units.text();
  if (by.within && matched_patch->moved > *by.within) {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("the patch would move by up to {} {}, {} more than {}",
                             significant_above(matched_patch->moved, 4), unit,
                             significant_above(matched_patch->moved - *by.within, 4),
                             significant(*by.within, 6)))
        .where(patch.name)
        .hint("allow more (--within), ask for less (--join), or match the border that lies nearer")
        .value(matched_patch->moved);
  }
  const Topology before = topology_of(made.model);
  patch.surface = std::move(matched_patch->surface);
  for (std::string& one : lost_joints(made.model, before, *at)) {
    made.warnings.push_back(std::move(one));
  }
  const auto joint = measured_joint(patch, by.border.side, other, by.to.side, run);
  OBVID_TRY(joint);
  const double tolerance = job.tolerance.value_or(kSameBorder * size_of(made.model));
  if (joint->gap > tolerance) {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("after matching the borders are {} {} apart",
                             significant(joint->gap, 3), unit))
        .where(patch.name)
        .value(joint->gap);
  }
  made.kind = fmt::format("{} matched to {}, G{}", patch.name, other.name, by.order);
  made.facts.emplace_back(
      "border",
      fmt::format("gap {} {}, {} degrees between tangent planes, step of curvature {} of "
                  "the largest beside it, as measured at {} places",
                  significant(joint->gap, 3), unit, significant(joint->angle / kOneDegree, 3),
                  significant(joint->curvature, 3), joint->places));
  made.facts.emplace_back("moved",
                          fmt::format("no point by more than {} {}, up to {} of the way across",
                                      significant_above(matched_patch->moved, 4), unit,
                                      significant_above(matched_patch->reach, 4)));
  if (by.order > 0) {
    made.facts.emplace_back("pace", fmt::format("{} times the derivative of {}",
                                                significant(matched_patch->pace, 4), other.name));
  }
  return made;
}

}  // namespace obvid::pipeline_detail
