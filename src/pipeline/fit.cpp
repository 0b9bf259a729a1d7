// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "against_spirals.h"
#include "assemble.h"
#include "form.h"
#include "given.h"
#include "keep_joints.h"
#include "obvid/certify/certify.h"
#include "obvid/region/refine.h"
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
/// No further round begins when so many steps on every point (and some more where there are few)
/// were spent: a hundred times what a contour takes as a rule.
constexpr double kMostFitSteps = 1e4, kSpareWork = 1e6;
constexpr double kFormedAt = 0.7;  ///< part of the bar when all sections are formed
/// Arcs whose regions came out wider than asked, by the rounding of their ends, are formed again.
constexpr int kArcTrials = 2;
constexpr double kNarrowedArcs = 0.99;  ///< of what would just do

Result<Carried> as_carried(Result<Contour> contour) {
  if (!contour) return tl::unexpected(contour.error());
  return Carried{std::move(*contour), {}};
}

/// A section in its carrier; `spirals` are those that carry the same elements.
Result<Carried> form_carrier(const std::vector<Vec2>& points, const SeriesChain& chain,
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
      return Carried{spirals, {}};
  }
}

/// A carrier that promises continuous curvature keeps its digits at the joints.
bool keeps_curvature(Carrier carrier) {
  return carrier == Carrier::kConics || carrier == Carrier::kBeziers ||
         carrier == Carrier::kBspline;
}

Result<Carried> form(const std::vector<Vec2>& points, const SeriesChain& chain,
                     const Contour& spirals, const Prepared& series, Carrier carrier,
                     double tolerance) {
  auto out = form_carrier(points, chain, spirals, series, carrier, tolerance);
  if (out && keeps_curvature(carrier)) keep_joint_curvatures(out->contour);
  if (out && carrier == Carrier::kConics) chain_conic_weights(out->contour);
  return out;
}

/// Spirals whose stored numbers have the curvatures of their joints.
Result<Contour> exact_spirals(const std::vector<Vec2>& points, const SeriesChain& chain) {
  auto out = form_spirals(points, chain);
  if (out) keep_joint_curvatures(*out);
  return out;
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
  SectionForming(const Prepared& series, const FitJob& job, double tolerance, Watch& watch)
      : series_(series),
        job_(job),
        tolerance_(tolerance),
        watch_(watch),
        have_spirals_(job.measure_against_spirals) {}

  Result<Formed> run() {
    for (std::size_t k = 0; k < series_.split.sections.size(); ++k) {
      if (auto done = form_one(k); !done) return tl::unexpected(done.error());
    }
    out_.contour = finished(assembly_, job_.carrier);
    if (have_spirals_ && job_.carrier != Carrier::kSpiral) {
      out_.spirals = finished(spirals_, Carrier::kSpiral);
    }
    return std::move(out_);
  }

 private:
  Result<void> form_one(std::size_t k) {
    const auto count = static_cast<double>(series_.split.sections.size());
    const Stretch stretch(watch_, static_cast<double>(k) / count,
                          static_cast<double>(k + 1) / count);
    watch_.tell("choosing headings and curvatures", 0.0);
    const Section& section = series_.split.sections[k];
    if (form_drawn(section)) return {};
    if (job_.carrier == Carrier::kBaseline) return form_baseline_alone(section);
    const auto chain = chain_section(series_, section, watch_);
    if (!chain) return tl::unexpected(chain.error());
    auto spirals = exact_spirals(series_.points, chain->chain);
    if (!spirals && job_.carrier != Carrier::kClothoids) return tl::unexpected(spirals.error());
    if (job_.carrier == Carrier::kSpiral) {
      assembly_.append(std::move(*spirals));
      add_section(*chain, out_);
      return {};
    }
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
  Result<void> form_baseline_alone(const Section& section) {
    auto carried = form_baseline_section(series_, section);
    if (!carried) return tl::unexpected(carried.error());
    out_.add(std::move(*carried), assembly_);
    if (!job_.measure_against_spirals) return {};
    const auto chain = chain_section(series_, section, watch_);
    keep(chain ? exact_spirals(series_.points, chain->chain)
               : Result<Contour>(tl::unexpected(chain.error())));
    return {};
  }

  void keep(Result<Contour> spirals) {
    have_spirals_ = have_spirals_ && spirals.has_value();
    if (have_spirals_) spirals_.append(std::move(*spirals));
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
  Watch& watch_;
  Formed out_;
  Assembly assembly_, spirals_;
  bool have_spirals_;  // as long as they are asked for, and all sections have them
};

Result<Formed> form_sections(const Prepared& series, const FitJob& job, double tolerance,
                             Watch& watch) {
  return SectionForming(series, job, tolerance, watch).run();
}

/// Part of a point's tolerance that a carrier which follows the spirals takes for itself: what it
/// takes, the spirals lack, and less room means more vertices.
constexpr double kOwnPart = 0.1;

/// A carrier that follows the spirals needs a part of each point's tolerance for itself, a tenth of
/// the least at the most. Returns what it may use.
double share_tolerance(Prepared& series, double tolerance, double least) {
  double own = tolerance;
  for (const double reach : series.reach) {
    if (reach > 0.0) own = std::min(own, kOwnPart * reach);
  }
  own = std::max(own, least);
  for (double& reach : series.reach) reach = std::max(0.0, reach - own);
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

/// The tolerance of the job, or the default; refused where coordinates could not tell it.
Result<double> tolerance_of(const FitJob& job, const std::vector<Vec2>& points, double least) {
  if (!job.tolerance) return std::max(least, default_tolerance(points));
  if (std::isfinite(*job.tolerance) && *job.tolerance >= least) return *job.tolerance;
  return fail(
      {ErrorCode::kBadOption,
       fmt::format("the tolerance must be finite and at least {:.2g} (1e-12 of the size, or "
                   "the rounding of coordinates)",
                   least),
       "", "give a larger one, or none for the default", -1, *job.tolerance});
}

/// The contour, formed again with narrower reaches as long as it passes points too far.
Result<Formed> form_within(Prepared& series, const FitJob& job, double tolerance, Watch& watch) {
  const double most =
      watch.spent() + kSpareWork + kMostFitSteps * static_cast<double>(series.points.size());
  int round = 0;
  const auto again = [&] {
    const Stretch stretch = Stretch::next_of_many(watch, round++);
    return form_sections(series, job, tolerance, watch);
  };
  auto formed = again();
  while (formed && round <= kNarrowings && watch.spent() < most &&
         narrow(formed->contour, series)) {
    formed = again();
  }
  if (formed && series.thin && misses_a_point(formed->contour)) {
    series.thin = false;  // every point a joint: each is met by construction
    formed = again();
  }
  return formed;
}

/// A contour with the figures that follow from it alone.
struct Measured {
  Formed formed;
  FitReport report;
};

/// What carriers are formed within, and what widths are to keep.
struct Tolerances {
  double formed, asked;
};

Result<Measured> form_and_measure(Prepared& prepared, const FitJob& job, const Units& units,
                                  const Tolerances& within, Watch& watch) {
  Result<Formed> formed = [&] {
    const Stretch stretch(watch, 0.0, kFormedAt);
    return form_within(prepared, job, within.formed, watch);
  }();
  if (!formed) {
    Error error = formed.error();
    if (!prepared.polygon.empty()) {
      error.hint += (error.hint.empty() ? "" : "; ") + prepared.polygon;
    }
    return fail(std::move(error));
  }
  take_piece_ends(formed->contour);
  if (auto kept = keeps_given(formed->contour); !kept) return fail(kept.error());
  formed->contour.units = units;
  auto report = measure(formed->contour, within.asked);
  if (!report) return tl::unexpected(report.error());
  return Measured{std::move(*formed), std::move(*report)};
}

}  // namespace

Result<Fit> fit(const PointSeries& series, const FitJob& job, Watch& watch) {
  const auto begin = std::chrono::steady_clock::now();
  watch.tell("analysing", 0.0);
  auto prepared = prepare(series, job);
  if (!prepared) return tl::unexpected(prepared.error());
  const double least = least_tolerance(prepared->points);
  const auto asked = tolerance_of(job, prepared->points, least);
  if (!asked) return tl::unexpected(asked.error());
  const double tolerance =
      passes_between_joints(job.carrier) ? share_tolerance(*prepared, *asked, least) : *asked;
  auto measured = form_and_measure(*prepared, job, series.units, {tolerance, *asked}, watch);
  // what rounding makes of arcs shows in their regions only
  for (int k = 0; k < kArcTrials && measured && job.carrier == Carrier::kArcs &&
                  measured->report.largest_width > *asked;
       ++k) {
    const double aim = kNarrowedArcs * tolerance * *asked / measured->report.largest_width;
    measured = form_and_measure(*prepared, job, series.units, {aim, *asked}, watch);
  }
  if (!measured) return fail(measured.error());
  Formed* formed = &measured->formed;
  Fit out;
  out.contour = std::move(formed->contour);
  watch.tell("proving", kFormedAt);
  out.certificate = certify(out.contour);
  if (job.convex) {
    if (auto kept = keeps_convex(out.contour, out.certificate); !kept) return fail(kept.error());
  }
  out.report = std::move(measured->report);
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
  watch.tell("done", 1.0);
  return out;
}

Result<Fit> fit(const PointSeries& series, const FitJob& job, const Progress& progress) {
  Watch watch(progress);
  return fit(series, job, watch);
}

}  // namespace obvid
