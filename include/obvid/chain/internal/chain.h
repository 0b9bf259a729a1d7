// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/geom/element.h"
#include "obvid/series/analysis.h"

namespace obvid {

/// Which curves must exist over a link.
enum class Cone : std::uint8_t {
  kNone,        ///< no condition: the link is carried by a given circle or line
  kSpiral,      ///< some spiral exists (Kurnosenko): -A B > sin^2(sigma/2)
  kClosedForm,  ///< one Moebius image of a hyperbola: -A B > sin^2(sigma) / (2 cos(sigma))
};

/// Data given at a node beyond its point. Unset values are the chain's to choose.
struct NodeData {
  std::optional<double> theta;  ///< heading, rad, modulo a full turn
  std::optional<double> kappa;  ///< signed curvature, 1/unit
  int curvature_sign = 0;       ///< +1 or -1: the curvature must keep this sign
};

/// Headings and curvatures wanted at every point, with one direction and one cone per link.
struct ChainProblem {
  std::vector<Chord> chords;            ///< n - 1
  std::vector<AdjacentCircle> circles;  ///< n
  std::vector<std::int8_t> direction;   ///< n - 1; 0 exactly where the cone is kNone
  std::vector<Cone> cone;               ///< n - 1
  std::vector<NodeData> nodes;          ///< n
  /// Energy: the integral of (d kappa / d s)^2, instead of the change of curvature in units of what
  /// the adjacent circles of each link show.
  bool least_change = false;
};

/// A link between two elements, seen from its chord. `A`, `B` are the distances of the end
/// curvatures from the circles through both points ([Kurnosenko 2013]), kept to full relative
/// precision even where the curve is nearly a circle.
struct LinkState {
  double h = 0.0;      ///< chord
  double omega = 0.0;  ///< heading of the chord
  double alpha = 0.0;  ///< heading at the start minus omega
  double beta = 0.0;   ///< heading at the end minus omega
  double A = 0.0;      ///< kappa_start h/2 + sin(alpha)
  double B = 0.0;      ///< kappa_end h/2 - sin(beta)
  double sigma = 0.0;  ///< alpha + beta
};

/// How far a link lies inside its cone: 1 - c^2 sin^2(sigma/2) / (-A B), in (-inf, 1];
/// positive inside. Values with the wrong sign of A, B or sigma give -infinity.
[[nodiscard]] double cone_margin(const LinkState& link, int direction, Cone cone);

/// Why a chain has no solution: the links that cannot be satisfied together.
struct Infeasibility {
  std::size_t first_point = 0;
  std::size_t last_point = 0;
  double slack = 0.0;  ///< how far the worst link stays outside, relative to its own size
  double move = 0.0;   ///< estimate of the move of a point that would make it feasible, units
};

/// Headings and curvatures with their evidence.
struct ChainSolution {
  bool feasible = false;
  std::vector<Element> elements;  ///< n; meaningful when feasible
  std::vector<LinkState> links;   ///< n - 1
  double smallest_margin = 0.0;   ///< over all links, by their own cones
  int newton_steps = 0;
  bool converged = false;       ///< Newton's decrement fell below rounding
  Infeasibility infeasibility;  ///< when not feasible
};

/// Limits of the interior-point method.
struct ChainOptions {
  int largest_steps = 200;  ///< Newton steps altogether
  Watch* watch = nullptr;   ///< each Newton step is work of one unit per node
};

/// Solves the chain: the fairest headings and curvatures inside all cones, by a barrier method
/// with exact angles; block-tridiagonal Newton, O(n) per step (docs/methods/chain.md).
/// `points` gives positions of the nodes. Deterministic; scale- and motion-invariant.
/// `start`, when given, holds headings and curvatures to begin with (they may be infeasible).
[[nodiscard]] ChainSolution solve_chain(const std::vector<Vec2>& points,
                                        const ChainProblem& problem,
                                        const ChainOptions& options = {},
                                        const std::vector<Element>* start = nullptr);

/// The same outcome for given headings and curvatures, as they are: `feasible` says whether they
/// lie inside all cones.
[[nodiscard]] ChainSolution judge_chain(const std::vector<Vec2>& points,
                                        const ChainProblem& problem,
                                        const std::vector<Element>& elements);

}  // namespace obvid
