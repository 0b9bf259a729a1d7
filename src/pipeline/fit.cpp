// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "assemble.h"
#include "form.h"
#include "keep_joints.h"
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

Result<Carried> as_carried(Result<Contour> contour) {
  if (!contour) return tl::unexpected(contour.error());
  return Carried{std::move(*contour), {}, {}};
}

Result<Carried> form_carrier(const std::vector<Vec2>& points, const SeriesChain& chain, Carrier carrier,
                     double tolerance, bool loop) {
  if (carrier == Carrier::kClothoids) return as_carried(form_clothoids(points, chain));
  auto spirals = form_spirals(points, chain);
  if (!spirals) return tl::unexpected(spirals.error());
  switch (carrier) {
    case Carrier::kArcs:
      return as_carried(form_arcs(*spirals, tolerance));
    case Carrier::kConics:
      return form_conics(*spirals);
    case Carrier::kBeziers:
      return form_beziers(*spirals, tolerance);
    case Carrier::kBspline:
      return form_bspline(*spirals, tolerance);
    case Carrier::kCubic:
      return form_cubic(*spirals, tolerance, loop);
    default:
      return as_carried(std::move(spirals));
  }
}

/// A carrier that promises continuous curvature keeps its digits at the joints.
bool keeps_curvature(Carrier carrier) {
  return carrier == Carrier::kSpiral || carrier == Carrier::kConics ||
         carrier == Carrier::kBeziers || carrier == Carrier::kBspline;
}

Result<Carried> form(const std::vector<Vec2>& points, const SeriesChain& chain, Carrier carrier,
                     double tolerance, bool loop) {
  auto out = form_carrier(points, chain, carrier, tolerance, loop);
  if (out && keeps_curvature(carrier)) keep_joint_curvatures(out->contour);
  return out;
}

/// The spline of CAD systems asks for no headings and curvatures.
Result<Carried> form_baseline_section(const Prepared& series, const Section& section) {
  const bool loop = series.split.smooth_loop;
  const std::size_t last = loop ? series.points.size() : section.last;
  std::vector<Vec2> points;
  std::vector<std::size_t> source;
  for (std::size_t k = section.first; k <= last; ++k) {
    source.push_back(series.split.point_at(k) % series.points.size());
    points.push_back(series.points[source.back()]);
  }
  return form_baseline(points, source, loop);
}

/// One attempt at the whole contour, with how it was found.
struct Formed {
  Contour contour;
  ChainReport chain;
  std::optional<double> deviation;
  std::vector<std::string> warnings;

  void add(Carried section, Assembly& assembly) {
    if (section.deviation) deviation = std::max(deviation.value_or(0.0), *section.deviation);
    warnings.insert(warnings.end(), section.warnings.begin(), section.warnings.end());
    assembly.append(std::move(section.contour));
  }
};

/// Whether the carrier passes points that are no joints within the tolerance only.
bool follows_spirals(Carrier carrier) {
  return carrier == Carrier::kBspline || carrier == Carrier::kCubic;
}

/// How far the contour may pass each point: a carrier that follows the spirals needs its tolerance.
std::vector<double> point_tolerance(const Prepared& series, Carrier carrier, double tolerance) {
  std::vector<double> out = series.tolerance;
  if (!follows_spirals(carrier)) return out;
  out.resize(series.points.size(), 0.0);
  for (double& one : out) one = std::max(one, tolerance);
  return out;
}

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
    if (job.carrier == Carrier::kBaseline) {
      auto section = form_baseline_section(series, sections[k]);
      if (!section) return tl::unexpected(section.error());
      out.add(std::move(*section), assembly);
      continue;
    }
    const auto chain = chain_section(series, sections[k], inner);
    if (!chain) return tl::unexpected(chain.error());
    auto section =
        form(series.points, chain->chain, job.carrier, tolerance, series.split.smooth_loop);
    if (!section) return tl::unexpected(section.error());
    out.add(std::move(*section), assembly);
    add(*chain, out);
  }
  if (series.closed) assembly.close(series.split.smooth_loop);
  out.contour = assembly.take();
  out.contour.points = series.points;
  out.contour.point_tolerance = point_tolerance(series, job.carrier, tolerance);
  out.contour.carrier = job.carrier;
  return out;
}

/// A carrier that follows the spirals needs a part of each point's tolerance for itself: half of
/// the least at the most. Returns what it may use.
double share_tolerance(Prepared& series, double tolerance) {
  double own = tolerance;
  for (const double reach : series.reach) {
    if (reach > 0.0) own = std::min(own, 0.5 * reach);
  }
  for (double& reach : series.reach) reach = reach > 0.0 ? reach - own : 0.0;
  return own;
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
    const double allowed = contour.point_tolerance[i];
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
  double tolerance = job.tolerance.value_or(default_tolerance(prepared->points));
  if (follows_spirals(job.carrier)) tolerance = share_tolerance(*prepared, tolerance);
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
  out.report.carrier_deviation = formed->deviation;
  if (!out.contour.point_tolerance.empty()) out.report.moves = point_distances(out.contour);
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
