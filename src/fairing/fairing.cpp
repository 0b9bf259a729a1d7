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

Element element_at(const Tube& tube, const State& x, std::size_t i) {
  const TubeNode& n = tube.nodes[i];
  const double* v = &x[kPerNode * i];
  return {tube.origin + n.point + v[0] * n.reach * n.normal, n.theta + v[1],
          n.kappa + v[2] / n.length};
}

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

FairedSeries fair(const MeasuredSeries& series, const Progress& progress) {
  const auto tell = [&](double done) {
    if (progress) progress("searching runs", done);
  };
  FairedSeries out;
  SmoothTube smooth = build_tube(series);
  tell(0.1);
  out.vertices_lower_bound = forced_vertices(series);
  RunSearch search(smooth.tube, smooth.state);
  const Runs runs = search.search(out.vertices_lower_bound);
  tell(0.6);
  out.newton_steps = smooth.newton_steps + search.newton_steps();
  LaidTube laid = lay_out(smooth.tube, smooth.state, {0, smooth.tube.links()}, runs.layout);
  out.feasible = runs.feasible && make_fair(laid, out.newton_steps);
  out.direction = laid.direction;
  out.vertices = runs.vertices;
  out.trouble = smooth.source[runs.trouble];
  for (std::size_t i = 0; i < laid.tube.nodes.size(); ++i) {
    out.elements.push_back(element_at(laid.tube, laid.start, i));
    out.source.push_back(laid.node[i] ? std::optional(smooth.source[*laid.node[i]]) : std::nullopt);
  }
  tell(1.0);
  return out;
}

}  // namespace obvid
