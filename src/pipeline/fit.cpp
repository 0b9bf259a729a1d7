// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/fit.h"

#include <chrono>
#include <cmath>
#include <string>

#include "form.h"
#include "obvid/certify/certify.h"
#include "obvid/series/analysis.h"
#include "report.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

struct Cleaned {
  std::vector<Vec2> points;
  ChainWishes wishes;
  std::size_t merged = 0;
};

/// Merges equal neighbours and gathers everything that is fixed.
Result<Cleaned> clean(const PointSeries& series, const FitJob& job) {
  Cleaned out;
  out.points.reserve(series.points.size());
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const Vec2 p = series.points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      return fail({ErrorCode::kNotFinite, "a coordinate is not a finite number",
                   "point " + std::to_string(i + 1), "remove the point",
                   static_cast<std::ptrdiff_t>(i), 0.0});
    }
    if (!out.points.empty() && out.points.back() == p) {
      ++out.merged;
      continue;
    }
    out.points.push_back(p);
    if (!series.fixed.empty()) out.wishes.fixed.push_back(series.fixed[i]);
  }
  if (out.points.size() < 2) {
    return fail({ErrorCode::kTooFewPoints, "a contour needs at least two distinct points", "",
                 "add points", -1, static_cast<double>(out.points.size())});
  }
  out.wishes.convex = job.convex;
  const bool ends = job.start_heading || job.end_heading || job.start_kappa || job.end_kappa;
  if (ends && out.wishes.fixed.empty()) out.wishes.fixed.resize(out.points.size());
  if (job.start_heading) out.wishes.fixed.front().theta = job.start_heading;
  if (job.start_kappa) out.wishes.fixed.front().kappa = job.start_kappa;
  if (job.end_heading) out.wishes.fixed.back().theta = job.end_heading;
  if (job.end_kappa) out.wishes.fixed.back().kappa = job.end_kappa;
  return out;
}

std::vector<std::string> warn(const Cleaned& cleaned, const Analysis& a, const SeriesChain& chain) {
  std::vector<std::string> out;
  if (cleaned.merged > 0) {
    out.push_back(std::to_string(cleaned.merged) + " points equal to the one before were merged");
  }
  if (a.rounding_decided > 0) {
    out.push_back(
        "the rounding of the coordinates decides whether the curvature grows or falls on " +
        std::to_string(a.rounding_decided) + " segments, first between points " +
        std::to_string(a.first_rounding_decided + 1) + " and " +
        std::to_string(a.first_rounding_decided + 2) +
        "; vertices there come from the rounding, not from the curve");
  }
  if (chain.turned_directions > 0) {
    out.push_back(
        "no curve with the vertices of the adjacent circles runs through the points: the "
        "curvature was let turn back on " +
        std::to_string(chain.turned_directions) + " segments");
  }
  if (chain.unforced_inflection) {
    out.push_back("the contour needs an inflection that the adjacent circles do not show");
  }
  if (!chain.converged) {
    out.push_back(
        "the headings and curvatures are valid but not quite the fairest: the solver "
        "stopped at its limit of steps");
  }
  return out;
}

Result<Contour> form(const Cleaned& cleaned, const SeriesChain& chain, const PointSeries& series,
                     const FitJob& job, double tolerance) {
  if (job.carrier == Carrier::kClothoids) {
    auto clothoids = form_clothoids(cleaned.points, chain);
    if (clothoids) clothoids->units = series.units;
    return clothoids;
  }
  auto spirals = form_spirals(cleaned.points, chain);
  if (!spirals) return spirals;
  spirals->units = series.units;
  if (job.carrier == Carrier::kSpiral) return spirals;
  return form_arcs(*spirals, tolerance);
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
  auto cleaned = clean(series, job);
  if (!cleaned) return tl::unexpected(cleaned.error());
  tell("analysing", 0.0);
  const auto analysis = analyse(cleaned->points);
  if (!analysis) return tl::unexpected(analysis.error());
  tell("choosing headings and curvatures", 0.1);
  const auto chain = form_elements(cleaned->points, *analysis, cleaned->wishes);
  if (!chain) return tl::unexpected(chain.error());
  tell("forming pieces", 0.6);
  const double tolerance = job.tolerance.value_or(default_tolerance(*analysis));
  auto contour = form(*cleaned, *chain, series, job, tolerance);
  if (!contour) return tl::unexpected(contour.error());
  tell("proving", 0.7);
  Fit out;
  out.certificate = certify(*contour);
  tell("bounding the error", 0.9);
  out.report = measure(*contour, *analysis, tolerance);
  out.report.vertices = out.certificate.vertices;
  out.report.inflections = out.certificate.inflections;
  out.report.chain = {chain->newton_steps, chain->smallest_margin, chain->free_elements};
  out.contour = std::move(*contour);
  out.warnings = series.warnings;
  for (std::string& w : warn(*cleaned, *analysis, *chain)) out.warnings.push_back(std::move(w));
  out.report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  tell("done", 1.0);
  return out;
}

}  // namespace obvid
