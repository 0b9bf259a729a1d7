// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/format_values.h"
#include "obvid/exchange/internal/gcode/dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/internal/typed_numbers.h"
#include "obvid/pipeline/file_formats.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/profiles.h"

namespace obvid {
namespace {

Result<void> check_length(const std::optional<double>& value, const char* option) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return {};
  return fail(bad_option("a positive length is expected", option, "for example 0.01"));
}

Result<void> set_curve(const FormatValues& typed, CurveChoice& curve) {
  if (!typed.curve) return {};
  const auto number = typed_numbers<long>(*typed.curve);
  const bool several = typed.curve->find(',') != std::string::npos;
  const bool from_one =
      !number || std::all_of(number->begin(), number->end(), [](long one) { return one >= 1; });
  if (typed.curve->empty() || !from_one) {
    return fail(
        bad_option("curves are counted from 1", "--curve", "`obvid analyse FILE` lists them"));
  }
  if (*typed.curve == "all") {
    curve.all = true;
  } else if (several) {
    std::istringstream items(*typed.curve);
    for (std::string item; std::getline(items, item, ',');) {
      if (!item.empty()) curve.several.push_back(std::move(item));
    }
  } else if (number) {
    curve.number = static_cast<std::size_t>(number->front() - 1);
  } else {
    curve.name = *typed.curve;
  }
  return {};
}

Result<void> set_list(const FormatValues& typed, PointListOptions& list) {
  if (typed.skip && *typed.skip < 0) {
    return fail(bad_option("a number of lines is expected", "--skip", "for example 3"));
  }
  list.skip = static_cast<std::size_t>(typed.skip.value_or(0));
  if (typed.columns.empty()) return {};
  constexpr long kMost = 64;  // columns that are looked at
  const auto both = typed_numbers<long>(typed.columns);
  const bool fine = both && both->size() == 2 && both->front() != both->back() &&
                    std::all_of(both->begin(), both->end(),
                                [](long column) { return column >= 1 && column <= kMost; });
  if (!fine) {
    return fail(bad_option("'" + typed.columns + "' are no two columns", "--columns",
                           "those of x and y, counted from 1: 2,3"));
  }
  list.columns = {static_cast<std::size_t>(both->front() - 1),
                  static_cast<std::size_t>(both->back() - 1)};
  return {};
}

Result<void> set_placement(const FormatValues& typed, Placement& placement) {
  if (typed.scale && !(*typed.scale > 0.0 && std::isfinite(*typed.scale))) {
    return fail(bad_option("a positive factor is expected", "--scale", "for example 25.4"));
  }
  if (typed.rotate_deg && !std::isfinite(*typed.rotate_deg)) {
    return fail(bad_option("an angle in degrees is expected", "--rotate", "for example 90"));
  }
  placement.scale = typed.scale.value_or(1.0);
  placement.turn = std::remainder(typed.rotate_deg.value_or(0.0), 360.0) * kOneDegree;
  if (!typed.mirror.empty()) {
    const auto mirror =
        value_named<Mirror>({{"x", Mirror::kX}, {"y", Mirror::kY}}, typed.mirror, "--mirror");
    OBVID_TRY(mirror);
    placement.mirror = *mirror;
  }
  if (typed.move.empty()) return {};
  const auto by = typed_numbers(typed.move);
  const bool fine = by && (by->size() == 2 || by->size() == 3);
  if (!fine) {
    return fail(bad_option("'" + typed.move + "' is no move", "--move",
                           "two lengths, along x and y: 100,-20 (a third one along z)"));
  }
  placement.move = {(*by)[0], (*by)[1], by->size() == 3 ? (*by)[2] : 0.0};
  return {};
}

}  // namespace

Result<void> set_import(const FormatValues& typed, ImportOptions& options) {
  OBVID_TRY(set_curve(typed, options.curve));
  OBVID_TRY(set_list(typed, options.list));
  OBVID_TRY(set_placement(typed, options.placement));
  OBVID_TRY(check_length(typed.chord_tolerance, "--chord-tolerance"));
  options.tolerance = typed.chord_tolerance;
  const auto use = value_named<DrawnUse>(
      {{"auto", DrawnUse::kAutomatic}, {"exact", DrawnUse::kExact}, {"points", DrawnUse::kPoints}},
      typed.drawing, "--drawing");
  OBVID_TRY(use);
  options.use = *use;
  for (const std::string& one : typed.cut) {
    auto planes = plane_row_named(one);
    OBVID_TRY(planes);
    options.planes.push_back(*planes);
  }
  options.unordered = typed.unordered;
  options.drop_outliers = typed.drop_outliers;
  return {};
}

namespace {

constexpr std::array kSteps = {std::pair{"ap214", CadFormat::kStepAp214},
                               std::pair{"ap242", CadFormat::kStepAp242}};
constexpr std::array kDxf = {
    std::pair{"exact", DxfProfile::kExact}, std::pair{"arcs", DxfProfile::kArcs},
    std::pair{"cubic", DxfProfile::kCubic}, std::pair{"r12", DxfProfile::kArcsR12}};
constexpr std::array kMotions = {std::pair{"arcs", GcodeMotion::kArcs},
                                 std::pair{"lines", GcodeMotion::kLines},
                                 std::pair{"splines", GcodeMotion::kSplines}};

constexpr std::array kAirfoils = {std::pair{"selig", AirfoilLayout::kSelig},
                                  std::pair{"lednicer", AirfoilLayout::kLednicer}};
constexpr std::array kSpacings = {std::pair{"cosine", AirfoilSpacing::kCosine},
                                  std::pair{"curvature", AirfoilSpacing::kCurvature},
                                  std::pair{"uniform", AirfoilSpacing::kUniform}};

constexpr std::array kTrailingForms = {std::pair{"blunt", TrailingEdgeForm::kBlunt},
                                       std::pair{"round", TrailingEdgeForm::kRound}};

constexpr std::array kPlots = {std::pair{"curvature", PicturePlots{}},
                               std::pair{"slope", PicturePlots{.slope = true}},
                               std::pair{"deviations", PicturePlots{.deviations = true}}};
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

Result<void> set_shown(const FormatValues& typed, ShownCurvatures& shown) {
  using enum ShownCurvatures::Which;
  if (!typed.curvature_range || *typed.curvature_range == "auto") return {};
  if (*typed.curvature_range == "all") {
    shown.which = kAll;
    return {};
  }
  const auto range = typed_range(*typed.curvature_range);
  if (!range || !std::isfinite(range->low) || !std::isfinite(range->high) ||
      !(range->low < range->high)) {
    return fail(bad_option("a range of curvatures is expected", "--curvature-range",
                           "LOW..HIGH in 1/unit, for example -0.5..2; all or auto"));
  }
  shown = {kRange, *range};
  return {};
}

namespace {

/// One of the names, or deviations and what they are held against.
Result<void> choose_plot(const std::optional<std::string>& typed, PicturePlots& plots) {
  constexpr std::string_view kHeldAgainst = "deviations:";
  if (!typed || !typed->starts_with(kHeldAgainst)) return choose(typed, kPlots, "--plot", plots);
  const auto length = obvid::typed_number(std::string_view(*typed).substr(kHeldAgainst.size()));
  if (!length || !(*length > 0.0) || !std::isfinite(*length)) {
    return fail(bad_option("a positive length is expected behind 'deviations:'", "--plot",
                           "for example deviations:0.01, in the unit of the points"));
  }
  plots.deviations = true;
  plots.allowed = *length;
  return {};
}

}  // namespace

/// A length in chords as it is typed: 0.12 or 12%.
Result<void> set_chords(const std::optional<std::string>& typed, const char* option,
                        const char* hint, std::optional<double>& chords) {
  constexpr double kPercent = 0.01;
  if (!typed) return {};
  const bool percent = typed->ends_with('%');
  const auto number =
      typed_number(std::string_view(*typed).substr(0, typed->size() - (percent ? 1 : 0)));
  if (!number || !std::isfinite(*number)) {
    return fail(bad_option("a length in chords is expected", option, hint));
  }
  chords = percent ? kPercent * *number : *number;
  return {};
}

Result<void> set_plots(const FormatValues& typed, PicturePlots& plots) {
  return choose_plot(typed.plot, plots).and_then([&] {
    return set_shown(typed, plots.curvatures);
  });
}

Result<void> set_formats(const FormatValues& typed, ExportOptions& options,
                         std::string& profile_text) {
  if (typed.profile) {
    const auto profile = profile_of(*typed.profile);
    OBVID_TRY(profile);
    options = profile->options;
    profile_text = "for " + profile->name + ": " + profile->choices;
  }
  for (const auto& [value, option] :
       {std::pair{typed.tolerance, "--output-tolerance"}, std::pair{typed.face_width, "--face"},
        std::pair{typed.feed, "--feed"}, std::pair{typed.sample_step, "--sample-step"}}) {
    OBVID_TRY(check_length(value, option));
  }
  if (typed.samples && *typed.samples < 2) {
    return fail(bad_option("two samples at least are needed", "--samples", "for example 200"));
  }
  options.tolerance = typed.tolerance;
  if (typed.samples) options.samples.count = static_cast<std::size_t>(*typed.samples);
  options.samples.step = typed.sample_step;
  constexpr long kMoreThanDecimals = 100;  // which is refused
  constexpr double kMostTrailing = 0.5;    // chords: beyond it is no airfoil
  if (typed.trailing_edge &&
      !(*typed.trailing_edge >= 0.0 && *typed.trailing_edge < kMostTrailing)) {
    return fail(bad_option("a thickness in chords is expected, 0 closes the edge",
                           "--trailing-edge", "for example 0.002"));
  }
  options.airfoil.trailing_thickness = typed.trailing_edge;
  options.airfoil.unit_chord = typed.unit_chord;
  OBVID_TRY(set_chords(typed.thickness, "--thickness", "for example 12% or 0.12",
                       options.airfoil.thickness));
  OBVID_TRY(set_chords(typed.camber, "--camber", "for example 2% or 0.02", options.airfoil.camber));
  if (typed.face_width) options.face_width = *typed.face_width;
  if (typed.feed) options.feed = *typed.feed;
  if (typed.decimals) {
    options.decimals = static_cast<int>(std::clamp(*typed.decimals, -1L, kMoreThanDecimals));
    OBVID_TRY(exchange::check_gcode_decimals(options.decimals));
  }
  return choose(typed.step, kSteps, "--step", options.step)
      .and_then([&] { return choose(typed.dxf, kDxf, "--dxf", options.dxf); })
      .and_then([&] {
        return choose(typed.controller, exchange::kGcodeControllers, "--controller",
                      options.controller);
      })
      .and_then(
          [&] { return choose(typed.airfoil, kAirfoils, "--airfoil", options.airfoil.layout); })
      .and_then(
          [&] { return choose(typed.spacing, kSpacings, "--spacing", options.airfoil.spacing); })
      .and_then([&] {
        return choose(typed.trailing_form, kTrailingForms, "--trailing-edge-form",
                      options.airfoil.trailing_form);
      })
      .and_then([&] { return choose(typed.svg, kSvg, "--svg", options.drawing); })
      .and_then([&] { return set_plots(typed, options.plots); })
      .and_then([&] { return choose(typed.motion, kMotions, "--motion", options.motion); });
}

std::vector<std::string> idle_options(const FormatValues& typed,
                                      const std::vector<std::string>& files) {
  const auto written = [&](std::initializer_list<FileFormat> formats) {
    return std::any_of(files.begin(), files.end(), [&](const std::string& file) {
      const auto format = format_of(file);
      return format && std::find(formats.begin(), formats.end(), *format) != formats.end();
    });
  };
  using enum FileFormat;
  const bool gcode = written({kGcode}), samples = written({kSamples, kSldcrv, kMacro, kObj, kPly});
  const bool foil = written({kAirfoil});
  const bool svg = written({kPicture});
  std::vector<std::string> out;
  const auto look = [&](bool given, bool used, const char* option, const char* of) {
    if (given && !used) out.push_back(fmt::format("{} is not used: no {} is written", option, of));
  };
  look(typed.feed.has_value(), gcode, "--feed", "G-code");
  look(typed.controller.has_value(), gcode, "--controller", "G-code");
  look(typed.motion.has_value(), gcode, "--motion", "G-code");
  look(typed.decimals.has_value(), gcode, "--decimals", "G-code");
  look(typed.step.has_value(), written({kStep}), "--step", "STEP file");
  look(typed.dxf.has_value(), written({kDxf}), "--dxf", "DXF file");
  look(typed.svg.has_value(), svg, "--svg", ".svg");
  const bool picture = written({kPicture, kPage});
  look(typed.plot.has_value(), picture, "--plot", ".svg or .html");
  look(typed.curvature_range.has_value(), picture, "--curvature-range", ".svg or .html");
  look(typed.samples.has_value(), samples || foil, "--samples", "file of samples");
  look(typed.sample_step.has_value(), samples, "--sample-step", "file of samples");
  look(typed.airfoil.has_value(), foil, "--airfoil", ".dat");
  look(typed.spacing.has_value(), foil, "--spacing", ".dat");
  look(typed.trailing_edge.has_value(), foil, "--trailing-edge", ".dat");
  look(typed.trailing_form.has_value(), foil, "--trailing-edge-form", ".dat");
  look(typed.unit_chord, foil, "--unit-chord", ".dat");
  look(typed.thickness.has_value(), foil, "--thickness", ".dat");
  look(typed.camber.has_value(), foil, "--camber", ".dat");
  look(typed.face_width.has_value(), written({kStep, kIges, kBrep}), "--face",
       "STEP, IGES or BREP file");
  return out;
}

}  // namespace obvid
