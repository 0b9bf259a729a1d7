// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "extended_series.h"

namespace obvid::chain_detail {

/// A vertex between a circular stretch and its neighbour: where the neighbour cannot lead into the
/// stretch monotonically, the curvature is let pass it and come back inside the link.
class TransitionVertex {
 public:
  /// Inserts one beside the first stretch that the infeasibility touches and that has none yet on
  /// that side. False when there is no such place.
  static bool insert(Extended& series, const Infeasibility& why, Watch& watch) {
    const std::vector<Cone>& cone = series.problem.cone;
    const std::size_t first = why.first_point >= kReach ? why.first_point - kReach : 0;
    const std::size_t last = std::min(cone.size() - 1, why.last_point + kReach);
    for (std::size_t i = first; i < last; ++i) {
      const bool enters = cone[i] != Cone::kNone && cone[i + 1] == Cone::kNone;
      const bool leaves = cone[i] == Cone::kNone && cone[i + 1] != Cone::kNone;
      if (enters && series.source[i] && series.source[i + 1])
        return insert_into(series, i, true, watch);
      if (leaves && series.source[i + 1] && series.source[i + 2]) {
        return insert_into(series, i + 1, false, watch);
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t kReach = 3;  // links between the infeasible ones and the stretch

  /// Place for the vertex: over part `along` of the chord, at part `height` of the cubic whose ends
  /// have the tangents of the stretch and of the adjacent circle.
  static Vec2 place(const Extended& s, std::size_t link, double along, double height) {
    const Chord& chord = s.problem.chords[link];
    const auto tangent = [&](std::size_t node, double of_circle) {
      const double theta = s.problem.nodes[node].theta.value_or(chord.omega + of_circle);
      return chord.length * unit_at(theta - chord.omega);
    };
    const Vec2 t0 = tangent(link, -s.problem.circles[link].eta_out);
    const Vec2 t1 = tangent(link + 1, s.problem.circles[link + 1].eta_in);
    const double u = along, v = 1.0 - along;
    const double y = u * v * v * t0.y - u * u * v * t1.y;  // Hermite cubic over the chord
    return s.points[link] + complex_product({u * chord.length, height * y}, unit_at(chord.omega));
  }

  /// The place whose neighbourhood is feasible with the widest margin, else comes closest.
  static Vec2 best_place(const Extended& series, std::size_t link, bool before_stretch,
                         Watch& watch) {
    const std::size_t from = link >= kWindow ? link - kWindow : 0;
    const std::size_t to = std::min(series.problem.direction.size(), link + 1 + kWindow);
    const Extended window = slice(series, from, to);
    Vec2 best{};
    double best_score = -std::numeric_limits<double>::infinity();
    for (const double along : {0.25, 0.5, 0.75}) {
      for (const double height : {0.3, 0.5, 0.7, 0.85, 1.0, 1.15}) {
        const Vec2 point = place(series, link, along, height);
        Extended candidate = window;
        insert_at(candidate, link - from, before_stretch, point);
        const ChainSolution s = solve_chain(candidate.points, candidate.problem, watched(watch));
        const double score = s.feasible ? s.smallest_margin : -s.infeasibility.slack;
        if (score <= best_score) continue;
        best_score = score;
        best = point;
      }
    }
    return best;
  }

  static bool insert_into(Extended& s, std::size_t link, bool before_stretch, Watch& watch) {
    insert_at(s, link, before_stretch, best_place(s, link, before_stretch, watch));
    return true;
  }

  static void insert_at(Extended& s, std::size_t link, bool before_stretch, Vec2 point) {
    const auto at = [](auto& v, std::size_t i) {
      return v.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const std::size_t fixed = before_stretch ? link + 1 : link;
    const double kappa = *s.problem.nodes[fixed].kappa;
    s.points.insert(at(s.points, link + 1), point);
    s.source.insert(at(s.source, link + 1), std::nullopt);
    s.problem.nodes.insert(at(s.problem.nodes, link + 1), NodeData{});
    s.problem.cone.insert(at(s.problem.cone, link), s.problem.cone[link]);
    s.turned.insert(at(s.turned, link), false);
    s.problem.chords = measure_chords(s.points);
    s.problem.circles = measure_circles(s.points, s.problem.chords);
    // the half beside the stretch leads to its curvature, the other half the way back
    const double over = s.problem.circles[link + 1].kappa - kappa;
    const auto beside = static_cast<std::int8_t>((over > 0.0) == before_stretch ? -1 : 1);
    const auto away = static_cast<std::int8_t>(-beside);
    s.problem.direction[link] = before_stretch ? away : beside;
    s.problem.direction.insert(at(s.problem.direction, link + 1), before_stretch ? beside : away);
  }
};

}  // namespace obvid::chain_detail
