// SPDX-License-Identifier: Apache-2.0
#include "obvid/chain/internal/series_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "direction_repair.h"
#include "extended_series.h"
#include "set_up.h"
#include "transition_vertex.h"

namespace obvid {
namespace {

using namespace chain_detail;

/// Rounds of inserting free elements; each starts inside all cones, so one normally suffices.
constexpr int kInsertionRounds = 4;

/// Where somebody asked for the edge of what there is, a link's sigma may be this part of B - A.
/// Below the usual least one (`Extended`) the curvature leaps at both its ends and stays put
/// between them: formally monotone, of no use to anybody who did not ask for it, and soon beyond
/// proof.
constexpr double kLeastSigmaAtEdge = 1e-5;
/// The same where nothing else is left: many such curves are proved all the same. Below this,
/// rounding of coordinates and headings takes the place of sigma.
constexpr double kLeastSigmaOfAll = 1e-9;

/// Elements for given directions, or why there are none.
struct Attempt {
  std::optional<SeriesChain> chain;
  Infeasibility why;
  int steps = 0;
};

Attempt refuse(Infeasibility why, int steps) { return {std::nullopt, why, steps}; }

Infeasibility blame(std::size_t link) { return {link, link + 1, 0.0, 0.0}; }

Attempt insert_and_solve(Extended current, ChainSolution solution, int steps, Watch& watch) {
  const double least = current.least_sigma;
  for (int round = 0; round < kInsertionRounds; ++round) {
    current = with_free_elements(current, solution);
    solution = solve_chain(current.points, current.problem, watched(watch), &current.start);
    steps += solution.newton_steps;
    if (carried(current.problem, solution, least)) {
      return {collect(current, std::move(solution), steps), {}, steps};
    }
    if (!solution.feasible) return refuse(solution.infeasibility, steps);
    if (const auto link = leaping_link(current.problem, solution, least)) {
      std::size_t point = 0;  // of the series, before the link
      for (std::size_t i = 0; i <= *link; ++i) point = current.source[i].value_or(point);
      return refuse(blame(point), steps);
    }
  }
  return refuse(blame(0), steps);
}

/// Closed-form cones first; then mere existence and free elements; then without the demand that the
/// curvature keep its sign, which can turn out to be impossible.
Attempt attempt(Extended current, bool convex, Watch& watch) {
  const std::vector<Element> given = current.start;
  const std::vector<Element>* start = given.empty() ? nullptr : &given;
  ChainSolution solution = solve_chain(current.points, current.problem, watched(watch), start);
  int steps = solution.newton_steps;
  const double least = current.least_sigma;
  if (carried(current.problem, solution, least)) {
    return {collect(current, std::move(solution), steps), {}, steps};
  }
  // where one piece to a link would have to leap, two may not
  const auto leaping =
      solution.feasible ? leaping_link(current.problem, solution, least) : std::nullopt;
  for (Cone& c : current.problem.cone) c = c == Cone::kNone ? c : Cone::kSpiral;
  solution = solve_chain(current.points, current.problem, watched(watch), start);
  steps += solution.newton_steps;
  bool unforced_inflection = false;
  if (!solution.feasible && !convex) {
    const Infeasibility with_signs = solution.infeasibility;
    for (NodeData& node : current.problem.nodes) node.curvature_sign = 0;
    solution = solve_chain(current.points, current.problem, watched(watch));
    steps += solution.newton_steps;
    unforced_inflection = solution.feasible;
    if (!solution.feasible) solution.infeasibility = with_signs;
  }
  if (!solution.feasible) return refuse(solution.infeasibility, steps);
  Attempt out = insert_and_solve(std::move(current), std::move(solution), steps, watch);
  if (!out.chain && leaping) out.why = blame(*leaping);
  if (out.chain) out.chain->unforced_inflection = unforced_inflection;
  return out;
}

/// Whether the points alone have a solution, so that it is the constraints which have none. Then no
/// direction is turned: further vertices are not what somebody who fixes a radius asks for.
bool fulfilled_without(const ChainConstraints& constraints, const Analysis& analysis,
                       Extended series, Watch& watch) {
  if (!anything_constrained(constraints)) return false;
  auto problem = chain_problem(analysis, {});
  if (!problem) return false;
  series.problem = std::move(*problem);
  return attempt(std::move(series), false, watch).chain.has_value();
}

/// Directions that may be turned. Every turn costs a solution of the whole chain: so many steps on
/// every point are spent on them, a few more where there are few points, and no more where there
/// are very many.
constexpr int kMostTurns = 100;
constexpr double kRepairSteps = 10000.0, kRepairWork = 1e6;
constexpr std::size_t kMostRepairedPoints = 5000;

double repair_work(std::size_t points) {
  return kRepairWork + kRepairSteps * static_cast<double>(std::min(points, kMostRepairedPoints));
}

}  // namespace

Result<SeriesChain> choose_elements(const std::vector<Vec2>& points, const Analysis& analysis,
                                    const ChainConstraints& constraints, Watch& watch) {
  auto problem = chain_problem(analysis, constraints);
  OBVID_TRY(problem);
  Extended current;
  current.points = points;
  current.problem = std::move(*problem);
  if (constraints.to_the_edge) current.least_sigma = kLeastSigmaAtEdge;
  for (std::size_t i = 0; i < points.size(); ++i) current.source.emplace_back(i);

  current.turned.assign(current.problem.direction.size(), false);
  Attempt tried = attempt(current, constraints.convex, watch);
  if (!tried.chain && fulfilled_without(constraints, analysis, current, watch)) {
    return fail(explain(points, analysis, constraints, tried.why));
  }
  const Infeasibility first_reason = tried.why;
  int steps = tried.steps;
  std::size_t turned = 0;
  const Allowance allowance(watch, repair_work(points.size()));
  for (int round = 0; !tried.chain && round < kMostTurns && watch.may_go_on(); ++round) {
    if (!TransitionVertex::insert(current, tried.why, watch)) {
      const auto link = DirectionRepair(current, watch).choose(tried.why);
      if (!link) break;
      current.turned[*link] = true;
      std::int8_t& direction = current.problem.direction[*link];
      direction = static_cast<std::int8_t>(-direction);
    }
    ++turned;
    tried = attempt(current, constraints.convex, watch);
    steps += tried.steps;
  }
  if (!tried.chain) {
    Error error = explain(points, analysis, constraints, first_reason);
    if (!watch.may_go_on()) error.hint += "; the search for other directions ended at its limit";
    return fail(std::move(error));
  }
  tried.chain->newton_steps = steps;
  tried.chain->turned_directions = turned;
  return std::move(*tried.chain);
}

namespace {

/// The given elements as they are, with free elements, whose heading and curvature alone are
/// chosen, in links that one piece cannot carry.
std::optional<SeriesChain> keep_elements(const Extended& given, Watch& watch) {
  ChainSolution solution = judge_chain(given.points, given.problem, given.start);
  const double least = given.least_sigma;
  if (carried(given.problem, solution, least)) return collect(given, std::move(solution), 0);
  Extended halved = with_free_elements(given, solution);
  std::vector<NodeData> nodes = halved.problem.nodes;  // as given, without what is held here
  for (std::size_t i = 0; i < halved.points.size(); ++i) {
    if (!halved.source[i]) continue;
    halved.problem.nodes[i].theta = halved.start[i].theta;
    halved.problem.nodes[i].kappa = halved.start[i].kappa;
  }
  solution = solve_chain(halved.points, halved.problem, watched(watch), &halved.start);
  const int steps = solution.newton_steps;
  // at the edge of what there is the search may leave the free elements that it began with
  if (!carried(halved.problem, solution, least)) {
    solution = judge_chain(halved.points, halved.problem, halved.start);
  }
  if (!carried(halved.problem, solution, least)) return std::nullopt;
  halved.problem.nodes = std::move(nodes);
  return collect(halved, std::move(solution), steps);
}

}  // namespace

Result<SeriesChain> follow_directions(DirectedSeries series, Watch& watch) {
  Extended e;
  e.problem.chords = measure_chords(series.points);
  e.problem.circles = measure_circles(series.points, e.problem.chords);
  for (const std::int8_t d : series.direction) {
    e.problem.cone.push_back(d == 0 ? Cone::kNone : Cone::kClosedForm);
  }
  e.problem.direction = std::move(series.direction);
  e.problem.nodes = std::move(series.nodes);
  e.points = std::move(series.points);
  e.start = std::move(series.start);
  e.source = std::move(series.source);
  e.turned.assign(e.problem.direction.size(), false);
  Infeasibility why;
  std::vector<double> least{e.least_sigma};
  if (series.to_the_edge) least = {kLeastSigmaAtEdge, kLeastSigmaOfAll};
  for (const double sigma : least) {
    e.least_sigma = sigma;
    if (auto kept = keep_elements(e, watch)) return std::move(*kept);
    Attempt tried = attempt(e, true, watch);
    if (tried.chain) return std::move(*tried.chain);
    why = tried.why;
  }
  return error(ErrorCode::kNoSpiral,
               "no curve with curvature changing as wanted runs through the nodes")
      .where("nodes " + std::to_string(why.first_point + 1) + " to " +
             std::to_string(why.last_point + 1))
      .points(why.first_point, why.last_point)
      .value(why.slack);
}

}  // namespace obvid
