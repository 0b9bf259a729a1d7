// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "extended_series.h"

namespace obvid::chain_detail {

/// Turns directions where no monotone curve exists although the adjacent circles allow one.
class DirectionRepair {
 public:
  DirectionRepair(const Extended& series, Watch& watch) : series_(series), watch_(watch) {}

  /// The link to turn for this infeasibility: one that makes its neighbourhood feasible, with as
  /// few vertices as possible; else the one that comes closest. Nothing when all were turned.
  [[nodiscard]] std::optional<std::size_t> choose(const Infeasibility& why) const {
    const ChainProblem& problem = series_.problem;
    const std::size_t links = problem.direction.size();
    const std::size_t first = why.first_point >= kReach ? why.first_point - kReach : 0;
    const std::size_t last = std::min({links, why.last_point + kReach, first + kMostCandidates});
    std::optional<std::size_t> best;
    Outcome least;
    for (std::size_t i = first; i < last && watch_.may_go_on(); ++i) {
      if (problem.direction[i] == 0 || series_.turned[i]) continue;
      const Outcome outcome = try_turn(problem, i, first, last);
      if (best && !outcome.better_than(least)) continue;
      best = i;
      least = outcome;
    }
    return best;
  }

 private:
  static constexpr std::size_t kReach = 2;            // links beyond the infeasible ones
  static constexpr std::size_t kMostCandidates = 24;  // links looked at for one turn

  struct Outcome {
    double slack = 0.0;  // 0: feasible
    int vertices = 0;
    [[nodiscard]] bool better_than(const Outcome& o) const {
      if ((slack == 0.0) != (o.slack == 0.0)) return slack == 0.0;
      if (slack == 0.0) return vertices < o.vertices;
      return slack < o.slack;
    }
  };

  /// Solves the neighbourhood alone with one direction turned.
  [[nodiscard]] Outcome try_turn(const ChainProblem& problem, std::size_t link, std::size_t first,
                                 std::size_t last) const {
    const std::size_t from = first >= kWindow ? first - kWindow : 0;
    const std::size_t to = std::min(problem.direction.size(), last + kWindow);
    Extended part = slice(series_, from, to);
    ChainProblem& window = part.problem;
    window.direction[link - from] = static_cast<std::int8_t>(-window.direction[link - from]);
    const ChainSolution s = solve_chain(part.points, window, watched(watch_));
    int vertices = 0;
    for (std::size_t i = 0; i + 1 < window.direction.size(); ++i) {
      vertices += window.direction[i] * window.direction[i + 1] < 0 ? 1 : 0;
    }
    return {s.feasible ? 0.0 : s.infeasibility.slack, vertices};
  }

  const Extended& series_;
  Watch& watch_;
};

}  // namespace obvid::chain_detail
