// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "distance_bound.h"
#include "fair_across.h"
#include "loop_start.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/curve/internal/basis.h"
#include "obvid/surface/internal/collocation.h"
#include "obvid/surface/internal/enclosed.h"
#include "obvid/surface_builders/internal/grid.h"
#include "obvid/surface_builders/internal/lighten.h"
#include "ripple_meter.h"
#include "skin_breaks.h"
#include "skin_marks.h"
#include "skin_report.h"

namespace obvid {
namespace {

Result<void> check_sections(const std::vector<SkinSection>& sections, const SkinOptions& options) {
  if (!(options.tolerance > 0.0)) {
    return error(ErrorCode::kBadOption, "the tolerance must be greater than 0")
        .value(options.tolerance);
  }
  for (const auto& within : {options.light, options.fair_across}) {
    if (!within || (*within > 0.0 && std::isfinite(*within))) continue;
    return error(ErrorCode::kBadOption, "a tolerance must be greater than 0").value(*within);
  }
  if (options.fair_across && options.straight_across) {
    return error(ErrorCode::kBadOption, "ruled strips have no bending across that could be fair")
        .hint("leave one of the two out");
  }
  if (options.fair_across && options.light && !(*options.light < *options.fair_across)) {
    return error(ErrorCode::kBadOption,
                 "light and fair across: the first tolerance is a part of the second")
        .value(*options.light);
  }
  if (sections.size() < 2) {
    return error(ErrorCode::kTooFewCurves, "a skin needs at least two sections")
        .value(static_cast<double>(sections.size()));
  }
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const SkinSection& s = sections[k];
    const bool point = s.contour.pieces.empty();
    const bool fits = point ? !s.points.empty() : s.on_contour.size() == s.points.size();
    const bool inside = std::all_of(s.on_contour.begin(), s.on_contour.end(), [&](std::size_t i) {
      return point || i < s.contour.points.size();
    });
    if (fits && inside) continue;
    return error(ErrorCode::kUsage,
                 fmt::format("section {} ({}): points and contour do not belong together", k + 1,
                             s.name))
        .point(k);
  }
  return {};
}

Error of_section(Error error, const std::vector<SkinSection>& sections, std::size_t k) {
  error.what = fmt::format("section {} ({}): {}", k + 1, sections[k].name, error.what);
  error.index = static_cast<std::ptrdiff_t>(k);
  return error;
}

/// Control points of all sections of a stretch, section after section.
struct Net {
  std::vector<double> breaks;
  std::vector<SectionCurve> curves;
  PointGrid at_breaks;  ///< points of the sections at the breaks
  std::vector<Vec3> points;
  std::size_t width = 0;
};

/// Control points over breaks.
void form(Net& net, std::vector<double> breaks) {
  net.breaks = std::move(breaks);
  for (const SectionCurve& curve : net.curves) {
    std::vector<Hermite> data;
    for (const double u : net.breaks) data.push_back(curve.at(u));
    for (const Hermite& h : data) net.at_breaks.points.push_back(h.point);
    const std::vector<Vec3> row = quintic_points(net.breaks, data);
    net.width = row.size();
    net.points.insert(net.points.end(), row.begin(), row.end());
  }
}

/// Sections that begin at their first points, as they lie along their contours. The error is that
/// of the first section that has one.
Result<std::vector<MeasuredSection>> measured_all(std::vector<SkinSection>& sections,
                                                  const RunContext& run) {
  std::vector<std::optional<Result<MeasuredSection>>> each(sections.size());
  OBVID_TRY(in_parallel(sections.size(), run, [&](std::size_t k) {
    auto begun = begun_at_first_point(sections[k].contour);
    if (!begun) {
      each[k] = fail(begun.error());
      return;
    }
    sections[k].contour = std::move(*begun);
    each[k] = measured(sections[k]);
  }));
  std::vector<MeasuredSection> out;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    if (!*each[k]) return fail(of_section(each[k]->error(), sections, k));
    out.push_back(std::move(**each[k]));
  }
  return out;
}

/// Every `stride`-th section, as if there were no others.
Result<Net> net_of(const std::vector<MeasuredSection>& sections, const MatchedStretch& stretch,
                   double tolerance, std::size_t stride, const RunContext& run) {
  Net net;
  for (std::size_t k = 0; k < sections.size(); k += stride) {
    OBVID_TRY(may_go_on(run));
    auto curve = SectionCurve::make(sections[k], stretch.marks[k], stretch.at);
    OBVID_TRY(curve);
    net.curves.push_back(std::move(*curve));
  }
  auto breaks = breaks_for(net.curves, stretch.at, {tolerance}, run);
  OBVID_TRY(breaks);
  form(net, std::move(*breaks));
  return net;
}

/// Those of all stretches; the error is that of the first that has one.
Result<std::vector<Net>> nets_of(const std::vector<MeasuredSection>& sections, const Matched& match,
                                 double tolerance, std::size_t stride, const RunContext& run) {
  std::vector<std::optional<Result<Net>>> each(match.stretches.size());
  OBVID_TRY(in_parallel(each.size(), run, [&](std::size_t n, const RunContext& part) {
    each[n] = net_of(sections, match.stretches[n], tolerance, stride, part);
  }));
  std::vector<Net> out;
  for (std::optional<Result<Net>>& net : each) {
    if (!*net) return fail(net->error());
    out.push_back(std::move(**net));
  }
  return out;
}

/// Parameters of the sections: chords at all breaks of all stretches, averaged.
Result<std::vector<double>> parameters_across(const std::vector<Net>& nets, std::size_t sections) {
  PointGrid all;
  all.count_v = sections;
  for (std::size_t k = 0; k < sections; ++k) {
    for (const Net& net : nets) {
      const std::size_t width = net.breaks.size();
      const auto row = net.at_breaks.points.begin() + static_cast<std::ptrdiff_t>(k * width);
      all.points.insert(all.points.end(), row, row + static_cast<std::ptrdiff_t>(width));
    }
  }
  all.count_u = all.points.size() / sections;
  auto v = grid_parameters(all, false, Spread::kChord);
  if (v) return v;
  Error error = v.error();
  error.what =
      fmt::format("sections {} and {} lie at the same place", error.index, error.index + 1);
  return fail(error);
}

Collocation straight(const std::vector<double>& v) {
  Collocation system{1, v, BandedMatrix(v.size(), 0, 0)};
  system.knots.insert(system.knots.begin(), v.front());
  system.knots.push_back(v.back());
  for (std::size_t i = 0; i < v.size(); ++i) system.matrix.at(i, i) = 1.0;
  return system;
}

NurbsSurface surface_of(const Net& net, const Collocation& across) {
  std::vector<Vec3> points = net.points;
  across.matrix.solve_rows(points, net.width);
  return {kSkinDegree,  across.degree,     quintic_knots(net.breaks),
          across.knots, std::move(points), {}};
}

/// What a matching forces within a tolerance: on lines in equal steps of the common parameter, of a
/// skin that takes over the contours there.
Result<MatchingTrial> tried(const std::vector<MeasuredSection>& sections, const Matched& match,
                            double tolerance, const RunContext& run) {
  constexpr std::size_t kLines = 97;  // of each stretch
  std::vector<double> lines;
  for (std::size_t i = 0; i < kLines; ++i) {
    lines.push_back(static_cast<double>(i) / static_cast<double>(kLines - 1));
  }
  std::vector<Net> nets;
  for (const MatchedStretch& stretch : match.stretches) {
    Net net;
    for (std::size_t k = 0; k < sections.size(); ++k) {
      OBVID_TRY(may_go_on(run));
      auto curve = SectionCurve::make(sections[k], stretch.marks[k], stretch.at);
      OBVID_TRY(curve);
      net.curves.push_back(std::move(*curve));
    }
    form(net, lines);
    nets.push_back(std::move(net));
  }
  const auto v = parameters_across(nets, sections.size());
  OBVID_TRY(v);
  const auto across = cubic_collocation(*v);
  OBVID_TRY(across);
  MatchingTrial out{match.matching, 0, 0};
  for (const Net& net : nets) {
    const auto forced = forced_across(surface_of(net, *across), lines, *v, tolerance, run);
    OBVID_TRY(forced);
    out.isolines += lines.size();
    out.forced += std::accumulate(forced->forced.begin(), forced->forced.end(), std::size_t{0});
  }
  return out;
}

/// A matching with what it forces.
struct TriedMatching {
  Matched match;
  MatchingTrial trial;
  std::vector<Net> nets;  ///< of all sections, where these were followed
};

/// What each matching forces, the one at hand first. Those that these sections do not have are left
/// out: points where their numbers differ, the others where numbers of corners do.
Result<std::vector<TriedMatching>> all_tried(const std::vector<MeasuredSection>& sections,
                                             Matched given, double tolerance,
                                             const RunContext& run) {
  const auto first = tried(sections, given, tolerance, run);
  OBVID_TRY(first);
  std::vector<TriedMatching> out;
  out.push_back({std::move(given), *first, {}});
  for (const SkinMatching matching :
       {SkinMatching::kByLength, SkinMatching::kByAngle, SkinMatching::kOptimised}) {
    if (matching == out.front().match.matching) continue;
    OBVID_TRY(tell(run, "matching sections", static_cast<double>(out.size()) / 4.0));
    auto match = matched(sections, matching, run);
    if (!match && match.error().code != ErrorCode::kCancelled) continue;
    OBVID_TRY(match);
    const auto trial = tried(sections, *match, tolerance, run);
    if (!trial && trial.error().code != ErrorCode::kCancelled) continue;
    OBVID_TRY(trial);
    out.push_back({std::move(*match), *trial, {}});
  }
  return out;
}

/// An exact skin: the largest change of curvature against its run, share of a section's largest,
/// and spans along.
struct ExactRuns {
  double ripple = 0.0;
  std::size_t spans = 0;
};

Result<ExactRuns> runs_of(const std::vector<Net>& nets, const RunContext& run) {
  ExactRuns out;
  for (const Net& net : nets) {
    std::vector<RippleMeter> meters(net.curves.size());
    OBVID_TRY(in_parallel(net.curves.size(), run, [&](std::size_t k) {
      if (!net.curves[k].is_point()) add_ripple(net.curves[k], net.breaks, meters[k]);
    }));
    for (const RippleMeter& meter : meters) out.ripple = std::max(out.ripple, meter.ripple());
    out.spans += net.breaks.size() - 1;
  }
  return out;
}

/// The matching that forces the fewest changes a line, of those whose sections keep their runs of
/// curvature, or lose no more than those of the one at hand, which is the first, with no more than
/// twice its spans. Puts it first.
Result<void> choose(const std::vector<MeasuredSection>& sections, double tolerance,
                    std::vector<TriedMatching>& all, const RunContext& run) {
  constexpr double kRunKept = 1e-3;        // of a section's largest curvature
  constexpr double kMostHeavier = 2.0;     // spans, of those of the first
  constexpr std::size_t kFewSections = 6;  // enough to see that a matching loses runs
  const auto of_line = [](const MatchingTrial& trial) {
    return static_cast<double>(trial.forced) / static_cast<double>(trial.isolines);
  };
  std::vector<std::size_t> order;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (of_line(all[i].trial) < of_line(all.front().trial)) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return of_line(all[a].trial) < of_line(all[b].trial);
  });
  if (order.empty()) return {};
  auto given_nets = nets_of(sections, all.front().match, tolerance, 1, run);
  OBVID_TRY(given_nets);
  all.front().nets = std::move(*given_nets);
  const auto given = runs_of(all.front().nets, run);
  OBVID_TRY(given);
  all.front().trial.ripple = given->ripple;
  all.front().trial.heavier = 1.0;
  const double allowed = std::max(kRunKept, given->ripple);
  for (const std::size_t i : order) {
    TriedMatching& one = all[i];
    std::size_t stride = (sections.size() + kFewSections - 1) / kFewSections;
    for (bool last = false; !last; stride = 1) {
      last = stride == 1;
      auto nets = nets_of(sections, one.match, tolerance, stride, run);
      if (!nets && nets.error().code != ErrorCode::kCancelled) break;  // not followed
      OBVID_TRY(nets);
      const auto runs = runs_of(*nets, run);
      OBVID_TRY(runs);
      one.trial.ripple = runs->ripple;
      one.trial.heavier = static_cast<double>(runs->spans) / static_cast<double>(given->spans);
      if (runs->ripple > allowed || *one.trial.heavier > kMostHeavier) break;
      if (last) {
        one.nets = std::move(*nets);
        std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                    all.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        return {};
      }
    }
  }
  return {};
}

/// Puts surfaces with few control points in the place of the exact ones.
Result<LightSkinReport> lighten(std::vector<SkinStretch>& stretches, double tolerance,
                                LightWhere where, const RunContext& run) {
  LightSkinReport report{tolerance, 0.0, 0.0, 0, 0};
  std::vector<NurbsSurface> exact;
  for (const SkinStretch& stretch : stretches) {
    report.points_before += stretch.surface.points.size();
    exact.push_back(stretch.surface);
  }
  auto light = lightened(exact, tolerance, run, where);
  OBVID_TRY(light);
  report.moved = report.knots_alone = light->moved;
  for (std::size_t n = 0; n < stretches.size(); ++n) {
    stretches[n].surface = std::move(light->surfaces[n]);
    report.points += stretches[n].surface.points.size();
  }
  return report;
}

/// Whether a border of a stretch is one of another (or its own other one): point on point in all
/// sections; and whether any section goes on smoothly there.
struct Seam {
  bool shared = false, smooth = false;
};

Seam seam_at(const std::vector<SkinStretch>& stretches, std::size_t n, bool end) {
  constexpr double kSame = 1e-9;    // of the size
  constexpr double kCorner = 1e-6;  // turn of the tangent that is none
  const SkinStretch& here = stretches[n];
  const double size = size_of(here.surface);
  for (const SkinStretch& other : stretches) {
    bool same = true, smooth = false;
    for (std::size_t k = 0; k < here.sections.size() && same; ++k) {
      const Hermite a = here.sections[k].at(end ? 1.0 : 0.0),
                    b = other.sections[k].at(end ? 0.0 : 1.0);
      same = norm(a.point - b.point) <= kSame * size;
      const bool point = here.sections[k].is_point();
      smooth = smooth || (!point && norm(unit(a.d1) - unit(b.d1)) <= kCorner);
    }
    if (same) return {true, smooth};
  }
  return {};
}

/// Puts surfaces that are fair across in the place of the exact ones, with few control points where
/// `light` is told; returns what the exact ones force.
Result<std::vector<ForcedAcross>> fair_across(std::vector<SkinStretch>& stretches, double fine,
                                              const std::vector<double>& v,
                                              const Collocation& across, const RunContext& run,
                                              FairAcrossReport& report,
                                              std::optional<LightSkinReport>& light) {
  std::vector<ForcedAcross> forced;
  double reach = 0.0;
  for (std::size_t n = 0; n < stretches.size(); ++n) {
    const auto part = [&](std::size_t k) {
      return static_cast<double>(k) / static_cast<double>(stretches.size());
    };
    SkinStretch& stretch = stretches[n];
    auto least = forced_across(stretch.surface, stretch.breaks, v, report.tolerance, run);
    OBVID_TRY(least);
    OBVID_TRY(
        add_across_report(stretch.surface, stretch.breaks, v, *least, fine, run, report.before));
    FairAcross how{fine, report.tolerance, v, across, *least, {}, {}};
    for (const std::size_t side : {0u, 1u}) {
      const Seam seam = seam_at(stretches, n, side == 1);
      how.fixed[side] = seam.shared;
      how.smooth[side] = seam.smooth;
    }
    FairedStretch fair;
    if (light) {
      auto both = light_and_fair(stretch, how, light->tolerance, run, part(n), part(n + 1));
      OBVID_TRY(both);
      fair = std::move(both->fair);
      light->moved = std::max(light->moved, distance_bound(stretch.surface, fair.surface));
      light->knots_alone = std::max(light->knots_alone, both->light_moved);
      light->points_before += stretch.surface.points.size();
      light->points += fair.surface.points.size();
    } else {
      auto alone = faired_across(stretch, how, run, part(n), part(n + 1));
      OBVID_TRY(alone);
      fair = std::move(*alone);
    }
    for (const double by : fair.moved) report.moved = std::max(report.moved, by);
    report.enough = report.enough || fair.enough;
    reach = std::max(reach, fair.reach);
    stretch.surface = std::move(fair.surface);
    forced.push_back(std::move(*least));
  }
  if (reach < report.tolerance) report.reach = reach;
  return forced;
}

}  // namespace

Result<Skin> skin(const std::vector<SkinSection>& given, const SkinOptions& options,
                  const RunContext& run) {
  OBVID_TRY(check_sections(given, options));
  std::vector<SkinSection> sections = given;
  OBVID_TRY(tell(run, "measuring sections", 0.0));
  auto all_measured = measured_all(sections, run);
  OBVID_TRY(all_measured);
  const std::vector<MeasuredSection> measured_sections = std::move(*all_measured);
  auto match = matched(measured_sections, options.matching, run);
  OBVID_TRY(match);
  std::vector<MatchingTrial> trials;
  std::vector<Net> nets;
  if (options.fair_across && options.matching == SkinMatching::kAutomatic) {
    auto all = all_tried(measured_sections, std::move(*match), *options.fair_across, run);
    OBVID_TRY(all);
    OBVID_TRY(choose(measured_sections, options.tolerance, *all, run));
    for (const TriedMatching& one : *all) trials.push_back(one.trial);
    match = std::move(all->front().match);
    nets = std::move(all->front().nets);
  }
  OBVID_TRY(tell(run, "following contours", 0.0));
  if (nets.empty()) {
    auto formed = nets_of(measured_sections, *match, options.tolerance, 1, run);
    OBVID_TRY(formed);
    nets = std::move(*formed);
  }
  const auto v = parameters_across(nets, sections.size());
  OBVID_TRY(v);
  Result<Collocation> across = options.straight_across ? straight(*v) : cubic_collocation(*v);
  OBVID_TRY(across);

  Skin result;
  result.matching = match->matching;
  result.warnings = std::move(match->warnings);
  for (std::size_t k = 0; k < sections.size(); ++k) {
    result.sections.push_back(
        {sections[k].name, (*v)[k], 0.0, 0.0, sections[k].contour.runs.size(), 0.0});
  }
  std::vector<SkinStretch> stretches;
  for (Net& net : nets) {
    NurbsSurface surface = surface_of(net, *across);
    stretches.push_back({std::move(net.curves), std::move(net.breaks), std::move(surface)});
  }
  std::vector<ForcedAcross> forced;
  const double bulge = options.fair_across.value_or(options.tolerance);
  const double fine = std::min(options.tolerance, bulge);
  if (options.fair_across) {
    result.fair.emplace().tolerance = *options.fair_across;
    result.fair->tried = std::move(trials);
    if (options.light) result.light.emplace().tolerance = *options.light;
    for (const SkinStretch& stretch : stretches) result.exact.push_back(stretch.surface);
    auto least = fair_across(stretches, fine, *v, *across, run, *result.fair, result.light);
    OBVID_TRY(least);
    forced = std::move(*least);
  } else if (options.light) {
    auto light = lighten(stretches, *options.light, LightWhere::kBoth, run);
    OBVID_TRY(light);
    result.light = *light;
  }
  for (std::size_t n = 0; n < stretches.size(); ++n) {
    const double part = static_cast<double>(n) / static_cast<double>(stretches.size());
    OBVID_TRY(tell(run, "checking", part));
    SkinStretch& stretch = stretches[n];
    const bool light = result.light && !options.fair_across;
    const int samples = light ? kReportSamplesOfLight : kReportSamplesPerSpan;
    OBVID_TRY(in_parallel(sections.size(), run, [&](std::size_t k) {
      add_section_report(stretch, measured_sections[k], k, (*v)[k], samples, result.sections[k]);
    }));
    const std::vector<double> lines = light ? distinct(stretch.surface.knots_u) : stretch.breaks;
    if (!options.straight_across) {
      if (!options.fair_across) {
        auto least = forced_across(stretch.surface, lines, *v, bulge, run);
        OBVID_TRY(least);
        forced.push_back(std::move(*least));
      }
      OBVID_TRY(add_across_report(stretch.surface, lines, *v, forced[n], fine, run, result.across));
    }
    result.patches.push_back({fmt::format("part {}", n + 1), std::move(stretch.surface)});
  }
  turn_outward(result.patches);
  return result;
}

}  // namespace obvid
