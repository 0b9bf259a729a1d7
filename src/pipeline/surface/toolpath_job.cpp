// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/toolpath_job.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "obvid/core/internal/figures.h"

namespace obvid {
namespace {

constexpr double kRoughStep = 0.4;  // diameters

/// Distance of passes on a level place.
double level_step(const ToolpathOptions& plan) {
  if (plan.step_over) return *plan.step_over;
  if (plan.strategy == ToolpathStrategy::kRough) return kRoughStep * plan.cutter.diameter;
  if (plan.cutter.kind == CutterKind::kFlat) return plan.cutter.diameter / 2.0;
  const bool ball = plan.cutter.kind == CutterKind::kBall;
  const double r = ball ? plan.cutter.diameter / 2.0 : plan.cutter.corner_radius;
  return 2.0 * std::sqrt(2.0 * r * plan.scallop.value_or(r));
}

constexpr double kCorner = 0.25;  // diameters, of a bull nose

/// Of what it is known by: diameter and corner.
Cutter earlier_cutter(double diameter, std::optional<double> corner, CutterKind kind) {
  if (kind == CutterKind::kBullNose) corner = corner.value_or(kCorner * diameter);
  if (!corner) return {kind, diameter, 0.0};
  if (*corner == 0.0) return {CutterKind::kFlat, diameter, 0.0};
  if (*corner == 0.5 * diameter) return {CutterKind::kBall, diameter, 0.0};
  return {CutterKind::kBullNose, diameter, *corner};
}

/// What is not typed, in the units of the surface.
ToolpathOptions options_for(const ToolpathJob& job, const Units& units) {
  constexpr double kDiameter = 6.0, kTolerance = 0.01;  // mm
  constexpr double kScallop = 0.01;                     // diameters
  ToolpathOptions plan = job.plan;
  const double unit = unit_ratio(units.name, "mm").value_or(1.0);  // without a length: refused
  plan.cutter.diameter = job.diameter.value_or(kDiameter / unit);
  plan.tolerance = job.tolerance.value_or(kTolerance / unit);
  if (plan.strategy == ToolpathStrategy::kRough) {
    plan.step_over = level_step(plan);
  } else if (!plan.scallop && !plan.step_over &&
             !(plan.strategy == ToolpathStrategy::kZLevel && plan.step_down)) {
    plan.scallop = kScallop * plan.cutter.diameter;
  }
  if (plan.cutter.kind == CutterKind::kBullNose) {
    plan.cutter.corner_radius = job.corner_radius.value_or(kCorner * plan.cutter.diameter);
  }
  if (job.rest_of) plan.earlier = earlier_cutter(*job.rest_of, job.rest_corner, plan.cutter.kind);
  return plan;
}

/// Refuses work without end: a typing error in a length, most likely.
Result<void> check_effort(const SurfaceModel& model, const ToolpathOptions& plan) {
  constexpr double kMostPasses = 20'000.0;
  const double passes = size_of(model) / level_step(plan);
  if (!(passes > kMostPasses)) return {};  // sizes that are no sizes are refused by the plan
  return error(ErrorCode::kBadOption,
               fmt::format("that would be some {:.2g} passes over {} {}", passes,
                           significant(size_of(model), 4), model.units.text()))
      .hint("check the units of the surface, --diameter, --scallop and --step-over")
      .value(passes);
}

Vec3 turned(Vec3 p, UpAxis up) {
  switch (up) {
    case UpAxis::kX:
      return {-p.z, p.y, p.x};
    case UpAxis::kMinusX:
      return {p.z, p.y, -p.x};
    case UpAxis::kY:
      return {p.x, -p.z, p.y};
    case UpAxis::kMinusY:
      return {p.x, p.z, -p.y};
    case UpAxis::kMinusZ:
      return {p.x, -p.y, -p.z};
    case UpAxis::kZ:
      break;
  }
  return p;
}

}  // namespace

const char* to_string(UpAxis up) {
  constexpr std::array kNames = {"x", "y", "z", "-x", "-y", "-z"};
  return kNames[static_cast<std::size_t>(up)];
}

SurfaceModel turned_up(SurfaceModel model, UpAxis up) {
  for (SurfacePatch& patch : model.patches) {
    for (Vec3& p : patch.surface.points) p = turned(p, up);
  }
  return model;
}

Result<MadeToolpath> make_toolpath(const SurfaceModel& given, const ToolpathJob& job,
                                   const RunContext& run) {
  if (job.rest_corner && !job.rest_of) {
    return error(ErrorCode::kBadOption, "the earlier cutter has a corner and no diameter")
        .hint("give --rest-of")
        .value(*job.rest_corner);
  }
  SurfaceModel model = turned_up(given, job.up);
  ToolpathOptions options = options_for(job, model.units);
  if (run.threads != 0) options.threads = run.threads;
  OBVID_TRY(check_effort(model, options));
  auto path = plan(model, options, run);
  OBVID_TRY(path);
  MadeToolpath made{std::move(*path), std::move(model), job.up, {}};
  if (!given.units.known()) {
    made.warnings.push_back("nothing says what a unit is: " + given.units.name +
                            " assumed; `obvid surface convert --units` states it");
  }
  made.warnings.insert(made.warnings.end(), made.path.warnings.begin(), made.path.warnings.end());
  return made;
}

std::optional<Error> not_kept(const MadeToolpath& made) {
  const std::vector<Error>& all = made.path.not_kept;
  if (all.empty()) return std::nullopt;
  Error out = all.front();
  const auto append = [](std::string& to, const std::string& more) {
    if (!to.empty() && !more.empty()) to += "; ";
    to += more;
  };
  for (std::size_t i = 1; i < all.size(); ++i) {
    append(out.what, all[i].what);
    append(out.hint, all[i].hint);
  }
  return out;
}

std::vector<ScenePolyline> drawn(const Toolpath& path) {
  constexpr double kThinned = 4.0;  // tolerances: not seen in a picture
  std::vector<ScenePolyline> lines;
  for (auto& points : cutting_lines(path, kThinned * path.tolerance)) {
    lines.push_back({std::move(points), "toolpath"});
  }
  for (auto& points : rapid_lines(path)) lines.push_back({std::move(points), "rapid"});
  for (const auto& [from, to] : path.hidden_strokes) {
    lines.push_back({{from, to}, "hidden from above"});
  }
  for (const auto& [from, to] : path.unreached_strokes) {
    lines.push_back({{from, to}, "not reached"});
  }
  return lines;
}

}  // namespace obvid
