// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "families.h"
#include "machine_units.h"
#include "moves.h"
#include "obvid/toolpath/toolpath.h"
#include "reach_report.h"
#include "scallop_meter.h"
#include "scallop_survey.h"

namespace obvid {
namespace {

using namespace toolpath;

constexpr int kRounds = 4;               // of passes put between others
constexpr double kMeasureSpacing = 0.5;  // of the level step, along passes
constexpr double kMeasureOfRadius = 0.25;
constexpr double kPassMargin = 2.0;   // measured places that an added pass goes beyond both ends
constexpr double kDefaultSafe = 0.5;  // diameters above the highest point
constexpr double kMostAngle = 1e6;    // degrees: beyond, the angle is lost in rounding

Result<void> refuse(std::string what, double value, std::string hint = "") {
  return fail({ErrorCode::kBadOption, std::move(what), "", std::move(hint), -1, value});
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

Result<void> check_sizes(const ToolpathOptions& o) {
  if (!positive(o.tolerance)) return refuse("the tolerance must be greater than 0", o.tolerance);
  const double radius = 0.5 * o.cutter.diameter;
  if (o.tolerance >= radius) {
    return refuse("the tolerance must be less than half the cutter's diameter", o.tolerance);
  }
  for (const double feed : {o.feed, o.plunge_feed, o.rapid_feed}) {
    if (!positive(feed)) return refuse("feeds must be greater than 0", feed);
  }
  if (!o.scallop && !o.step_over) {
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
                         Walker& walker, const Progress& progress) {
  switch (options.strategy) {
    case ToolpathStrategy::kZigzag:
      return zigzag(part, options, rule, walker, progress);
    case ToolpathStrategy::kIsoparametric:
      return isoparametric(part, options, rule, walker, progress);
    case ToolpathStrategy::kConstantScallop:
      break;
  }
  return constant_scallop(part, options, rule, walker, progress);
}

/// Measures between passes and puts others where they leave too much: between contacts (walls are
/// seen there), then over the whole stock.
class Filler {
 public:
  Filler(const Part& part, const ToolpathOptions& options, const StepRule& rule, Walker& walker)
      : meter_(part, options.scallop.value_or(part.cutter().radius)),
        survey_(part, options, rule, walker),
        walker_(walker),
        spacing_(std::min(kMeasureSpacing * rule.level(), kMeasureOfRadius * part.cutter().radius)),
        fills_(options.scallop.has_value()) {}

  Result<Family> fill(Family first, ToolpathReport& report, const Progress& progress) {
    auto family = between_contacts(std::move(first), report, progress);
    if (!family) return family;
    const auto added =
        survey_.complete(*family, progress, [this](const Pass& pass) { meter_.add(pass); });
    if (!added) return fail(added.error());
    report.added_passes += *added;
    const HighSpot spot = survey_.highest();
    keep(spot.height, spot.place, report);
    for (const Place& place : high_) keep(meter_.left_over(place), place, report);
    report.scallop_raster = survey_.raster();
    return family;
  }

 private:
  static void keep(double height, const Place& place, ToolpathReport& report) {
    if (height <= report.scallop) return;
    report.scallop = height;
    report.scallop_place = place.contact;
  }

  Result<Family> between_contacts(Family family, ToolpathReport& report, const Progress& progress) {
    for (const Pass& pass : family) meter_.add(pass);
    std::vector<bool> done(family.size(), false);  // gaps behind the passes
    for (int round = 0;; ++round) {
      Family next;
      std::vector<bool> next_done;
      bool added = false;
      for (std::size_t i = 0; i < family.size(); ++i) {
        const bool pair = i + 1 < family.size() && !family[i].empty() && !family[i + 1].empty();
        Pass extra;
        if (pair && !done[i]) {
          const Gap gap = meter_.between(family[i], family[i + 1], spacing_);
          if (gap.too_high && fills_ && round < kRounds) {
            auto pass = between_passes(family[i], family[i + 1], gap);
            if (!pass) return fail(pass.error());
            extra = std::move(*pass);
          }
          if (extra.empty()) {
            report.scallop = std::max(report.scallop, gap.scallop);
            high_.insert(high_.end(), gap.high.begin(), gap.high.end());
          }
        }
        next.push_back(std::move(family[i]));
        next_done.push_back(done[i] || extra.empty());
        if (extra.empty()) continue;
        meter_.add(extra);
        ++report.added_passes;
        added = true;
        next.push_back(std::move(extra));
        next_done.push_back(false);
        if (progress)
          progress("scallops", static_cast<double>(i) / static_cast<double>(family.size()));
      }
      family = std::move(next);
      done = std::move(next_done);
      if (!added) return family;
    }
  }

  Result<Pass> between_passes(const Pass& a, const Pass& b, const Gap& gap) {
    Rail rail = toolpath::between(a.rail, b.rail);
    double length = 0.0;
    for (std::size_t i = 1; i < rail.axis.size(); ++i) {
      length += norm(rail.axis[i] - rail.axis[i - 1]);
    }
    const double margin = length > 0.0 ? kPassMargin * spacing_ / length : 1.0;
    rail.from = std::max({gap.from - margin, 0.0});
    rail.to = std::min({gap.to + margin, 1.0});
    return walker_.walk(rail);
  }

  ScallopMeter meter_;
  ScallopSurvey survey_;
  std::vector<Place> high_;  ///< between contacts, at last
  Walker& walker_;
  double spacing_;
  bool fills_;
};

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

void warn(Toolpath& out, const ToolpathOptions& options) {
  const ToolpathReport& r = out.report;
  const auto add = [&](std::string text) { out.warnings.push_back(std::move(text)); };
  if (options.scallop && r.scallop > *options.scallop) {
    const Vec3 at = r.scallop_place;
    add(
        fmt::format("scallops of up to {:.3g} {} stay, {:.3g} more than asked for; the highest at "
                    "{:.6g} {:.6g} "
                    "{:.6g}",
                    r.scallop, out.units, r.scallop - *options.scallop, at.x, at.y, at.z));
  }
  if (r.hidden_area > 0.0) {
    add(fmt::format("{:.3g} % of the surface is hidden from above and is not cut",
                    100.0 * r.hidden_area / r.surface_area));
  }
  if (r.unreached_area > 0.0) {
    add(fmt::format(
        "{:.3g} % of the surface is narrower than the cutter, up to {:.3g} {} stay there",
        100.0 * r.unreached_area / r.surface_area, r.unreached_depth, out.units));
  }
  if (r.passes == 0) add("no pass: the cutter meets nothing");
}

Result<Toolpath> planned(const SurfaceModel& model, const ToolpathOptions& options,
                         const CutterShape& cutter, const Progress& progress) {
  const auto part = Part::make(model, cutter, options.tolerance, progress);
  if (!part) return fail(part.error());
  Toolpath out{model.name,
               model.units.name,
               options.cutter,
               options.tolerance,
               options.feed,
               options.plunge_feed,
               {},
               {},
               {}};
  const double top = part->field().high().z;
  out.report.safe_z = options.safe_z.value_or(top + kDefaultSafe * options.cutter.diameter);
  if (out.report.safe_z < top + options.tolerance) {
    return fail({ErrorCode::kBadOption, "the safe height is not above the part", "",
                 fmt::format("choose more than {:g}", top), -1, out.report.safe_z});
  }
  const StepRule rule(cutter, options);
  Walker walker(*part, rule.level(), options.most_points);
  auto family = family_of(*part, options, rule, walker, progress);
  if (!family) return fail(family.error());
  auto filled = Filler(*part, options, rule, walker).fill(std::move(*family), out.report, progress);
  if (!filled) return fail(filled.error());
  out.report.lifted_points = lifted_points(*filled);
  lay_moves(*filled, options, rule.level(), walker, out);
  report_reach(*part, out.report);
  warn(out, options);
  return out;
}

}  // namespace

Result<Toolpath> plan(const SurfaceModel& model, const ToolpathOptions& options,
                      const Progress& progress) {
  const auto cutter = shape_of(options.cutter);
  if (!cutter) return fail(cutter.error());
  if (const auto good = check_sizes(options); !good) return fail(good.error());
  if (model.patches.empty()) {
    return fail({ErrorCode::kTooFewPoints, "the model has no patches", "", "", -1, 0.0});
  }
  if (machine_scale(model.units.name) == 0.0) {
    return fail({ErrorCode::kUnsupported, "machines do not know the unit " + model.units.name, "",
                 "known are um, mm, cm, m, km, in, ft", -1, 0.0});
  }
  return planned(model, options, *cutter, progress);
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
