// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/section_chain.h"
#include "obvid/certify/certify.h"
#include "obvid/numeric/internal/median.h"

namespace obvid {
namespace {

/// Calls that are timed: as many as take this long, at least one, at most this many.
constexpr double kLongEnough = 0.1;  // s
constexpr int kMostCalls = 9;

/// Median time of the calls, without what is measured against the spirals; the contour is the same
/// every time. A call that takes long enough is the only one; what it found done counts with its
/// time.
Result<Fit> timed_fit(const PointSeries& series, const FitJob& job,
                      pipeline_detail::FoundChains& chains, Watch& watch, double& median) {
  chains.begin_another();
  auto made = pipeline_detail::fit_with(series, job, chains, watch);
  if (!made) return made;
  median = made->report.seconds - made->report.comparing_seconds + chains.spared_seconds();
  // a baseline needs spirals for nothing but the comparison
  if (median >= kLongEnough && info_of(job.carrier).needs != CarrierNeeds::kPoints) return made;
  FitJob alone = job;
  alone.measure_against_spirals = false;
  std::vector<double> times;
  double all = 0.0;
  while (times.empty() || (all < kLongEnough && times.size() < kMostCalls)) {
    const auto one = fit(series, alone, watch);
    if (!one) break;
    times.push_back(one->report.seconds);
    all += times.back();
  }
  if (times.empty()) return made;
  median = median_within(times);
  return made;
}

int continuity_of(const Contour& contour, const Certificate& certificate) {
  if (certificate.gaps.heading > kContinuousHeading) return 0;
  const bool steps = certificate.curvature_steps > 0 || steps_at_joints(contour.carrier);
  if (certificate.gaps.curvature > kContinuousCurvature || steps) return 1;
  return contour.continuity == Continuity::kG3 && certificate.slope_steps == 0 ? 3 : 2;
}

std::size_t control_points_of(const Piece& piece) {
  if (std::holds_alternative<LinePiece>(piece)) return 2;
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    return static_cast<std::size_t>(bezier->degree) + 1;
  }
  const auto* arc = std::get_if<ArcPiece>(&piece);
  if (arc == nullptr) return 0;
  // a rational quadratic turns by less than half a turn; a quarter is what CAD systems take
  constexpr double kQuarter = 1.5707963267948966;
  const double quarters = std::ceil(std::abs(arc->kappa * arc->length) / kQuarter);
  return 2 * static_cast<std::size_t>(std::max(quarters, 1.0)) + 1;
}

/// Whether one contour is to be preferred to another: one that is made, then one that keeps its
/// promise, then one with fewer vertices.
bool is_better(const Result<Fit>& one, const Result<Fit>& other) {
  if (!one || !other) return one.has_value();
  const Certificate &a = one->certificate, &b = other->certificate;
  if (a.proved != b.proved) return a.proved;
  return a.vertices < b.vertices;
}

/// Whether another carrier lacks something that it might have with other spirals.
bool wants_other_spirals(const Result<Fit>& made, Carrier carrier, const Fit& spirals) {
  if (!made) return true;
  return promises_monotone(carrier) &&
         (!made->certificate.proved || made->certificate.vertices > spirals.certificate.vertices);
}

/// Control points that a joint saves: one is shared, and each order of continuity by the parameter
/// takes one more.
std::size_t saved_by_joint(Carrier carrier) {
  constexpr std::size_t kC2 = 3;
  return info_of(carrier).one_spline ? kC2 : 1;
}

}  // namespace

std::size_t control_points(const Contour& contour) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const std::size_t own = control_points_of(contour.pieces[i]);
    if (own == 0) return 0;
    const bool corner = i < contour.joints.size() && contour.joints[i].leaving.has_value();
    const bool alike = i > 0 && std::holds_alternative<RationalBezier>(contour.pieces[i]) &&
                       std::holds_alternative<RationalBezier>(contour.pieces[i - 1]);
    const std::size_t saved = i == 0 ? 0 : corner || !alike ? 1 : saved_by_joint(contour.carrier);
    count += own - std::min(saved, own);
  }
  return count;
}

Result<Comparison> compare_carriers(const PointSeries& series, const FitJob& job,
                                    const RunContext& run, Comparison* finished) {
  Comparison out;
  Watch watch(without_progress(run));  // the bar shows carriers
  pipeline_detail::FoundChains chains;
  for (const Carrier carrier : kAllCarriers) {
    const auto done = static_cast<double>(out.carriers.size());
    if (run.progress) {
      run.progress(to_string(carrier), done / static_cast<double>(kAllCarriers.size()));
    }
    FitJob one = job;
    one.carrier = carrier;
    ComparedCarrier row;
    row.carrier = carrier;
    if (follows_spirals(carrier)) {
      if (job.continuity ==
          Continuity::kG3) {  // those that were made: they may have given way to G2
        one.followed = out.carriers.front().fit.contour.continuity;
      }
      one.continuity = Continuity::kG2;
    }
    auto made = timed_fit(series, one, chains, watch, row.seconds);
    if (one.followed == Continuity::kG3 && !watch.was_cancelled() &&
        wants_other_spirals(made, carrier, out.carriers.front().fit)) {
      one.followed = Continuity::kG2;
      double seconds = 0.0;
      auto other = timed_fit(series, one, chains, watch, seconds);
      if (is_better(other, made)) {
        made = std::move(other);
        row.seconds = seconds;
      } else {
        one.followed = Continuity::kG3;
      }
    }
    row.followed = !follows_spirals(carrier) && made ? made->contour.continuity : one.followed;
    if (watch.was_cancelled()) {
      if (finished != nullptr) *finished = std::move(out);
      return fail(cancelled_error());
    }
    if (!made && !follows_spirals(carrier)) return fail(made.error());
    if (made) {
      row.fit = std::move(*made);
      row.control_points = control_points(row.fit.contour);
      row.continuity = continuity_of(row.fit.contour, row.fit.certificate);
    } else {
      row.refusal = made.error();
    }
    out.carriers.push_back(std::move(row));
  }
  if (run.progress) run.progress("done", 1.0);
  return out;
}

}  // namespace obvid
