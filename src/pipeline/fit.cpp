// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "against_spirals.h"
#include "assemble.h"
#include "form.h"
#include "given.h"
#include "obvid/certify/certify.h"
#include "parts.h"
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
  return Carried{std::move(*contour), {}};
}

/// A section in its carrier; `spirals` are those that carry the same elements.
Result<Carried> form(const std::vector<Vec2>& points, const SeriesChain& chain,
                     const Contour& spirals, const Prepared& series, Carrier carrier,
                     double tolerance) {
  switch (carrier) {
    case Carrier::kClothoids:
      return as_carried(form_clothoids(points, chain));
    case Carrier::kArcs:
      return as_carried(form_arcs(spirals, tolerance, series.given));
    case Carrier::kConics:
      return form_conics(spirals, series.given);
    case Carrier::kBeziers:
      return form_beziers(spirals, tolerance);
    case Carrier::kBspline:
      return form_bspline(spirals, tolerance, series.given);
    case Carrier::kCubic:
      return form_cubic(spirals, tolerance, series.split.smooth_loop);
    default:
      return as_carried(spirals);
  }
}

/// The spline of CAD systems asks for no headings and curvatures; those given at its ends it keeps.
Result<Carried> form_baseline_section(const Prepared& series, const Section& section) {
  const bool loop = series.split.smooth_loop;
  const std::size_t last = loop ? series.points.size() : section.last;
  std::vector<Vec2> points;
  std::vector<std::size_t> source;
  for (std::size_t k = section.first; k <= last; ++k) {
    source.push_back(series.split.point_at(k) % series.points.size());
    points.push_back(series.points[source.back()]);
  }
  const auto heading_at = [&](std::size_t point) {
    return series.fixed.empty() ? std::nullopt : series.fixed[point].theta;
  };
  return form_baseline(points, source, loop, heading_at(source.front()), heading_at(source.back()));
}

/// One attempt at the whole contour, with how it was found.
struct Formed {
  Contour contour;
  std::optional<Contour> spirals;  ///< that another carrier stands for
  ChainReport chain;
  std::vector<std::string> warnings;

  void add(Carried section, Assembly& assembly) {
    warnings.insert(warnings.end(), section.warnings.begin(), section.warnings.end());
    assembly.append(std::move(section.contour));
  }
};

/// How far the contour may pass each point: a carrier that follows the spirals needs its tolerance.
std::vector<double> point_tolerance(const Prepared& series, Carrier carrier, double tolerance) {
  std::vector<double> out = series.tolerance;
  if (!passes_between_joints(carrier)) return out;
  out.resize(series.points.size(), 0.0);
  for (double& one : out) one = std::max(one, tolerance);
  return out;
}

void add_section(const SectionChain& section, Formed& formed) {
  ChainReport& sum = formed.chain;
  const SeriesChain& one = section.chain;
  sum.smallest_margin = sum.newton_steps == 0 ? one.smallest_margin
                                              : std::min(sum.smallest_margin, one.smallest_margin);
  sum.newton_steps += one.newton_steps;
  sum.free_elements += one.free_elements;
  formed.warnings.insert(formed.warnings.end(), section.warnings.begin(), section.warnings.end());
}

/// Forms the sections one after the other, and beside them the spirals of the same elements.
class SectionForming {
 public:
  SectionForming(const Prepared& series, const FitJob& job, double tolerance,
                 const Progress& progress)
      : series_(series), job_(job), tolerance_(tolerance), progress_(progress) {}

  Result<Formed> run() {
    for (std::size_t k = 0; k < series_.split.sections.size(); ++k) {
      if (auto done = form_one(k); !done) return tl::unexpected(done.error());
    }
    out_.contour = finished(assembly_, job_.carrier);
    if (have_spirals_) out_.spirals = finished(spirals_, Carrier::kSpiral);
    return std::move(out_);
  }

 private:
  Result<void> form_one(std::size_t k) {
    const Section& section = series_.split.sections[k];
    if (form_drawn(section)) return {};
    if (job_.carrier == Carrier::kBaseline) return form_baseline_alone(section, k);
    const auto chain = chain_section(series_, section, progress_of(k));
    if (!chain) return tl::unexpected(chain.error());
    auto spirals = form_spirals(series_.points, chain->chain);
    if (!spirals && job_.carrier != Carrier::kClothoids) return tl::unexpected(spirals.error());
    auto carried = form(series_.points, chain->chain, spirals ? *spirals : Contour{}, series_,
                        job_.carrier, tolerance_);
    if (!carried) return tl::unexpected(carried.error());
    out_.add(std::move(*carried), assembly_);
    add_section(*chain, out_);
    keep(std::move(spirals));
    return {};
  }

  /// A piece of a drawing stays as it is. False where there is none.
  bool form_drawn(const Section& section) {
    const std::size_t first = series_.split.point_at(section.first);
    if (series_.kept.empty() || !series_.kept[first]) return false;
    const std::size_t last = series_.split.point_at(section.last) % series_.points.size();
    Contour drawn = form_kept(*series_.kept[first], series_.points, first, last);
    out_.add({drawn, {}}, assembly_);
    keep(std::move(drawn));
    return true;
  }

  /// Needs no spirals, and is compared with them where there are any.
  Result<void> form_baseline_alone(const Section& section, std::size_t k) {
    auto carried = form_baseline_section(series_, section);
    if (!carried) return tl::unexpected(carried.error());
    out_.add(std::move(*carried), assembly_);
    if (!job_.measure_against_spirals) return {};
    const auto chain = chain_section(series_, section, progress_of(k));
    keep(chain ? form_spirals(series_.points, chain->chain)
               : Result<Contour>(tl::unexpected(chain.error())));
    return {};
  }

  void keep(Result<Contour> spirals) {
    have_spirals_ = have_spirals_ && job_.measure_against_spirals && spirals.has_value() &&
                    job_.carrier != Carrier::kSpiral;
    if (have_spirals_) spirals_.append(std::move(*spirals));
  }

  [[nodiscard]] Progress progress_of(std::size_t k) const {
    constexpr double kUntilHere = 0.6;  // of the whole work
    const double count = static_cast<double>(series_.split.sections.size());
    return [this, k, count](std::string_view stage, double done) {
      if (progress_) progress_(stage, kUntilHere * (static_cast<double>(k) + done) / count);
    };
  }

  [[nodiscard]] Contour finished(Assembly& assembly, Carrier carrier) const {
    if (series_.closed) assembly.close(series_.split.smooth_loop);
    Contour contour = assembly.take();
    contour.points = series_.points;
    contour.point_tolerance = point_tolerance(series_, carrier, tolerance_);
    contour.given = series_.given;
    contour.carrier = carrier;
    return contour;
  }

  const Prepared& series_;
  const FitJob& job_;
  double tolerance_;
  const Progress& progress_;
  Formed out_;
  Assembly assembly_, spirals_;
  bool have_spirals_ = true;
};

Result<Formed> form_sections(const Prepared& series, const FitJob& job, double tolerance,
                             const Progress& progress) {
  return SectionForming(series, job, tolerance, progress).run();
}

/// Part of a point's tolerance that a carrier which follows the spirals takes for itself: what it
/// takes, the spirals lack, and less room means more vertices.
constexpr double kOwnPart = 0.1;

/// A carrier that follows the spirals needs a part of each point's tolerance for itself, a tenth of
/// the least at the most. Returns what it may use.
double share_tolerance(Prepared& series, double tolerance) {
  double own = tolerance;
  for (const double reach : series.reach) {
    if (reach > 0.0) own = std::min(own, kOwnPart * reach);
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
  if (passes_between_joints(job.carrier)) tolerance = share_tolerance(*prepared, tolerance);
  auto formed = form_sections(*prepared, job, tolerance, progress);
  for (int k = 0; k < kNarrowings && formed && narrow(formed->contour, *prepared); ++k) {
    formed = form_sections(*prepared, job, tolerance, progress);
  }
  if (formed && prepared->thin && misses_a_point(formed->contour)) {
    prepared->thin = false;  // every point a joint: each is met by construction
    formed = form_sections(*prepared, job, tolerance, progress);
  }
  if (!formed) {
    Error error = formed.error();
    if (!prepared->polygon.empty()) {
      error.hint += (error.hint.empty() ? "" : "; ") + prepared->polygon;
    }
    return fail(std::move(error));
  }
  if (auto kept = keeps_given(formed->contour); !kept) return fail(kept.error());
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
  settle_with(out.certificate, out.contour, out.report);
  if (formed->spirals) {
    measure_against(*formed->spirals, out.contour, out.report);
  }
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
