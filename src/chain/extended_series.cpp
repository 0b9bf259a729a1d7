// SPDX-License-Identifier: Apache-2.0
#include "extended_series.h"

#include <utility>

namespace obvid::chain_detail {
namespace {

/// A link whose closed-form margin is below this gets a free element: two pieces carry it with
/// room to spare instead of one at its limit.
constexpr double kThinMargin = 0.02;

}  // namespace

Extended with_free_elements(const Extended& before, const ChainSolution& solution) {
  Extended out;
  out.least_sigma = before.least_sigma;
  out.problem.least_change = before.problem.least_change;
  const std::size_t n = before.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    out.points.push_back(before.points[i]);
    out.start.push_back(solution.elements[i]);
    out.source.push_back(before.source[i]);
    out.problem.nodes.push_back(before.problem.nodes[i]);
    if (i + 1 == n) break;
    const std::int8_t direction = before.problem.direction[i];
    const Cone cone = direction == 0 ? Cone::kNone : Cone::kClosedForm;
    out.problem.direction.push_back(direction);
    out.problem.cone.push_back(cone);
    const LinkState& link = solution.links[i];
    if (cone == Cone::kNone || cone_margin(link, direction, cone) >= kThinMargin) continue;
    const Element e = free_element(link, direction, before.points[i]);
    out.points.push_back(e.point);
    out.start.push_back(e);
    out.source.emplace_back(std::nullopt);
    out.problem.nodes.emplace_back();
    out.problem.direction.push_back(direction);
    out.problem.cone.push_back(cone);
  }
  out.turned.assign(out.problem.direction.size(), false);
  out.problem.chords = measure_chords(out.points);
  out.problem.circles = measure_circles(out.points, out.problem.chords);
  return out;
}

Extended slice(const Extended& series, std::size_t from, std::size_t to) {
  const auto part = [&](const auto& all, std::size_t extra) {
    return std::vector(all.begin() + static_cast<std::ptrdiff_t>(from),
                       all.begin() + static_cast<std::ptrdiff_t>(to + extra));
  };
  const ChainProblem& p = series.problem;
  Extended out;
  out.least_sigma = series.least_sigma;
  out.points = part(series.points, 1);
  out.source = part(series.source, 1);
  out.problem = {part(p.chords, 0), part(p.circles, 1), part(p.direction, 0),
                 part(p.cone, 0),   part(p.nodes, 1),   p.least_change};
  out.turned = part(series.turned, 0);
  for (Cone& c : out.problem.cone) c = c == Cone::kNone ? c : Cone::kSpiral;
  return out;
}

std::optional<std::size_t> leaping_link(const ChainProblem& problem, const ChainSolution& s,
                                        double least) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < s.links.size(); ++i) {
    if (problem.cone[i] == Cone::kNone) continue;
    const double ratio = s.links[i].sigma / (s.links[i].B - s.links[i].A);
    if (ratio >= least) continue;
    least = ratio;
    worst = i;
  }
  return worst;
}

bool carried(const ChainProblem& problem, const ChainSolution& s, double least_sigma) {
  return s.feasible && s.smallest_margin > 0.0 && !leaping_link(problem, s, least_sigma);
}

SeriesChain collect(const Extended& e, ChainSolution solution, int steps) {
  SeriesChain out;
  out.elements = std::move(solution.elements);
  out.links = std::move(solution.links);
  out.source = e.source;
  out.direction = e.problem.direction;
  out.cone = e.problem.cone;
  out.nodes = e.problem.nodes;
  out.newton_steps = steps;
  out.smallest_margin = solution.smallest_margin;
  out.converged = solution.converged;
  for (const auto& s : out.source) out.free_elements += s ? 0U : 1U;
  return out;
}

}  // namespace obvid::chain_detail
