// SPDX-License-Identifier: Apache-2.0
#include "fit/series_ranges.h"

#include <algorithm>
#include <cmath>

#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/value_range.h"

namespace obvid::pipeline_detail {
namespace {

/// Heading of the adjacent circle, unwrapped like the chords; at the ends that of the chord.
double heading_along(const Analysis& a, std::size_t i) {
  if (i == 0) return a.chords.front().omega;
  if (i == a.chords.size()) return a.chords.back().omega;
  return a.chords[i - 1].omega + a.circles[i].eta_in;
}

/// The series as its ranges see it.
struct RangeProblem {
  std::vector<RangeLink> links;
  std::vector<RangeNode> nodes;
};

RangeProblem range_problem(const Analysis& analysis, const ChainProblem& problem,
                           const std::vector<FixedData>& fixed) {
  RangeProblem out;
  for (std::size_t i = 0; i < analysis.chords.size(); ++i) {
    const Chord& chord = analysis.chords[i];
    out.links.push_back({chord.length, chord.omega, analysis.direction[i]});
  }
  for (std::size_t i = 0; i < problem.nodes.size(); ++i) {
    const NodeData& node = problem.nodes[i];
    out.nodes.push_back({node.theta, node.kappa, node.curvature_sign});
    const double along = heading_along(analysis, i);
    if (node.theta) out.nodes.back().theta = nearest_angle(*node.theta, along);
    if (i >= fixed.size()) continue;
    out.nodes.back().kappas = fixed[i].kappas;
    if (fixed[i].thetas) out.nodes.back().thetas = turned_near(*fixed[i].thetas, along);
  }
  return out;
}

constexpr double kLeastCurvatureAccuracy = 1e-3;  // of the curvature
constexpr int kMostCurvatureSteps = 60;
/// Points of a loop that are looked at beyond its seam, on both sides.
constexpr std::size_t kLoopOverlap = 16;

/// Whether all nodes can keep below a curvature.
bool cap_curvatures(std::vector<RangeNode>& nodes, double most) {
  for (RangeNode& node : nodes) {
    node.kappas = common(node.kappas.value_or(ValueRange{}), ValueRange{-most, most});
    if (node.kappas->empty() || (node.kappa && std::abs(*node.kappa) > most)) return false;
  }
  return true;
}

/// The least value for which something is possible, from one that may not be large enough. What
/// is not possible without a limit has none.
template <class Possible>
std::optional<double> least_possible(double high, const Possible& possible) {
  if (!possible(std::numeric_limits<double>::infinity())) return std::nullopt;
  for (int k = 0; !(high > 0.0 && possible(high)); ++k, high *= 2.0) {
    if (k == kMostCurvatureSteps || high == 0.0) return std::nullopt;
  }
  double low = 0.0;
  for (int k = 0; k < kMostCurvatureSteps && high - low > kLeastCurvatureAccuracy * high; ++k) {
    const double middle = 0.5 * (low + high);
    (possible(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

Result<LoopProblem> loop_problem(const std::vector<Vec2>& points,
                                 const ChainConstraints& constraints) {
  const std::size_t n = points.size(), overlap = std::min(n, kLoopOverlap);
  std::vector<Vec2> unrolled;
  ChainConstraints all = constraints;
  all.fixed.clear();
  for (std::size_t k = 0; k < n + 2 * overlap + 1; ++k) {
    const std::size_t i = (k + n - overlap) % n;
    unrolled.push_back(points[i]);
    if (!constraints.fixed.empty()) all.fixed.push_back(constraints.fixed[i]);
  }
  const auto analysis = analyse(unrolled);
  OBVID_TRY(analysis);
  const auto problem = chain_problem(*analysis, all);
  OBVID_TRY(problem);
  const RangeProblem ranges = range_problem(*analysis, *problem, all.fixed);
  LoopProblem out;
  for (std::size_t k = overlap; k < overlap + n; ++k) {
    out.direction.push_back(analysis->direction[k]);
    out.nodes.push_back(problem->nodes[k]);
    out.adjacent_kappa.push_back(analysis->circles[k].kappa);
    out.links.push_back(ranges.links[k]);
    out.range_nodes.push_back(ranges.nodes[k]);
  }
  return out;
}

Result<std::vector<FeasibleData>> series_ranges(const Analysis& analysis,
                                                const ChainConstraints& constraints) {
  const auto problem = chain_problem(analysis, constraints);
  OBVID_TRY(problem);
  const RangeProblem ranges = range_problem(analysis, *problem, constraints.fixed);
  return feasible_data(ranges.links, ranges.nodes);
}

std::optional<double> least_largest_curvature(const Analysis& analysis,
                                              const ChainConstraints& constraints, Watch& watch) {
  const bool one_circle = std::all_of(analysis.direction.begin(), analysis.direction.end(),
                                      [](std::int8_t d) { return d == 0; });
  if (one_circle) {
    // the points do not say which way the curvature changes
    std::optional<double> least;
    for (const std::int8_t direction : {std::int8_t{1}, std::int8_t{-1}}) {
      Analysis one_way = analysis;
      one_way.stretches.clear();
      one_way.direction.assign(one_way.direction.size(), direction);
      const auto found = least_largest_curvature(one_way, constraints, watch);
      if (found && (!least || *found < *least)) least = found;
    }
    return least;
  }
  const auto problem = chain_problem(analysis, constraints);
  if (!problem) return std::nullopt;
  const auto possible = [&](double most) {
    RangeProblem ranges = range_problem(analysis, *problem, constraints.fixed);
    return cap_curvatures(ranges.nodes, most) &&
           central_data(ranges.links, ranges.nodes, {}, ChoiceOrder::kAlong,
                        SharpCurvature::kMiddle, &watch)
               .has_value();
  };
  double high = 0.0;
  for (const AdjacentCircle& circle : analysis.circles) {
    high = std::max(high, std::abs(circle.kappa));
  }
  // two points have no adjacent circle
  const bool points_alone_straight = !(high > 0.0);
  for (const Chord& chord : analysis.chords) {
    if (points_alone_straight && chord.length > 0.0) high = std::max(high, 1.0 / chord.length);
  }
  return least_possible(high, possible);
}

std::optional<double> least_largest_curvature_of_loop(const std::vector<Vec2>& points,
                                                      const ChainConstraints& constraints,
                                                      Watch& watch) {
  const auto problem = loop_problem(points, constraints);
  if (!problem) return std::nullopt;
  double high = 0.0;
  for (const double kappa : problem->adjacent_kappa) high = std::max(high, std::abs(kappa));
  return least_possible(high, [&](double most) {
    std::vector<RangeNode> nodes = problem->range_nodes;
    return cap_curvatures(nodes, most) && loop_closes(problem->links, nodes, &watch);
  });
}

std::optional<SeriesChain> central_chain(const std::vector<Vec2>& points, const Analysis& analysis,
                                         const ChainConstraints& constraints, ChoiceOrder order,
                                         Watch& watch) {
  const auto problem = chain_problem(analysis, constraints);
  if (!problem) return std::nullopt;
  const RangeProblem ranges = range_problem(analysis, *problem, constraints.fixed);
  const auto central =
      central_data(ranges.links, ranges.nodes, {}, order, SharpCurvature::kMiddle, &watch);
  if (!central) return std::nullopt;
  DirectedSeries series;
  series.points = points;
  series.direction = analysis.direction;
  series.nodes = problem->nodes;
  series.to_the_edge = constraints.to_the_edge;
  for (std::size_t i = 0; i < points.size(); ++i) {
    series.source.emplace_back(i);
    series.start.push_back({points[i], *(*central)[i].theta, *(*central)[i].kappa});
  }
  auto chain = follow_directions(std::move(series), watch);
  if (!chain) return std::nullopt;
  return std::move(*chain);
}

std::optional<SeriesChain> central_chain_of_loop(const std::vector<Vec2>& points,
                                                 const ChainConstraints& constraints,
                                                 Watch& watch) {
  const auto problem = loop_problem(points, constraints);
  if (!problem) return std::nullopt;
  const auto central = central_loop(problem->links, problem->range_nodes, {}, &watch);
  if (!central) return std::nullopt;
  DirectedSeries series;
  series.direction = problem->direction;
  series.to_the_edge = constraints.to_the_edge;
  for (std::size_t k = 0; k <= points.size(); ++k) {
    const std::size_t i = k % points.size();
    const RangeNode& node = (*central)[k];
    series.points.push_back(points[i]);
    series.source.emplace_back(i);
    series.start.push_back({points[i], *node.theta, *node.kappa});
    series.nodes.push_back(problem->nodes[i]);
    if (i == 0) {  // one element at both ends
      series.nodes.back().theta = *node.theta;
      series.nodes.back().kappa = *node.kappa;
    }
  }
  auto chain = follow_directions(std::move(series), watch);
  if (!chain) return std::nullopt;
  return std::move(*chain);
}

}  // namespace obvid::pipeline_detail
