// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/format_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/profiles.h"

namespace obvid {
namespace {

Result<void> check_length(const std::optional<double>& value, const char* option) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return {};
  return fail(bad_option("a positive length is expected", option, "for example 0.01"));
}

}  // namespace

Result<void> set_import(const FormatValues& typed, ImportOptions& options) {
  if (typed.curve && *typed.curve < 1) {
    return fail(
        bad_option("curves are counted from 1", "--curve", "`obvid analyse FILE` lists them"));
  }
  if (auto done = check_length(typed.chord_tolerance, "--chord-tolerance"); !done) return done;
  if (typed.curve) options.curve = static_cast<std::size_t>(*typed.curve - 1);
  options.tolerance = typed.chord_tolerance;
  const auto use = value_named<DrawnUse>(
      {{"auto", DrawnUse::kAutomatic}, {"exact", DrawnUse::kExact}, {"points", DrawnUse::kPoints}},
      typed.drawing, "--drawing");
  if (!use) return fail(use.error());
  options.use = *use;
  return {};
}

namespace {

constexpr std::array kSteps = {std::pair{"ap214", CadFormat::kStepAp214},
                               std::pair{"ap242", CadFormat::kStepAp242}};
constexpr std::array kDxf = {
    std::pair{"exact", DxfProfile::kExact}, std::pair{"arcs", DxfProfile::kArcs},
    std::pair{"cubic", DxfProfile::kCubic}, std::pair{"r12", DxfProfile::kArcsR12}};
constexpr std::array kControllers = {std::pair{"grbl", GcodeController::kGrbl},
                                     std::pair{"linuxcnc", GcodeController::kLinuxCnc},
                                     std::pair{"fanuc", GcodeController::kFanuc}};
constexpr std::array kMotions = {std::pair{"arcs", GcodeMotion::kArcs},
                                 std::pair{"lines", GcodeMotion::kLines},
                                 std::pair{"splines", GcodeMotion::kSplines}};

constexpr std::array kPlots = {std::pair{"curvature", false}, std::pair{"slope", true}};
constexpr std::array kSvg = {std::pair{"picture", false}, std::pair{"drawing", true}};

/// The value of a typed name; nothing typed leaves it as it is.
template <class Names, class Value>
Result<void> choose(const std::optional<std::string>& typed, const Names& names, const char* option,
                    Value& value) {
  if (!typed) return {};
  std::string all;
  for (const auto& [name, one] : names) {
    if (*typed == name) {
      value = one;
      return {};
    }
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  return fail(bad_option("unknown choice '" + *typed + "'", option, "one of " + all));
}

}  // namespace

Result<void> set_plots(const FormatValues& typed, PicturePlots& plots) {
  return choose(typed.plot, kPlots, "--plot", plots.slope);
}

Result<void> set_formats(const FormatValues& typed, ExportOptions& options,
                         std::string& profile_text) {
  if (typed.profile) {
    const auto profile = profile_of(*typed.profile);
    if (!profile) return fail(profile.error());
    options = profile->options;
    profile_text = "for " + profile->name + ": " + profile->choices;
  }
  for (const auto& [value, option] :
       {std::pair{typed.tolerance, "--output-tolerance"}, std::pair{typed.face_width, "--face"},
        std::pair{typed.feed, "--feed"}, std::pair{typed.sample_step, "--sample-step"}}) {
    if (auto done = check_length(value, option); !done) return done;
  }
  if (typed.samples && *typed.samples < 2) {
    return fail(bad_option("two samples at least are needed", "--samples", "for example 200"));
  }
  options.tolerance = typed.tolerance;
  if (typed.samples) options.samples.count = static_cast<std::size_t>(*typed.samples);
  options.samples.step = typed.sample_step;
  if (typed.face_width) options.face_width = *typed.face_width;
  if (typed.feed) options.feed = *typed.feed;
  return choose(typed.step, kSteps, "--step", options.step)
      .and_then([&] { return choose(typed.dxf, kDxf, "--dxf", options.dxf); })
      .and_then([&] {
        return choose(typed.controller, kControllers, "--controller", options.controller);
      })
      .and_then([&] { return choose(typed.svg, kSvg, "--svg", options.drawing); })
      .and_then([&] { return set_plots(typed, options.plots); })
      .and_then([&] { return choose(typed.motion, kMotions, "--motion", options.motion); });
}

}  // namespace obvid
