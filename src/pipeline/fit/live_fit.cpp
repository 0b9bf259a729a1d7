// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/live_fit.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fit/keep_joints.h"
#include "fit/parts.h"
#include "fit/prepare.h"
#include "fit/section_chain.h"
#include "fit/wandering.h"
#include "fit/form.h"
#include "obvid/certify/certify.h"
#include "obvid/chain/internal/chain_part.h"
#include "obvid/chain/internal/smooth_chain.h"
#include "obvid/contour/spirals/over_chain.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/runs.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

/// Links around a change whose headings are compared with the circles of their neighbours.
constexpr std::size_t kWanderingContext = 4;

/// Whether headings and curvatures of such a job follow from points and directions alone, one
/// element to a point.
bool follows_points(const PointSeries& series, const FitJob& job, const Prepared& prepared) {
  const SplitSeries& split = prepared.split;
  if (follows_spirals(job.carrier) || job.convex || job.primitives || !prepared.exact() ||
      !prepared.kept.empty() || !prepared.fixed.empty() || split.sections.size() != 1 ||
      prepared.points.size() != series.points.size() || prepared.closed != split.smooth_loop) {
    return false;
  }
  for (std::size_t k = 0; k < split.order.size(); ++k) {
    if (split.order[k] != k) return false;
  }
  return true;
}

/// Whether a changed part does what the points do not ask for.
bool wanders(const SeriesChain& chain, const ChangedElements& changed) {
  const std::size_t first = changed.first - std::min(changed.first, kWanderingContext);
  const std::size_t last = std::min(chain.elements.size() - 1, changed.last + kWanderingContext);
  const SeriesChain part = slice_of(chain, first, last);
  const std::size_t n = part.elements.size();
  const Wandering found =
      find_wandering(part, std::vector<double>(n, 0.0), std::vector<bool>(n, false), false);
  return !found.senseless.empty();
}

/// Index of the joint on an element of a chain that has one on each point.
std::size_t joint_on(const Contour& contour, std::size_t point) {
  const auto at = std::find_if(contour.joints.begin(), contour.joints.end(),
                               [&](const Joint& joint) { return joint.source == point; });
  return static_cast<std::size_t>(at - contour.joints.begin());
}

/// Puts new entries in place of first..end.
template <class T>
void replace(std::vector<T>& all, std::size_t first, std::size_t end, const std::vector<T>& from,
             std::size_t from_first, std::size_t from_end) {
  const auto at = [](auto& list, std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(i);
  };
  if (end - first == from_end - from_first) {
    std::copy(at(from, from_first), at(from, from_end), at(all, first));
    return;
  }
  const auto gap = all.erase(at(all, first), at(all, end));
  all.insert(gap, at(from, from_first), at(from, from_end));
}

}  // namespace

LiveFit::LiveFit(PointSeries series, const FitJob& job, Fit fit)
    : series_(std::move(series)),
      job_(job),
      contour_(std::move(fit.contour)),
      certificate_(std::move(fit.certificate)) {}

Result<LiveFit> LiveFit::form(PointSeries series, const FitJob& job, Watch& watch) {
  auto made = fit(series, job, watch);
  OBVID_TRY(made);
  return LiveFit(std::move(series), job, std::move(*made));
}

/// As `fit` chose them: it is deterministic.
void LiveFit::know_chains(Watch& watch) {
  if (chains_known_) return;
  chains_known_ = true;
  const Continuity wanted = wanted_continuity(job_);
  if (!certificate_.proved || contour_.continuity != wanted) return;
  auto prepared = prepare(series_, job_);
  if (!prepared || !follows_points(series_, job_, *prepared)) return;
  auto section = chain_section(*prepared, prepared->split.sections.front(), watch);
  if (!section || !section->warnings.empty()) return;
  Chains chains;
  chains.loop = prepared->split.smooth_loop;
  if (wanted == Continuity::kG3) {
    chains.g3 = section->chain;
    if (!smooth_slopes(*chains.g3, chains.loop, watch, {}, section->seam).stepped.empty()) return;
  }
  chains.g2 = std::move(section->chain);
  chains_ = std::move(chains);
}

Result<LiveFit::Change> LiveFit::move_whole(Watch& watch) {
  auto made = fit(series_, job_, watch);
  OBVID_TRY(made);
  contour_ = std::move(made->contour);
  certificate_ = std::move(made->certificate);
  memory_.clear();
  chains_.reset();
  chains_known_ = false;
  return Change{true, 0, contour_.pieces.size() - 1};
}

std::optional<LiveFit::Change> LiveFit::move_part(std::size_t point, Watch& watch) {
  if (!chains_) return std::nullopt;
  const auto prepared = prepare(series_, job_);
  if (!prepared || !follows_points(series_, job_, *prepared) ||
      prepared->split.smooth_loop != chains_->loop) {
    return std::nullopt;
  }
  Chains now = *chains_;
  auto changed = follow_moved_point(series_.points, point, now.loop, now.g2, watch);
  if (!changed || wanders(now.g2, *changed)) return std::nullopt;
  const bool smooth = now.g3.has_value();
  if (smooth) {
    changed = follow_changed_elements(chains_->g2, now.g2, *changed, now.loop, *now.g3, watch);
    if (!changed) return std::nullopt;
  }
  const SeriesChain& chain = smooth ? *now.g3 : now.g2;
  // pieces from the element before the changed ones to that behind them, and one more on both sides
  const std::size_t end = chain.elements.size() - 1;
  const bool at_start = changed->first == 0, at_end = changed->last == end;
  const std::size_t from = at_start ? 0 : changed->first - 1, to = at_end ? end : changed->last + 1;
  const std::size_t first = from - std::min<std::size_t>(from, 1), last = std::min(end, to + 1);
  const SeriesChain slice = slice_of(chain, first, last);
  auto part = spirals_over(series_.points, slice);
  if (!part) return std::nullopt;
  keep_joint_curvatures(*part);
  keep_joint_slopes(slice, *part);
  take_piece_ends(*part);

  Contour contour = contour_;
  const std::size_t old_from = joint_on(contour, from), old_to = joint_on(contour, to);
  const std::size_t new_from = joint_on(*part, from), new_to = joint_on(*part, to);
  std::vector<int> direction = piece_directions(contour);
  replace(direction, old_from, old_to, piece_directions(*part), new_from, new_to);
  replace(contour.pieces, old_from, old_to, part->pieces, new_from, new_to);
  const std::size_t skip = at_start ? 0 : 1, more = at_end ? 1 : 0;  // joints that stay
  replace(contour.joints, old_from + skip, old_to + more, part->joints, new_from + skip,
          new_to + more);
  contour.runs = collect_runs(direction);
  contour.points[point] = series_.points[point];
  memory_.replace(old_from, old_to, new_to - new_from);
  Certificate certificate = certify(contour, memory_, watch);
  if (!certificate.proved || watch.was_cancelled()) return std::nullopt;
  contour_ = std::move(contour);
  certificate_ = std::move(certificate);
  chains_ = std::move(now);
  return Change{false, old_from, old_from + (new_to - new_from) - 1};
}

Result<LiveFit::Change> LiveFit::move_point(std::size_t point, Vec2 to, Watch& watch) {
  if (point >= series_.points.size()) {
    return error(ErrorCode::kBadOption, "there is no such point")
        .where("point " + std::to_string(point + 1))
        .hint("points are counted from 0 here")
        .point(point);
  }
  if (watch.cancelled()) return fail(cancelled_error());
  know_chains(watch);
  const Vec2 before = std::exchange(series_.points[point], to);
  if (const auto done = move_part(point, watch)) return *done;
  auto whole = move_whole(watch);
  if (!whole) series_.points[point] = before;
  return whole;
}

}  // namespace obvid
