// SPDX-License-Identifier: Apache-2.0
#include "fit/more_vertices.h"

#include <algorithm>
#include <string>
#include <utility>

#include "obvid/fairing/internal/exact_runs.h"

namespace obvid::pipeline_detail {
namespace {

/// Puts the links of a series together, part by part between circular stretches.
class Assembler {
 public:
  Assembler(const std::vector<Vec2>& points, const ChainProblem& problem, bool convex,
            bool with_room, Watch& watch)
      : points_(points), problem_(problem), convex_(convex), with_room_(with_room), watch_(watch) {}

  Result<SeriesChain> run() {
    const std::size_t links = problem_.direction.size();
    for (std::size_t i = 0; i < links;) {
      std::size_t j = i;
      const bool stretch = problem_.direction[i] == 0;
      while (j < links && (problem_.direction[j] == 0) == stretch) ++j;
      if (stretch) {
        for (; i < j; ++i) append(on_stretch(i), i, node(i), 0);
      } else
        OBVID_TRY(append_part(i, j));
      i = j;
    }
    append(last_, links, node(links), std::nullopt);
    assembled_ = true;
    auto chain = follow_directions(std::move(out_), watch_);
    if (!chain) return chain;
    chain->newton_steps += steps_;
    chain->turned_directions = changes(*chain);
    return chain;
  }

  /// Whether `run` had links for every part: what fails then are their limits.
  [[nodiscard]] bool assembled() const { return assembled_; }

 private:
  [[nodiscard]] NodeData node(std::size_t i) const {
    NodeData out = problem_.nodes[i];
    if (!convex_) out.curvature_sign = 0;
    return out;
  }

  [[nodiscard]] Element on_stretch(std::size_t i) {
    last_ = {points_[i + 1], *problem_.nodes[i + 1].theta, *problem_.nodes[i + 1].kappa};
    return {points_[i], *problem_.nodes[i].theta, *problem_.nodes[i].kappa};
  }

  void append(const Element& e, std::optional<std::size_t> source, const NodeData& data,
              std::optional<std::int8_t> direction) {
    out_.points.push_back(e.point);
    out_.start.push_back(e);
    out_.source.push_back(source);
    out_.nodes.push_back(data);
    if (direction) out_.direction.push_back(*direction);
  }

  Result<void> append_part(std::size_t first, std::size_t last) {
    ExactSeries part;
    part.with_room = with_room_;
    for (std::size_t i = first; i <= last; ++i) {
      part.points.push_back(points_[i]);
      part.nodes.push_back(node(i));
      if (i < last) part.direction.push_back(problem_.direction[i]);
    }
    const ExactRuns runs = exact_runs(part, watch_);
    steps_ += runs.newton_steps;
    if (!runs.feasible) {
      const std::size_t point = first + runs.trouble;
      return error(ErrorCode::kNoSpiral, "no curve was found, with vertices between points either")
          .where("point " + std::to_string(point + 1))
          .point(point);
    }
    for (std::size_t k = 0; k < runs.direction.size(); ++k) {
      const auto source = runs.source[k];
      append(runs.elements[k], source ? std::optional(first + *source) : std::nullopt,
             source ? node(first + *source) : NodeData{}, runs.direction[k]);
    }
    last_ = runs.elements.back();
    return {};
  }

  /// Links that run against their adjacent circles, and nodes that carry a vertex between points.
  [[nodiscard]] std::size_t changes(const SeriesChain& chain) const {
    std::size_t count = 0, link = 0;
    for (std::size_t k = 0; k < chain.direction.size(); ++k) {
      if (chain.source[k]) link = *chain.source[k];
      const bool turns = k > 0 && !chain.source[k] && chain.direction[k] != chain.direction[k - 1];
      const bool whole = chain.source[k] && chain.source[k + 1];
      if (turns || (whole && chain.direction[k] != problem_.direction[link])) ++count;
    }
    return count;
  }

  const std::vector<Vec2>& points_;
  const ChainProblem& problem_;
  bool convex_, with_room_;
  Watch& watch_;
  DirectedSeries out_;
  Element last_;
  int steps_ = 0;
  bool assembled_ = false;
};

int vertices_of(const SeriesChain& chain) {
  int count = 0, before = 0;
  for (const int d : chain.direction) {
    if (d == 0) continue;
    if (before != 0 && d != before) ++count;
    before = d;
  }
  return count;
}

Result<SeriesChain> attempt(const std::vector<Vec2>& points, const Analysis& analysis,
                            const ChainConstraints& constraints, Watch& watch) {
  const auto problem = chain_problem(analysis, constraints);
  OBVID_TRY(problem);
  Assembler usual(points, *problem, constraints.convex, false, watch);
  auto chain = usual.run();
  if (chain || !usual.assembled()) return chain;
  return Assembler(points, *problem, constraints.convex, true, watch).run();
}

/// The analysis without stretches of so few points; their links go the way of their neighbours.
Analysis without_short_stretches(Analysis a, std::size_t fewest) {
  std::vector<CircularStretch> kept;
  for (const CircularStretch& s : a.stretches) {
    if (s.last - s.first + 1 >= fewest) {
      kept.push_back(s);
      continue;
    }
    for (std::size_t i = s.first; i < s.last; ++i) {
      const bool grows = a.circles[i + 1].kappa >= a.circles[i].kappa;
      a.direction[i] = static_cast<std::int8_t>(grows ? 1 : -1);
    }
  }
  a.stretches = std::move(kept);
  return a;
}

}  // namespace

Result<SeriesChain> with_more_vertices(const std::vector<Vec2>& points, const Analysis& analysis,
                                       const ChainConstraints& constraints, Watch& watch) {
  constexpr std::size_t kFewestOnStretch = 5;  // points; four are the least that make a stretch
  auto chain = attempt(points, analysis, constraints, watch);
  const Analysis loose = without_short_stretches(analysis, kFewestOnStretch);
  if (loose.stretches.size() == analysis.stretches.size()) return chain;
  auto other = attempt(points, loose, constraints, watch);
  if (other && (!chain || vertices_of(*other) < vertices_of(*chain))) return other;
  return chain;
}

}  // namespace obvid::pipeline_detail
