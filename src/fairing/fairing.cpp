// SPDX-License-Identifier: Apache-2.0
#include "obvid/fairing/internal/fairing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "build_tube.h"
#include "obvid/series/internal/forced_vertices.h"
#include "run_search.h"
#include "tube_solver.h"

namespace obvid {
namespace {

using namespace fairing_detail;

/// Weight of the tube's barrier in the final problem: small, so that fairness decides where inside
/// the tolerance a point lies.
constexpr double kFinalTube = 0.02;
constexpr double kFairEnough = 1e-6;  ///< Newton's decrement
constexpr int kFairSteps = 60;

/// Inside all cones, then to the fairest state. The closed form's cones when they leave room for
/// it, because then no link needs a further element.
bool make_fair(LaidTube& laid, Watch& watch, int& steps) {
  for (const Cone cone : {Cone::kClosedForm, Cone::kSpiral}) {
    TubeModel model(laid.tube, laid.direction, cone, kFairEnergy);
    TubeSolver solver(model, watch);
    State x = laid.start;
    if (!solver.find_inside(x).feasible) {
      steps += solver.steps();
      continue;
    }
    solver.descend(x, {1.0, kFinalBarrier, kFinalTube}, kFairEnough, kFairSteps);
    steps += solver.steps();
    laid.start = std::move(x);
    return true;
  }
  return false;
}

/// An exact arc comes in parts that turn by no more than this, rad.
constexpr double kLargestArc = 3.0;

/// Parts of an arc that belongs to a result; of one that does not, nobody asks for them.
int parts_of_arc(double turn, bool feasible) {
  return feasible ? std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kLargestArc))) : 1;
}

/// Appends a node's elements: one, or the ends of a primitive with exact pieces between them.
void append_node(const LaidTube& laid, const SmoothTube& smooth, std::size_t i, FairedSeries& out) {
  const TubeNode& n = laid.tube.nodes[i];
  const double* x = &laid.start[kPerNode * i];
  const auto node = laid.node[i];
  const auto first = node ? std::optional(smooth.source[*node]) : std::nullopt;
  const Vec2 origin = laid.tube.origin;
  const auto append = [&](double s, std::optional<std::size_t> source) {
    TubeNode at = n;
    at.before = -s;
    const NodeEnd end = place(at, x).in;
    out.elements.push_back({origin + end.position, n.theta + x[1] + end.kappa * s, end.kappa});
    out.source.push_back(source);
  };
  const auto reach = [&](double s, std::optional<std::size_t> source) {
    out.direction.push_back(0);
    append(s, source);
  };
  append(-n.before, n.lead > 0.0 ? std::nullopt : first);
  if (!n.is_primitive()) return;
  const double begin = n.lead - n.before, length = n.after - n.trail - begin;
  if (n.lead > 0.0) reach(begin, first);
  const double turn = length * place(n, x).in.kappa;
  const int parts = parts_of_arc(turn, out.feasible);
  for (int k = 1; k <= parts; ++k) {
    reach(begin + length * k / parts,
          k == parts ? std::optional(smooth.last_source[*node]) : std::nullopt);
  }
  if (n.trail > 0.0) reach(n.after, std::nullopt);
}

/// One circle or line through all points.
FairedSeries one_primitive(const MeasuredSeries& series, const SmoothTube& smooth) {
  FairedSeries out;
  out.feasible = true;
  out.primitives = 1;
  LaidTube laid;
  laid.tube = smooth.tube;
  laid.start = smooth.state;
  laid.node = {0};
  append_node(laid, smooth, 0, out);
  if (series.closed) {  // the end is the beginning
    out.elements.pop_back();
    out.source.pop_back();
  }
  return out;
}

/// The elements of a laid tube, one after another; `trouble` is the node in the whole tube near
/// which something failed.
void collect_nodes(const LaidTube& laid, const SmoothTube& smooth, std::size_t trouble,
                   FairedSeries& out) {
  for (std::size_t i = 0; i < laid.tube.nodes.size(); ++i) {
    if (laid.node[i] == trouble) out.trouble = out.elements.size();
    append_node(laid, smooth, i, out);
    if (i < laid.direction.size()) out.direction.push_back(laid.direction[i]);
    out.primitives += laid.tube.nodes[i].is_primitive() ? 1 : 0;
  }
  if (!laid.tube.closed || out.source.front() || out.elements.size() < 2) return;
  // a closed series begins at a point
  std::rotate(out.elements.begin(), out.elements.begin() + 1, out.elements.end());
  std::rotate(out.source.begin(), out.source.begin() + 1, out.source.end());
  std::rotate(out.direction.begin(), out.direction.begin() + 1, out.direction.end());
  out.trouble = (out.trouble + out.elements.size() - 1) % out.elements.size();
}

FairedSeries attempt_from(Seam seam, const MeasuredSeries& series, int lower_bound,
                          const std::vector<std::size_t>& loose, Watch& watch) {
  constexpr const char* kStage = "searching runs";
  FairedSeries out;
  const SmoothTube smooth = build_tube(series, loose, watch, seam);
  watch.tell(kStage, 0.1);
  if (smooth.tube.nodes.size() == 1) {
    out = one_primitive(series, smooth);
    out.vertices_lower_bound = lower_bound;
    return out;
  }
  out.vertices_lower_bound = lower_bound;
  out.newton_steps = smooth.newton_steps;
  if (!smooth.inside) {
    const Layout any(smooth.tube.links(), course(1));
    collect_nodes(lay_out(smooth.tube, smooth.state, {0, smooth.tube.links()}, any), smooth,
                  smooth.trouble, out);
    return out;
  }
  RunSearch search(smooth.tube, smooth.state, watch);
  const Runs runs = search.search(lower_bound);
  watch.tell(kStage, 0.6);
  out.newton_steps += search.newton_steps();
  LaidTube laid = lay_out(smooth.tube, smooth.state, {0, smooth.tube.links()}, runs.layout);
  out.feasible = runs.feasible && make_fair(laid, watch, out.newton_steps);
  out.vertices = runs.vertices;
  collect_nodes(laid, smooth, runs.trouble, out);
  watch.tell(kStage, 1.0);
  return out;
}

/// The search looks at links of one side of the seam at a time: where it fails beside the seam, it
/// begins anew from another.
FairedSeries attempt(const MeasuredSeries& series, int lower_bound,
                     const std::vector<std::size_t>& loose, Watch& watch) {
  constexpr std::size_t kBesideSeam = 8;  // elements
  FairedSeries out = attempt_from(Seam::kSteepest, series, lower_bound, loose, watch);
  const std::size_t n = out.elements.size();
  const bool beside = std::min(out.trouble, n - std::min(n, out.trouble)) < kBesideSeam;
  if (out.feasible || !series.closed || !beside || !watch.may_go_on()) return out;
  FairedSeries again = attempt_from(Seam::kElsewhere, series, lower_bound, loose, watch);
  again.newton_steps += out.newton_steps;
  return again.feasible ? again : out;
}

/// Points that are taken off the ends of primitives until the transitions have room.
constexpr int kMostTrims = 40;
/// Work of that, in steps on every point, and for few points.
constexpr double kTrimSteps = 3000.0, kTrimWork = 2e5;

/// Nothing when no transition fits between the lines and arcs, or the work is used up. `meant`: how
/// many there are before any is given up.
std::optional<FairedSeries> keep_primitives(const MeasuredSeries& series, int lower_bound,
                                            Watch& watch, int& meant) {
  const Allowance allowance(watch,
                            kTrimWork + kTrimSteps * static_cast<double>(series.points.size()));
  std::vector<std::size_t> loose = series.loose;
  for (int k = 0; k < kMostTrims && watch.may_go_on(); ++k) {
    const ProgressShare share = ProgressShare::next_of_many(watch, k);
    FairedSeries out = attempt(series, lower_bound, loose, watch);
    out.loose = loose;
    meant = std::max(meant, out.primitives);
    out.given_up = meant - out.primitives;
    const bool broken_off = !out.feasible && !watch.may_go_on();
    if (out.feasible || (out.primitives == 0 && !broken_off)) return out;
    if (out.primitives == 0) break;
    loose.push_back(*nearest_primitive_end(out, out.trouble));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> nearest_primitive_end(const FairedSeries& faired, std::size_t node) {
  std::optional<std::size_t> best;
  std::size_t least = 0;
  for (std::size_t k = 0; k < faired.direction.size(); ++k) {
    if (faired.direction[k] != 0) continue;
    for (const std::size_t end : {k, (k + 1) % faired.source.size()}) {
      const std::size_t away = end > node ? end - node : node - end;
      if (!faired.source[end] || (best && away >= least)) continue;
      best = faired.source[end];
      least = away;
    }
  }
  return best;
}

FairedSeries fair(const MeasuredSeries& series, Watch& watch) {
  const int lower_bound = forced_vertices(series.points, series.reach, series.closed, watch);
  int meant = 0;
  if (series.primitives) {
    if (auto out = keep_primitives(series, lower_bound, watch, meant)) return std::move(*out);
  }
  MeasuredSeries without = series;
  without.primitives = false;
  FairedSeries out = attempt(without, lower_bound, {}, watch);
  out.given_up = meant;
  return out;
}

}  // namespace obvid
