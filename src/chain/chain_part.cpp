// SPDX-License-Identifier: Apache-2.0
#include "obvid/chain/internal/chain_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "extended_series.h"
#include "part_window.h"

namespace obvid {
namespace {

using namespace chain_detail;

/// Nodes with all data fixed on either side of the free ones: beyond them the weights of the links
/// at the ends of a series differ from those in its middle.
constexpr std::size_t kHeldNodes = 4;
/// Further points, for the circles of these.
constexpr std::size_t kContext = 2;

/// The part of a series in which a neighbourhood is solved.
class MovedPart {
 public:
  MovedPart(const std::vector<Vec2>& points, std::size_t moved, const PartWindow& window,
            const SeriesChain& chain)
      : chain_(chain),
        moved_(moved),
        window_(window),
        slice_(window.widened(kHeldNodes + kContext)) {
    for (std::size_t i = slice_.first; i <= slice_.last; ++i) {
      points_.push_back(points[i % points.size()]);
    }
  }

  /// Elements of the slice, or nothing.
  std::optional<ChainSolution> solve(Watch& watch) {
    const auto analysis = analyse(points_);
    if (!analysis || !analysis->stretches.empty()) return std::nullopt;
    auto problem = chain_problem(*analysis, {});
    if (!problem || !keep_directions(*problem)) return std::nullopt;
    std::vector<Element> start(chain_.elements.begin() + at(slice_.first),
                               chain_.elements.begin() + at(slice_.last) + 1);
    for (std::size_t k = 0; k < start.size(); ++k) {
      start[k].point = points_[k];
      if (window_.has(slice_.first + k)) continue;
      problem->nodes[k].theta = start[k].theta;
      problem->nodes[k].kappa = start[k].kappa;
    }
    ChainSolution solution = solve_chain(points_, *problem, watched(watch), &start);
    const double least_sigma = Extended{}.least_sigma;
    if (!solution.converged || !carried(*problem, solution, least_sigma)) return std::nullopt;
    directions_ = std::move(problem->direction);
    nodes_ = std::move(problem->nodes);
    return solution;
  }

  [[nodiscard]] const PartWindow& slice() const { return slice_; }
  [[nodiscard]] std::int8_t direction(std::size_t link) const {
    return directions_[link - slice_.first];
  }
  [[nodiscard]] const NodeData& node(std::size_t i) const { return nodes_[i - slice_.first]; }

 private:
  static std::ptrdiff_t at(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  /// Directions change beside the moved point only: at the ends of the slice they are unknown, and
  /// taken as they were. False where any is another.
  bool keep_directions(ChainProblem& problem) const {
    for (std::size_t k = 0; k < problem.direction.size(); ++k) {
      const std::size_t link = slice_.first + k;
      const bool beside = link + 3 > moved_ && link < moved_ + 3;
      if (problem.cone[k] == Cone::kNone) return false;
      if (beside || problem.direction[k] == chain_.direction[link]) continue;
      const bool cut = (!slice_.from_start && k < kContext) ||
                       (!slice_.to_end && k + kContext >= problem.direction.size());
      if (!cut) return false;
      problem.direction[k] = chain_.direction[link];
    }
    return true;
  }

  const SeriesChain& chain_;
  std::size_t moved_;
  PartWindow window_, slice_;
  std::vector<Vec2> points_;
  std::vector<std::int8_t> directions_;
  std::vector<NodeData> nodes_;
};

bool one_element_to_a_point(const SeriesChain& chain, std::size_t points) {
  if (chain.free_elements > 0 || chain.turned_directions > 0 || chain.unforced_inflection ||
      !chain.converged) {
    return false;
  }
  for (std::size_t i = 0; i < chain.source.size(); ++i) {
    if (chain.source[i] != i % points) return false;
    if (i < chain.cone.size() && chain.cone[i] != Cone::kClosedForm) return false;
    const NodeData* given = i < chain.nodes.size() ? &chain.nodes[i] : nullptr;
    const bool end = i == 0 || i + 1 == chain.source.size();
    if (given != nullptr && !end && (given->theta || given->kappa)) return false;
  }
  return true;
}

}  // namespace

SeriesChain slice_of(const SeriesChain& chain, std::size_t first, std::size_t last) {
  SeriesChain out;
  const auto cut = [&](const auto& all, auto& into, std::size_t more) {
    if (all.empty()) return;
    into.assign(all.begin() + static_cast<std::ptrdiff_t>(first),
                all.begin() + static_cast<std::ptrdiff_t>(last + more));
  };
  cut(chain.elements, out.elements, 1);
  cut(chain.source, out.source, 1);
  cut(chain.nodes, out.nodes, 1);
  cut(chain.links, out.links, 0);
  cut(chain.direction, out.direction, 0);
  cut(chain.cone, out.cone, 0);
  cut(chain.form, out.form, 0);
  cut(chain.slope_step, out.slope_step, 1);
  out.smooth = chain.smooth;
  return out;
}

std::optional<ChangedElements> follow_moved_point(const std::vector<Vec2>& points,
                                                  std::size_t moved, bool loop, SeriesChain& chain,
                                                  Watch& watch) {
  if (!one_element_to_a_point(chain, points.size())) return std::nullopt;
  const std::size_t last = chain.elements.size() - 1;
  for (std::size_t half = kFirstHalfWidth;; half *= 2) {
    const auto window = PartWindow::around(moved, moved, half, kHeldNodes + kContext, last, loop);
    if (!window || watch.was_cancelled()) return std::nullopt;
    MovedPart part(points, moved, *window, chain);
    auto solved = part.solve(watch);
    if (!solved) return std::nullopt;
    const PartWindow& slice = part.slice();
    turn_to(chain.elements, slice, *solved);
    if (!settled(chain.elements, *window, slice, *solved)) continue;
    for (std::size_t i = window->first; i <= window->last; ++i) {
      chain.elements[i] = solved->elements[i - slice.first];
      if (!loop && !chain.nodes.empty()) chain.nodes[i] = part.node(i);
    }
    for (std::size_t i = slice.first; i < slice.last; ++i) {
      const bool changed = window->has(i) || window->has(i + 1);
      if (!changed) continue;
      chain.links[i] = solved->links[i - slice.first];
      chain.direction[i] = part.direction(i);
    }
    return ChangedElements{window->first, window->last};
  }
}

}  // namespace obvid
