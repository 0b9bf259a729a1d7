// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "assemble.h"
#include "form.h"
#include "obvid/certify/certify.h"
#include "prepare.h"
#include "report.h"
#include "section_chain.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

/// Rounds in which the tolerance of points that the finished contour misses is narrowed: between
/// nodes the search knows the contour only to first order.
constexpr int kNarrowings = 6;
constexpr double kNarrowed = 0.95;  ///< of what would just do

Result<Contour> form(const std::vector<Vec2>& points, const SeriesChain& chain, Carrier carrier,
                     double tolerance) {
  if (carrier == Carrier::kClothoids) return form_clothoids(points, chain);
  auto spirals = form_spirals(points, chain);
  if (!spirals || carrier == Carrier::kSpiral) return spirals;
  return form_arcs(*spirals, tolerance);
}

/// One attempt at the whole contour, with how it was found.
struct Formed {
  Contour contour;
  ChainReport chain;
  std::vector<std::string> warnings;
};

void add(const SectionChain& section, Formed& formed) {
  ChainReport& sum = formed.chain;
  const SeriesChain& one = section.chain;
  sum.smallest_margin = sum.newton_steps == 0 ? one.smallest_margin
                                              : std::min(sum.smallest_margin, one.smallest_margin);
  sum.newton_steps += one.newton_steps;
  sum.free_elements += one.free_elements;
  formed.warnings.insert(formed.warnings.end(), section.warnings.begin(), section.warnings.end());
}

Result<Formed> form_sections(const Prepared& series, const FitJob& job, double tolerance,
                             const Progress& progress) {
  Formed out;
  Assembly assembly;
  const std::vector<Section>& sections = series.split.sections;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const auto inner = [&](std::string_view stage, double done) {
      if (progress) {
        const double part = (static_cast<double>(k) + done) / static_cast<double>(sections.size());
        constexpr double kUntilHere = 0.6;  // of the whole work
        progress(stage, kUntilHere * part);
      }
    };
    const auto chain = chain_section(series, sections[k], inner);
    if (!chain) return tl::unexpected(chain.error());
    auto contour = form(series.points, chain->chain, job.carrier, tolerance);
    if (!contour) return tl::unexpected(contour.error());
    assembly.append(std::move(*contour));
    add(*chain, out);
  }
  if (series.closed) assembly.close(series.split.smooth_loop);
  out.contour = assembly.take();
  out.contour.points = series.points;
  out.contour.point_tolerance = series.tolerance;
  return out;
}

bool misses_a_point(const Contour& contour) {
  if (contour.point_tolerance.empty()) return false;
  const std::vector<double> distance = point_distances(contour);
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (distance[i] > contour.point_tolerance[i]) return true;
  }
  return false;
}

/// Narrows the reach of points that the contour passes too far. False when there are none.
bool narrow(const Contour& contour, Prepared& series) {
  if (series.exact()) return false;
  const std::vector<double> distance = point_distances(contour);
  bool any = false;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const double allowed = series.tolerance[i];
    if (!(distance[i] > allowed) || series.reach[i] == 0.0) continue;
    series.reach[i] *= kNarrowed * allowed / distance[i];
    any = true;
  }
  return any;
}

/// A convex contour turns one way all along; the search within tolerances may have missed that.
Result<void> keeps_convex(const Contour& contour, const Certificate& certificate) {
  if (certificate.inflections == 0) return {};
  Error error{ErrorCode::kFixedDataContradict,
              "a convex contour was asked for, but none was found within the tolerances",
              "",
              "drop the wish for a convex contour, or allow larger tolerances",
              -1,
              0.0};
  int turns = 0;
  for (const Joint& joint : contour.joints) {
    turns += joint.element.kappa > 0.0 ? 1 : joint.element.kappa < 0.0 ? -1 : 0;
  }
  for (const Joint& joint : contour.joints) {
    if (!joint.source || turns * joint.element.kappa >= 0.0) continue;
    error.index = static_cast<std::ptrdiff_t>(*joint.source);
    error.where = "point " + std::to_string(*joint.source + 1);
    break;
  }
  return fail(std::move(error));
}

}  // namespace

Result<Fit> fit(const PointSeries& series, const FitJob& job, const Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const auto tell = [&](const char* stage, double done) {
    if (progress) progress(stage, done);
  };
  if (job.tolerance && !(*job.tolerance > 0.0)) {
    return fail({ErrorCode::kBadOption, "the tolerance must be greater than 0", "", "", -1,
                 *job.tolerance});
  }
  tell("analysing", 0.0);
  auto prepared = prepare(series, job);
  if (!prepared) return tl::unexpected(prepared.error());
  const double tolerance = job.tolerance.value_or(default_tolerance(prepared->points));
  auto formed = form_sections(*prepared, job, tolerance, progress);
  for (int k = 0; k < kNarrowings && formed && narrow(formed->contour, *prepared); ++k) {
    formed = form_sections(*prepared, job, tolerance, progress);
  }
  if (formed && prepared->thin && misses_a_point(formed->contour)) {
    prepared->thin = false;  // every point a joint: each is met by construction
    formed = form_sections(*prepared, job, tolerance, progress);
  }
  if (!formed) return tl::unexpected(formed.error());
  Fit out;
  out.contour = std::move(formed->contour);
  out.contour.units = series.units;
  tell("proving", 0.7);
  out.certificate = certify(out.contour);
  if (job.convex) {
    if (auto kept = keeps_convex(out.contour, out.certificate); !kept) return fail(kept.error());
  }
  tell("bounding the error", 0.9);
  auto report = measure(out.contour, tolerance);
  if (!report) return tl::unexpected(report.error());
  out.report = std::move(*report);
  out.report.vertices = out.certificate.vertices;
  out.report.inflections = out.certificate.inflections;
  out.report.largest_move = out.certificate.largest_move;
  if (!prepared->exact()) out.report.moves = point_distances(out.contour);
  out.report.chain = formed->chain;
  out.warnings = series.warnings;
  for (const auto* more : {&prepared->warnings, &formed->warnings}) {
    out.warnings.insert(out.warnings.end(), more->begin(), more->end());
  }
  out.report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  tell("done", 1.0);
  return out;
}

}  // namespace obvid
