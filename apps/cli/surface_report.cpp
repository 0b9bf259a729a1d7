// SPDX-License-Identifier: Apache-2.0
#include "surface_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "outputs.h"
#include "table.h"
#include "text.h"

namespace obvid {
namespace {

std::string patch_text(const NurbsSurface& s) {
  return fmt::format("degree {} x {}, {} x {} control points{}", s.degree_u, s.degree_v,
                     s.count_u(), s.count_v(), s.weights.empty() ? "" : ", rational");
}

void add_patches(const SurfaceModel& model, Facts& facts) {
  constexpr std::size_t kMostNamed = 6;
  facts.add("patches", std::to_string(model.patches.size()));
  for (std::size_t i = 0; i < std::min(kMostNamed, model.patches.size()); ++i) {
    facts.add("  " + model.patches[i].name, patch_text(model.patches[i].surface));
  }
  if (model.patches.size() > kMostNamed) {
    facts.add("  ...", fmt::format("{} more", model.patches.size() - kMostNamed));
  }
}

std::string deviation_text(const MadeSurface& made) {
  if (made.deviation == 0.0) return "exact";
  return fmt::format("at most {} {} off where measured", significant_above(made.deviation, 3),
                     made.model.units.text());
}

Table section_table(const std::vector<SkinSectionReport>& sections) {
  Table table;
  table.column("section", Table::Align::kLeft);
  table.column("v");
  table.column("from its\ncontour");
  table.column("from its\npoints");
  table.column("runs");
  table.column("monotonicity\nviolation");
  std::vector<double> worst;
  for (const SkinSectionReport& s : sections) worst.push_back(s.ripple);
  add_rows_worth_showing(worst, table, [&](std::size_t i) {
    const SkinSectionReport& s = sections[i];
    table.row({s.name, fmt::format("{:.4f}", s.parameter), significant(s.deviation, 3),
               significant(s.from_points, 3), std::to_string(s.runs),
               s.ripple > 0.0 ? significant(100.0 * s.ripple, 2) + " %" : "none"});
  });
  return table;
}

std::string across_text(const AcrossReport& across) {
  return fmt::format(
      "{} changes of bending on {} isolines; {} forced, {} of them proved for these lines and "
      "normals; {} beyond, at most {} on one isoline",
      across.found, across.isolines, across.forced, across.proved, across.beyond, across.worst);
}

std::string fair_text(const FairAcrossReport& fair, const AcrossReport& now,
                      const std::string& units) {
  return fmt::format(
      "{} changes of bending instead of {}, {} instead of {} beyond those forced; with bulges of "
      "{} "
      "{}, {} instead of {}; no section farther than {} {} from where the exact skin has it, {} "
      "allowed",
      now.found, fair.before.found, now.beyond, fair.before.beyond, significant(now.fine, 3), units,
      now.all, fair.before.all, significant_above(fair.moved, 3), units,
      significant(fair.tolerance, 3));
}

/// Of a skin that is fair besides, both were solved for in one: what is allowed is allowed to few
/// knots alone.
std::string light_text(const LightSkinReport& light, bool fair, const std::string& units) {
  std::string text = fmt::format(
      "{} control points instead of {}; nowhere farther than {} {} from the exact "
      "skin",
      light.points, light.points_before, significant_above(light.moved, 3), units);
  if (fair) {
    text += fmt::format(", fairing included; few knots alone moved it by at most {}",
                        significant_above(light.knots_alone, 3));
  }
  return text + fmt::format(", {} allowed", significant(light.tolerance, 3));
}

std::string matching_text(const Skin& skin) {
  const auto named = [](SkinMatching matching) -> std::string {
    switch (matching) {
      case SkinMatching::kByPoints:
        return "points";
      case SkinMatching::kByAngle:
        return "arc length and angle";
      case SkinMatching::kOptimised:
        return "lines across that bend little";
      default:
        return "arc length";
    }
  };
  std::string text = named(skin.matching);
  if (!skin.fair || skin.fair->tried.size() < 2) return text;
  text += "; changes forced on lines of each: ";
  for (const MatchingTrial& trial : skin.fair->tried) {
    if (&trial != &skin.fair->tried.front()) text += "; ";
    text += fmt::format("{} {} on {} lines", named(trial.matching), trial.forced, trial.isolines);
    if (&trial == &skin.fair->tried.front()) {
      text += ", used";
    } else if (trial.ripple) {
      text += fmt::format(", which loses {} % of curvature against runs with {} times the spans",
                          significant(100.0 * *trial.ripple, 2), significant(*trial.heavier, 2));
    }
  }
  return text;
}

void add_skin_report(const FittedSkin& fitted, const std::string& units, Facts& facts) {
  const Skin& skin = fitted.skin;
  const std::size_t contours = skin.sections.size() - fitted.points;
  std::string text = fmt::format("{} of {} contours proved", fitted.proved, contours);
  if (fitted.smooth > 0) text += fmt::format(", {} of them G3", fitted.smooth);
  if (fitted.plain > 0) text += fmt::format(", {} plain cubics", fitted.plain);
  if (fitted.points > 0) text += fmt::format(", {} points", fitted.points);
  facts.add("sections", text);
  facts.add("matched by", matching_text(skin));
  facts.add("tolerance", significant(fitted.tolerance, 3) + " " + units);
  if (skin.light) {
    facts.add("light", light_text(*skin.light, skin.fair.has_value(), units));
  }
  if (skin.fair) {
    std::string fair = fair_text(*skin.fair, skin.across, units);
    if (const auto remark = fair_remark(skin, units)) fair += "; " + *remark;
    facts.add("fair across", fair);
  }
  if (const auto lost = runs_lost(skin)) {
    facts.add("runs lost", *lost);
  } else if (skin.light || skin.fair) {
    facts.add("runs lost", "none");
  }
  if (skin.across.isolines > 0) facts.add("across", across_text(skin.across));
}

void add_written(const Written& written, Facts& facts) {
  for (const std::string& remark : written.remarks) facts.add("note", remark);
  if (!written.files.empty()) facts.add("written", listed(written.files));
}

}  // namespace

std::string surface_report_text(const MadeSurface& made, const Written& written) {
  const std::string units = made.model.units.text();
  Facts facts;
  facts.add("surface", made.kind);
  for (const auto& [name, value] : made.facts) facts.add(name, value);
  facts.add("size", significant(size_of(made.model)) + " " + units);
  add_patches(made.model, facts);
  if (made.skin) {
    add_skin_report(*made.skin, units, facts);
  } else {
    facts.add("as NURBS", deviation_text(made));
  }
  add_written(written, facts);
  std::string text;
  if (made.skin) text = section_table(made.skin->skin.sections).text() + "\n";
  return text + facts.text();
}

}  // namespace obvid
