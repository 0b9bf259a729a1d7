// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/skin_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/geom/internal/box.h"
#include "surface/align_sections.h"
#include "surface/surface_kinds.h"

namespace obvid {
namespace {

/// A section in its plane: points that differ, and which of them each point is.
struct Flat {
  SkinSection section;
  PointSeries series;
  double extent = 0.0;  ///< largest coordinate in space, units
};

/// Of the largest coordinate: some thousand steps of a double, and up to a million of them where
/// points are dense; far below what is ever measured.
constexpr double kDenseRounding = 1e-12;
constexpr double kMostRounding = 2e-9;

Flat flat(const SpaceSeries& given, const Units& units) {
  Flat out;
  out.section.name = given.name;
  out.section.points = given.points;
  out.section.frame = plane_of(given.points);
  out.series.name = given.name;
  out.series.units = units;
  out.series.rounding = rounding_in(out.section.frame, given.rounding).within;
  for (const Vec3& p : given.points) {
    out.extent = std::max({out.extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const Vec2 in_plane = out.section.frame.in_plane(p);
    if (out.series.points.empty() || !(out.series.points.back() == in_plane)) {
      out.series.points.push_back(in_plane);
    }
    out.section.on_contour.push_back(out.series.points.size() - 1);
  }
  if (!given.corners.empty()) out.series.fixed.resize(out.series.points.size());
  for (const std::size_t corner : given.corners) {
    if (corner < given.points.size())
      out.series.fixed[out.section.on_contour[corner]].corner = true;
  }
  return out;
}

/// Ends that nearly meet are one point: a slit below the tolerance is no part of the body.
void close_slits(std::vector<SpaceSeries>& sections, double tolerance,
                 std::vector<std::string>& warnings) {
  constexpr std::size_t kLeast = 4;  // points of something that closes
  for (SpaceSeries& section : sections) {
    if (section.points.size() < kLeast) continue;
    const double gap = norm(section.points.back() - section.points.front());
    if (!(gap > 0.0) || gap > tolerance) continue;
    section.points.back() = section.points.front();
    warnings.push_back(fmt::format("{}: its ends are {:.2g} apart, less than the tolerance: closed",
                                   section.name, gap));
  }
}

/// A closed contour drops the repeated first point; a section keeps it, as its end.
void close(SkinSection& section) {
  if (!section.contour.closed) return;
  const std::size_t count = section.contour.points.size();
  bool ends_at_start = false;
  for (std::size_t& i : section.on_contour) {
    ends_at_start = i == count;
    i %= count;
  }
  if (ends_at_start) return;
  section.points.push_back(section.points.front());
  section.on_contour.push_back(0);
}

bool has_continuous_slopes(const Fit& fit) {
  return fit.contour.continuity == Continuity::kG3 && fit.certificate.proved &&
         fit.certificate.slope_steps == 0;
}

/// The contour of one section (`moved` grows to what its points were allowed to move), plain where
/// that is allowed and nothing better exists. Tells nothing.
Result<Fit> fit_section(const Flat& flat, const SkinJob& job, std::size_t number, double& moved,
                        std::vector<std::string>& warnings, const RunContext& run) {
  Result<Fit> made = fit(flat.series, job.sections, run);
  // circles in full precision, and sections turned into their plane: below the last digits of the
  // coordinates nothing is known, so points may move there
  for (double share = kDenseRounding; !made && share < kMostRounding && !job.sections.noise &&
                                      made.error().code == ErrorCode::kRoundingDecides;
       share *= 10.0) {
    FitJob within_rounding = job.sections;
    within_rounding.noise = share * flat.extent;
    made = fit(flat.series, within_rounding, run);
    moved = std::max(moved, share * flat.extent);
  }
  const std::string name = fmt::format("section {} ({})", number, flat.section.name);
  if (!made && job.plain_when_refused && category(made.error().code) == ErrorCategory::kNoContour) {
    FitJob plain = job.sections;
    plain.carrier = Carrier::kBaseline;
    plain.continuity.reset();
    plain.noise.reset();
    plain.noise_from_rounding = false;
    plain.noise_from_scatter = false;
    warnings.push_back(
        fmt::format("{}: no fair contour ({}), the C2 cubic through its points stands for it", name,
                    made.error().what));
    made = fit(flat.series, plain, run);
  }
  if (!made && made.error().code == ErrorCode::kCancelled) return made;
  if (!made) {
    Error error = made.error();
    error.what = fmt::format("{}: {}", name, error.what);
    if (category(error.code) == ErrorCategory::kNoContour) {
      error.hint = pipeline_detail::without_fair_contour(job.sections);
    }
    return fail(error);
  }
  if (!made->certificate.proved && promises_monotone(made->contour.carrier)) {
    warnings.push_back(fmt::format("{}: {}", name, "its contour is formed, but not proved"));
  }
  return made;
}

}  // namespace

std::optional<std::string> runs_lost(const Skin& skin) {
  constexpr double kLost = 1e-3;  // of the largest curvature: it is in no picture
  std::size_t lost = 0;
  double worst = 0.0;
  for (const SkinSectionReport& s : skin.sections) {
    lost += s.ripple > kLost ? 1 : 0;
    worst = std::max(worst, s.ripple);
  }
  if (lost == 0) return std::nullopt;
  return fmt::format(
      "in {} of {} sections curvature goes against its run by more than 0.1 % of the largest "
      "there; at most {} %",
      lost, skin.sections.size(), significant_above(100.0 * worst, 2));
}

std::optional<std::string> fair_remark(const Skin& skin, const std::string& units) {
  if (!skin.fair) return std::nullopt;
  const FairAcrossReport& fair = *skin.fair;
  const double light = skin.light ? skin.light->knots_alone : 0.0;
  std::string text;
  if (!(fair.moved > light)) {
    text = "nothing moved across: ";
    if (fair.enough) {
      text += fmt::format(
          "no correction that was found within {} {} or less, and keeps the runs of curvature "
          "along "
          "the sections, has fewer changes of bending",
          significant(fair.reach.value_or(fair.tolerance), 3), units);
    } else {
      text += fmt::format(
          "the changes of bending beyond those forced are too few to move sections for, {}, and {} "
          "with bulges of {} {} on {} isolines",
          fair.before.beyond, fair.before.all_beyond, significant(fair.before.fine, 3), units,
          fair.before.isolines);
    }
  }
  if (fair.reach) {
    if (!text.empty()) text += "; ";
    text += fmt::format("sections may move by 1 % of their length, {} {} at most, not by {}",
                        significant_above(*fair.reach, 3), units, significant(fair.tolerance, 3));
  }
  if (text.empty()) return std::nullopt;
  return text;
}

Result<FittedSkin> fit_skin(const std::vector<SpaceSeries>& given, const SkinJob& job,
                            const RunContext& run) {
  FittedSkin result;
  if (given.size() < 2) {
    return error(ErrorCode::kTooFewCurves, "a skin needs at least two sections")
        .hint(
            "blank lines or a column `section` part those of one file; others are a file each; "
            "NAME_x, NAME_y and NAME_z are one grid: `obvid surface grid`")
        .value(static_cast<double>(given.size()));
  }
  std::vector<SpaceSeries> sections = given;
  result.tolerance = job.tolerance.value_or(pipeline_detail::kSurfaceTolerance *
                                            bounding_diagonal(sections, &SpaceSeries::points));
  if (job.sections.closing == Closing::kAutomatic) {
    close_slits(sections, result.tolerance, result.warnings);
  }
  align_sections(sections, result.warnings);
  struct Formed {
    Flat flat;
    std::optional<Result<Fit>> contour;  ///< none of a section that is a point
    double moved = 0.0;
    std::vector<std::string> warnings;
  };
  std::vector<Formed> formed(sections.size());
  const std::thread::id caller = std::this_thread::get_id();  // it alone tells
  std::atomic<std::size_t> done{0};
  std::atomic<std::size_t> refused{sections.size()};  // the first that is known
  const auto form = [&](std::size_t k, const RunContext& part) {
    if (run.progress && std::this_thread::get_id() == caller) {
      run.progress("forming sections",
                   static_cast<double>(done) / static_cast<double>(sections.size()));
    }
    if (k > refused) return;  // the error of the first refused one is what is told
    Formed& one = formed[k];
    one.flat = flat(sections[k], job.units);
    if (one.flat.series.points.size() > 1) {
      one.contour = fit_section(one.flat, job, k + 1, one.moved, one.warnings, part);
      std::size_t first = refused;
      while (!*one.contour && k < first && !refused.compare_exchange_weak(first, k)) {
      }
    }
    ++done;
  };
  OBVID_TRY(in_parallel(sections.size(), run, form));
  std::vector<SkinSection> made;
  double moved = 0.0;
  for (Formed& one : formed) {
    if (one.contour) {
      Result<Fit>& contour = *one.contour;
      OBVID_TRY(contour);
      moved = std::max(moved, one.moved);
      result.warnings.insert(result.warnings.end(), one.warnings.begin(), one.warnings.end());
      result.proved += contour->certificate.proved ? 1 : 0;
      result.smooth += has_continuous_slopes(*contour) ? 1 : 0;
      result.plain += promises_monotone(contour->contour.carrier) ? 0 : 1;
      one.flat.section.contour = std::move(contour->contour);
      close(one.flat.section);
    } else {
      ++result.points;
    }
    made.push_back(std::move(one.flat.section));
  }
  if (moved > 0.0) {
    result.warnings.push_back(fmt::format(
        "the rounding of coordinates decides about some sections: their points may move by {}",
        significant_above(moved, 2)));
  }
  SkinOptions options;
  options.tolerance = result.tolerance;
  options.matching = job.matching;
  options.straight_across = job.straight_across;
  options.light = job.light;
  options.fair_across = job.fair_across;
  auto surface = skin(made, options, run);
  OBVID_TRY(surface);
  result.skin = std::move(*surface);
  result.warnings.insert(result.warnings.end(), result.skin.warnings.begin(),
                         result.skin.warnings.end());
  // who asks for few control points knows that they cost runs; an exact skin is asked to keep them
  if (const auto lost = runs_lost(result.skin); lost && !result.skin.light) {
    result.warnings.push_back(*lost);
  }
  // who asked for what was fair already has it
  const auto& fair = result.skin.fair;
  if (fair && (fair->enough || fair->reach)) {
    if (const auto remark = fair_remark(result.skin, job.units.text())) {
      result.warnings.push_back(*remark);
    }
  }
  return result;
}

}  // namespace obvid
