// SPDX-License-Identifier: Apache-2.0
#include "obvid/fairing/fairing.h"

#include <algorithm>
#include <utility>

#include "build_tube.h"
#include "forced_vertices.h"
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
bool make_fair(LaidTube& laid, int& steps) {
  for (const Cone cone : {Cone::kClosedForm, Cone::kSpiral}) {
    TubeModel model(laid.tube, laid.direction, cone, kFairEnergy);
    TubeSolver solver(model);
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

}  // namespace

int forced_vertices(const MeasuredSeries& series) {
  std::vector<Vec2> points = series.points;
  std::vector<double> reach = series.reach;
  if (series.closed) {  // windows across the seam
    constexpr std::size_t kOverlap = 3;
    for (std::size_t i = 0; i < kOverlap; ++i) {
      points.push_back(series.points[i]);
      reach.push_back(reach[i]);
    }
  }
  const int forced = fairing_detail::forced_vertices(points, reach);
  return series.closed ? forced + forced % 2 : forced;  // curvature returns: an even number
}

namespace {

/// Appends a node's elements: one, or both ends of a primitive with the exact piece between them.
void append_node(const LaidTube& laid, const SmoothTube& smooth, std::size_t i, FairedSeries& out) {
  const TubeNode& n = laid.tube.nodes[i];
  const double* x = &laid.start[kPerNode * i];
  const PlacedNode placed = place(n, x);
  const double theta = n.theta + x[1], kappa = placed.in.kappa;
  const auto node = laid.node[i];
  const Vec2 origin = laid.tube.origin;
  out.elements.push_back({origin + placed.in.position, theta - kappa * n.before, kappa});
  out.source.push_back(node ? std::optional(smooth.source[*node]) : std::nullopt);
  if (!n.is_primitive()) return;
  out.direction.push_back(0);
  out.elements.push_back({origin + placed.out.position, theta + kappa * n.after, kappa});
  out.source.emplace_back(smooth.last_source[*node]);
}

FairedSeries attempt(const MeasuredSeries& series, int lower_bound,
                     const std::vector<std::size_t>& unwanted, const Progress& progress) {
  const auto tell = [&](double done) {
    if (progress) progress("searching runs", done);
  };
  FairedSeries out;
  out.vertices_lower_bound = lower_bound;
  SmoothTube smooth = build_tube(series, unwanted);
  tell(0.1);
  RunSearch search(smooth.tube, smooth.state);
  const Runs runs = search.search(lower_bound);
  tell(0.6);
  out.newton_steps = smooth.newton_steps + search.newton_steps();
  LaidTube laid = lay_out(smooth.tube, smooth.state, {0, smooth.tube.links()}, runs.layout);
  out.feasible = runs.feasible && make_fair(laid, out.newton_steps);
  out.vertices = runs.vertices;
  out.trouble = smooth.source[runs.trouble];
  for (std::size_t i = 0; i < laid.tube.nodes.size(); ++i) {
    append_node(laid, smooth, i, out);
    if (i < laid.direction.size()) out.direction.push_back(laid.direction[i]);
    out.primitives += laid.tube.nodes[i].is_primitive() ? 1 : 0;
  }
  tell(1.0);
  return out;
}

/// Index of the first point of the primitive nearest to the trouble.
std::optional<std::size_t> nearest_primitive(const FairedSeries& faired) {
  std::optional<std::size_t> best;
  std::size_t least = 0;
  for (std::size_t k = 0; k < faired.direction.size(); ++k) {
    if (faired.direction[k] != 0) continue;
    const std::size_t first = *faired.source[k], last = *faired.source[k + 1];
    const auto away = [&](std::size_t i) {
      return i > faired.trouble ? i - faired.trouble : faired.trouble - i;
    };
    const std::size_t distance = std::min(away(first), away(last));
    if (best && distance >= least) continue;
    best = first;
    least = distance;
  }
  return best;
}

}  // namespace

FairedSeries fair(const MeasuredSeries& series, const Progress& progress) {
  const int lower_bound = forced_vertices(series);
  std::vector<std::size_t> unwanted;
  while (true) {
    FairedSeries out = attempt(series, lower_bound, unwanted, progress);
    if (out.feasible || out.primitives == 0) return out;
    // a primitive may leave no room for the transitions beside it
    unwanted.push_back(*nearest_primitive(out));
  }
}

}  // namespace obvid
