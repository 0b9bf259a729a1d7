// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "entry.h"
#include "leftover.h"
#include "moves.h"
#include "obvid/core/internal/figures.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/exchange/internal/gcode/motion_time.h"
#include "obvid/toolpath/toolpath.h"
#include "pass_families.h"
#include "program_check.h"
#include "roughing.h"
#include "scallop_survey.h"

namespace obvid {
namespace {

using namespace toolpath;

/// Where the printed program leaves more than asked for, passes are added at a lower limit.
constexpr int kMostAttempts = 3;
constexpr double kLowerShare = 0.96;
constexpr double kCellOfRadius = 1.0 / 8.0, kCellOfStep = 0.25;
constexpr double kDefaultSafe = 0.5;      // diameters above the highest point
constexpr double kLeastSpindle = 0.5;     // revolutions a minute: printed as a whole number
constexpr double kLargestOfPart = 100.0;  // sizes of it: to such cutters all that is seen is flat
constexpr double kSteepestRamp = 90.0;    // degrees
constexpr double kMostSteep = 90.0;       // degrees
constexpr double kAngleDigits = 3.0;
constexpr double kMostAngle = 1e6;  // degrees: beyond, the angle is lost in rounding

Result<void> refuse(std::string what, double value, std::string hint = "") {
  return error(ErrorCode::kBadOption, std::move(what)).hint(std::move(hint)).value(value);
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

Result<void> check_roughing(const ToolpathOptions& o) {
  if (o.strategy != ToolpathStrategy::kRough) {
    if (!o.stock && (!o.step_down || flat_from(o))) return {};
    return refuse("step down and stock are for roughing", 0.0,
                  "add --strategy rough; levels take a step down");
  }
  if (o.scallop) {
    return refuse("roughing keeps no scallop", *o.scallop, "give the step over and the allowance");
  }
  if (o.stock) {
    const Vec3 size = (*o.stock)[1] - (*o.stock)[0];
    if (!positive(size.x) || !positive(size.y) || !positive(size.z)) {
      return refuse("the stock's second corner must lie above its first in x, y and z",
                    std::min({size.x, size.y, size.z}));
    }
  }
  return {};
}

Result<void> check_entry(const ToolpathOptions& o) {
  if (o.ramp_deg && !(*o.ramp_deg > 0.0 && *o.ramp_deg < kSteepestRamp)) {
    return refuse("the ramp must lie between 0 and 90 degrees", *o.ramp_deg);
  }
  if (!o.ramp_height) return {};
  if (o.strategy == ToolpathStrategy::kRough) {
    return refuse("roughing knows the stock: its ramps begin there", *o.ramp_height,
                  "leave the ramp's height out");
  }
  if (!fall_of(o)) {
    return refuse("nothing goes down on a ramp", *o.ramp_height, "give the entry or its angle");
  }
  if (!positive(*o.ramp_height)) {
    return refuse("the ramp's height must be greater than 0", *o.ramp_height);
  }
  return {};
}

Result<void> check_levels(const ToolpathOptions& o) {
  const bool levels = o.strategy == ToolpathStrategy::kZLevel;
  if (o.steep_deg) {
    if (!levels && o.strategy != ToolpathStrategy::kZigzag) {
      return refuse("a steep angle is for zigzag and levels", *o.steep_deg,
                    "use --strategy zigzag or z-level");
    }
    if (!(*o.steep_deg > 0.0 && *o.steep_deg < kMostSteep)) {
      return refuse("the steep angle must lie between 0 and 90 degrees", *o.steep_deg);
    }
  }
  if (levels && o.step_over) {
    return refuse("levels have no step over", *o.step_over, "give the scallop or the step down");
  }
  return {};
}

Result<void> check_earlier(const ToolpathOptions& o) {
  if (!o.earlier) return {};
  if (o.strategy == ToolpathStrategy::kRough) {
    return refuse("what an earlier cutter left is for other strategies than roughing", 0.0,
                  "leave the earlier cutter out, or choose zigzag, scallop or z-level");
  }
  if (!(o.earlier->diameter > o.cutter.diameter)) {
    return refuse("the earlier cutter must be larger than this one", o.earlier->diameter,
                  "what it left is milled by a smaller one");
  }
  OBVID_TRY(shape_of(*o.earlier));
  return {};
}

/// `to_machine`: from lengths of the surface to those of the machine.
Result<void> check_sizes(const ToolpathOptions& o, double to_machine) {
  if (!positive(o.tolerance)) return refuse("the tolerance must be greater than 0", o.tolerance);
  const double radius = 0.5 * o.cutter.diameter;
  if (o.tolerance >= radius) {
    return refuse("the tolerance must be less than half the cutter's diameter", o.tolerance);
  }
  for (const auto& feed : {o.feed, o.plunge_feed, o.rapid_feed}) {
    if (feed && !positive(*feed)) return refuse("feeds must be greater than 0", *feed);
    if (feed && (*feed < exchange::kLeastFeed || *feed > exchange::kGreatestFeed)) {
      return refuse(
          "no machine has such a feed", *feed,
          fmt::format("{} to {} a minute", exchange::kLeastFeed, exchange::kGreatestFeed));
    }
  }
  if (o.acceleration &&
      !(positive(*o.acceleration) && *o.acceleration >= exchange::kLeastAcceleration)) {
    return refuse(
        fmt::format("the acceleration must be at least {} mm/s^2", exchange::kLeastAcceleration),
        *o.acceleration);
  }
  if (o.acceleration && *o.acceleration > exchange::kGreatestAcceleration) {
    return refuse("this is no limit of acceleration any more", *o.acceleration,
                  fmt::format("at most {} mm/s^2", exchange::kGreatestAcceleration));
  }
  if (o.safe_z && std::abs(*o.safe_z) * to_machine > exchange::kLongestWay) {
    return refuse("no machine is so high", *o.safe_z, "check the unit of the surface");
  }
  if (!(o.allowance >= 0.0) || !std::isfinite(o.allowance)) {
    return refuse("the allowance must not be less than 0", o.allowance);
  }
  if (o.spindle && *o.spindle > exchange::kGreatestSpeed) {
    return refuse("no spindle is so fast", *o.spindle,
                  fmt::format("at most {} revolutions a minute", exchange::kGreatestSpeed));
  }
  if (o.spindle && !(std::isfinite(*o.spindle) && *o.spindle > kLeastSpindle)) {
    return refuse("the spindle's speed must be more than 0.5 revolutions a minute", *o.spindle,
                  "programs hold whole numbers");
  }
  if (o.step_down && !positive(*o.step_down)) {
    return refuse("the step down must be greater than 0", *o.step_down);
  }
  OBVID_TRY(check_roughing(o));
  OBVID_TRY(check_levels(o));
  OBVID_TRY(check_entry(o));
  OBVID_TRY(check_earlier(o));
  const bool by_steps = o.strategy == ToolpathStrategy::kZLevel && o.step_down;
  if (!o.scallop && !o.step_over && !by_steps) {
    return refuse("neither scallop nor step over is given", 0.0, "give one of them or both");
  }
  if (o.scallop && (!positive(*o.scallop) || *o.scallop >= radius)) {
    return refuse("the scallop must lie between 0 and half the cutter's diameter", *o.scallop);
  }
  if (o.step_over && (!positive(*o.step_over) || *o.step_over > o.cutter.diameter)) {
    return refuse("the step over must lie between 0 and the cutter's diameter", *o.step_over);
  }
  if (o.strategy == ToolpathStrategy::kConstantScallop && !o.scallop) {
    return refuse("constant scallop height needs that height", 0.0, "give the scallop");
  }
  if (!(std::abs(o.angle_deg) <= kMostAngle)) return refuse("the angle is no angle", o.angle_deg);
  if (o.safe_z && !std::isfinite(*o.safe_z)) {
    return refuse("the safe height is no number", *o.safe_z);
  }
  return {};
}

Result<Family> family_of(const Part& part, const ToolpathOptions& options, const StepRule& rule,
                         Walker& walker, const Leftover* left, const RunContext& run) {
  switch (options.strategy) {
    case ToolpathStrategy::kZigzag:
      return zigzag(part, options, rule, walker, left, run);
    case ToolpathStrategy::kIsoparametric:
      return isoparametric(part, options, rule, walker, left, run);
    case ToolpathStrategy::kZLevel:
      return Family{};
    case ToolpathStrategy::kConstantScallop:
    case ToolpathStrategy::kRough:
      break;
  }
  return constant_scallop(part, options, rule, walker, left, run);
}

std::size_t lifted_points(const Family& family) {
  std::size_t count = 0;
  for (const Pass& pass : family) {
    for (const auto& piece : pass.pieces) {
      count += static_cast<std::size_t>(
          std::count_if(piece.begin(), piece.end(), [](const PassPoint& p) { return p.lifted; }));
    }
  }
  return count;
}

std::string place_text(Vec3 p) { return fmt::format("{:.6g} {:.6g} {:.6g}", p.x, p.y, p.z); }

void take_over(const SimulationReport& seen, double spacing, ToolpathReport& out) {
  out.gouge = {seen.depth.found, seen.depth.most, seen.depth.place};
  out.scallop = {seen.left.found, seen.left.most, seen.left.place};
  out.spacing = spacing;
  out.surface_area = seen.area;
  out.hidden_area = seen.hidden_area;
  out.hidden_places = seen.hidden;
  out.hidden_place = seen.hidden_place;
  out.unreached_places = seen.held_places;
  out.unreached_area = seen.held_area;
  out.unreached_depth = seen.held;
  out.unreached_place = seen.held_place;
  out.flat_left = seen.flat_left.found;
  out.flat_place = seen.flat_left.place;
  out.flat_area = seen.flat_area;
}

void judge(Toolpath& out, const ToolpathOptions& options) {
  const ToolpathReport& r = out.report;
  const auto add = [&](std::string what, double value, std::string hint) {
    out.not_kept.push_back(
        error(ErrorCode::kToleranceNotReached, std::move(what)).hint(std::move(hint)).value(value));
  };
  if (options.earlier && r.leftover_area == 0.0) {
    out.warnings.push_back(
        "the earlier cutter comes to every place that is seen from above: nothing "
        "is left for this one");
  } else if (r.passes == 0) {
    add(options.strategy == ToolpathStrategy::kZLevel
            ? "no pass: nothing is a wall that levels go around"
            : "no pass: the cutter meets nothing",
        0.0, "");
  }
  if (r.gouge.found > out.tolerance) {
    add(fmt::format("the program cuts {:.3g} {} into the surface at {}, {:.3g} are allowed",
                    r.gouge.found, out.units.text(), place_text(r.gouge.place), out.tolerance),
        r.gouge.found, "do not run it; a smaller --tolerance may keep it");
  }
  const bool ball = options.cutter.kind == CutterKind::kBall;
  if (options.scallop && !std::isfinite(r.scallop.found)) {
    add(fmt::format("no pass comes to the surface from outside at {}: what stays beside it is not "
                    "bounded",
                    place_text(r.scallop.place)),
        r.scallop.found,
        ball ? "another strategy or angle may come there"
             : "a ball cutter, or another strategy or angle, may come there");
  } else if (options.scallop && r.scallop.found > *options.scallop) {
    add(fmt::format("the residual scallop height is {:.3g} {} at {}, where {:.3g} was asked for",
                    r.scallop.found, out.units.text(), place_text(r.scallop.place),
                    *options.scallop),
        r.scallop.found,
        fmt::format("{}another strategy or angle, or a smaller --step-over, leaves less",
                    ball ? "" : "a ball cutter, "));
  }
  if (r.narrow_stretches > 0) {
    const bool helix = options.entry == ToolpathEntry::kHelix;
    out.warnings.push_back(fmt::format("{} stretches are too short for the ramp{} and are left out",
                                       r.narrow_stretches, helix ? " and the helix" : ""));
  }
  if (options.strategy != ToolpathStrategy::kRough && fall_of(options) && r.entries.straight > 0) {
    out.warnings.push_back(fmt::format("no room for a ramp: {} of {} entries go straight down",
                                       r.entries.straight,
                                       r.entries.helical + r.entries.ramped + r.entries.straight));
  }
  // figures of so many digits are told: what is no more than their rounding is as asked for
  const double rounding = std::pow(10.0, -kAngleDigits) * r.entries.asked_deg;
  if (r.entries.asked_deg > 0.0 && r.entries.steepest_deg > r.entries.asked_deg + rounding) {
    out.warnings.push_back(fmt::format(
        "entries go down at up to {} degrees against the level, at {}, where {:g} were asked "
        "for: there is no room for a flatter way over the pass or beside it, back and forth up to "
        "{:g} times",
        significant_above(r.entries.steepest_deg, 3), place_text(r.entries.steepest_place),
        r.entries.asked_deg, kMostLegs));
  }
  if (r.unreached_area > 0.0) {
    add(fmt::format("about {:.3g} % of the surface is narrower than the cutter: up to {} {} stay, "
                    "most at {}",
                    100.0 * r.unreached_area / r.surface_area,
                    significant_above(r.unreached_depth, 3), out.units.text(),
                    place_text(r.unreached_place)),
        r.unreached_depth, "a smaller cutter reaches more");
  }
  if (r.flat_area > 0.0) {
    const std::string left =
        std::isfinite(r.flat_left)
            ? fmt::format("up to {} {}", significant_above(r.flat_left, 3), out.units.text())
            : "no pass comes over it";
    add(fmt::format("about {:.3g} % of the surface is flatter than levels are for and keeps too "
                    "much: {} at {}",
                    100.0 * r.flat_area / r.surface_area, left, place_text(r.flat_place)),
        r.flat_left, "zigzag with --steep-angle cuts both");
  }
  if (r.hidden_area > 0.0) {
    out.warnings.push_back(
        fmt::format("about {:.3g} % of the surface is hidden from above (undersides and undercuts, "
                    "the lowest at {}) and is not cut",
                    100.0 * r.hidden_area / r.surface_area, place_text(r.hidden_place)));
  }
}

void tell_steepest(const std::vector<ToolpathMove>& moves, const ToolpathOptions& options,
                   ToolpathEntries& out) {
  Steepest steepest;
  for (const ToolpathMove& move : moves) {
    if (move.kind != ToolMove::kPlunge) continue;
    const Steepest one = steepest_of(move.points);
    if (one.fall > steepest.fall) steepest = one;
  }
  out.steepest_deg = std::atan(steepest.fall) / kOneDegree;
  out.steepest_place = steepest.place;
  out.asked_deg = asked_deg(options);
}

/// Prints the program, reads it back and reports on that.
Result<void> finish(const Part& part, const SurfaceCells& cells, LargeList<Nearest>& reach,
                    const Leftover* left, const ToolpathOptions& options, const RunContext& run,
                    Toolpath& out) {
  auto program = toolpath_gcode(out, options.gcode, options.threads);
  OBVID_TRY(program);
  out.program = std::move(*program);
  out.report.minutes = out.program.minutes;
  out.report.cutting_length = out.program.cutting_length;
  out.report.plunge_length = out.program.plunge_length;
  out.report.rapid_length = out.program.rapid_length;
  tell_steepest(out.moves, options, out.report.entries);
  const auto seen = check_program(part, cells, reach, left, out.program.text,
                                  *exchange::machine_units_in(out.units), options, run);
  OBVID_TRY(seen);
  take_over(*seen, cells.spacing(), out.report);
  out.hidden_strokes = seen->hidden_strokes;
  out.unreached_strokes = seen->held_strokes;
  return {};
}

Result<SurfaceCells> cells_of(const Part& part, const StepRule& rule,
                              const ToolpathOptions& options, const RunContext& run) {
  const double radius = part.cutter().radius;
  const double spacing = std::min(kCellOfRadius * radius, kCellOfStep * rule.level());
  return SurfaceCells::make(part, spacing, radius, options.threads, run);
}

Result<std::optional<Leftover>> leftover_of(const Part& part, const ToolpathOptions& options,
                                            const StepRule& rule, const SurfaceCells& cells,
                                            LargeList<Nearest>& reach, const RunContext& run) {
  if (!options.earlier) return std::optional<Leftover>{};
  const auto earlier = shape_of(*options.earlier);
  OBVID_TRY(earlier);
  auto found = Leftover::find(part, *earlier, cells, reach, rule.level() + cells.spacing(),
                              options.threads, run);
  OBVID_TRY(found);
  return std::optional(std::move(*found));
}

void tell_leftover(const Leftover& left, ToolpathReport& out) {
  out.leftover_area = left.area();
  out.leftover_depth = left.depth();
  out.leftover_place = left.place();
}

Toolpath begun(const SurfaceModel& model, const ToolpathOptions& options) {
  Toolpath out;
  out.name = model.name;
  out.units = model.units;
  out.cutter = options.cutter;
  out.tolerance = options.tolerance;
  out.spindle = options.spindle;
  out.acceleration = options.acceleration;
  out.print_within = print_within(options);
  const ToolpathFeeds usual = default_feeds(model.units);
  out.feeds = {options.feed.value_or(usual.pass), options.plunge_feed.value_or(usual.plunge),
               options.rapid_feed.value_or(usual.rapid)};
  return out;
}

/// Lengths that have nothing to do with the part: of another unit, most likely.
Result<void> check_against_part(const SurfaceModel& model, const ToolpathOptions& o) {
  struct Given {
    const char* what;
    double length;
  };
  const double size = size_of(model);
  for (const auto& [what, length] :
       {Given{"the cutter", o.cutter.diameter}, Given{"the allowance", o.allowance},
        Given{"the earlier cutter", o.earlier ? o.earlier->diameter : 0.0}}) {
    if (length <= kLargestOfPart * size) continue;
    return refuse(fmt::format("{} is more than a hundred times as large as the part", what), length,
                  "give lengths in units of the surface");
  }
  return {};
}

Result<Toolpath> planned(const SurfaceModel& model, const ToolpathOptions& options,
                         const CutterShape& cutter, const RunContext& run) {
  OBVID_TRY(check_against_part(model, options));
  const auto part =
      Part::make(model, cutter, options.tolerance, options.allowance, options.threads, run);
  OBVID_TRY(part);
  Toolpath out = begun(model, options);
  const bool rough = options.strategy == ToolpathStrategy::kRough;
  double top = part->field().high().z + options.allowance;
  if (rough) top = std::max(top, stock_of(*part, options)[1].z);
  out.report.safe_z = options.safe_z.value_or(top + kDefaultSafe * options.cutter.diameter);
  if (out.report.safe_z < top + options.tolerance) {
    return error(ErrorCode::kBadOption, "the safe height is not above the part and its stock")
        .hint(fmt::format("choose more than {:g}", top))
        .value(out.report.safe_z);
  }
  const StepRule rule(cutter, options);
  if (rough) {
    const auto cells = cells_of(*part, rule, options, run);
    OBVID_TRY(cells);
    auto reach = large_list<Nearest>(cells->cells().size(), {}, options.threads);
    OBVID_TRY(lay_rough(*part, options, run, out));
    OBVID_TRY(finish(*part, *cells, reach, nullptr, options, run, out));
    judge(out, options);
    return out;
  }
  const bool straight = options.strategy == ToolpathStrategy::kZigzag;
  const PassFrame frame = pass_frame(*part, options.angle_deg);
  Walker walker(*part, rule.level(), straight ? std::optional(frame.along) : std::nullopt, options);
  const auto made = cells_of(*part, rule, options, run);
  OBVID_TRY(made);
  const SurfaceCells& cells = *made;
  auto reach = large_list<Nearest>(cells.cells().size(), {}, options.threads);
  const auto leftover = leftover_of(*part, options, rule, cells, reach, run);
  OBVID_TRY(leftover);
  const Leftover* left = *leftover ? &**leftover : nullptr;
  if (left != nullptr) tell_leftover(*left, out.report);
  auto family = family_of(*part, options, rule, walker, left, run);
  OBVID_TRY(family);
  std::optional<LevelPasses> levels;
  if (flat_from(options)) {
    levels.emplace(*part, options, rule, left);
    OBVID_TRY(levels->lay(cells, run));
  }
  ScallopSurvey survey(*part, options, rule, cells, reach, left, walker);
  const ToolpathReport fresh = out.report;
  std::size_t all_added = 0;
  double share = kScallopLimit;
  for (int attempt = 1;; ++attempt, share *= kLowerShare) {
    const auto added = survey.complete(*family, levels ? &*levels : nullptr, share, run);
    OBVID_TRY(added);
    all_added += *added;
    out.report = fresh;
    out.report.added_passes = all_added;
    out.report.lifted_points = lifted_points(*family);
    Family all;
    if (levels) {
      all = levels->in_order();
      out.report.levels = levels->levels();
    }
    const auto append = [&](const Family& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    // fronts need no links along their rails; passes cut short by what was added lie anywhere
    const bool scattered = all_added > 0 && options.strategy == ToolpathStrategy::kConstantScallop;
    if (left != nullptr || scattered) {
      append(in_short_order(*family, !options.one_way));
    } else {
      append(*family);
    }
    lay_moves(all, options, rule.level(), walker, out);
    OBVID_TRY(finish(*part, cells, reach, left, options, run, out));
    const bool high = options.scallop && out.report.scallop.found > *options.scallop &&
                      std::isfinite(out.report.scallop.found);  // else more passes help no more
    const bool stuck = levels && *added == 0 && attempt > 1;
    if (!high || stuck || attempt == kMostAttempts) break;
  }
  judge(out, options);
  return out;
}

}  // namespace

Result<Toolpath> plan(const SurfaceModel& model, const ToolpathOptions& options,
                      const RunContext& run) {
  const auto cutter = shape_of(options.cutter);
  OBVID_TRY(cutter);
  const auto to_machine = exchange::machine_units_in(model.units);
  OBVID_TRY(to_machine);
  OBVID_TRY(check_sizes(options, *to_machine));
  if (model.patches.empty()) {
    return error(ErrorCode::kNothingThere, "the model has no patches");
  }
  return planned(model, options, *cutter, run);
}

std::vector<std::vector<Vec3>> cutting_lines(const Toolpath& path, double within) {
  std::vector<std::vector<Vec3>> lines;
  for (const ToolpathMove& move : path.moves) {
    if (move.kind != ToolMove::kPass && move.kind != ToolMove::kLink) continue;
    lines.push_back(thinned(move.points, within));
  }
  return lines;
}

std::vector<std::vector<Vec3>> rapid_lines(const Toolpath& path) {
  std::vector<std::vector<Vec3>> lines;
  for (const ToolpathMove& move : path.moves) {
    const bool cuts = move.kind == ToolMove::kPass || move.kind == ToolMove::kLink;
    if (!cuts && move.points.size() > 1) lines.push_back(move.points);
  }
  return lines;
}

}  // namespace obvid
