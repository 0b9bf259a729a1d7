// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "link_model.h"
#include "obvid/chain/internal/chain.h"
#include "obvid/chain/internal/spiral_shape.h"
#include "obvid/core/internal/watch.h"
#include "slope_system.h"

namespace obvid::chain_detail {

/// Weights of a link's squared unevenness, and of the logarithm of curvatures that keep their sign
/// (docs/methods/g3.md: statistics of random spirals decided).
struct SlopeWeights {
  double change = 1.0, bend = 10.0, sign = 0.15;
};

/// What a chain with continuous slopes has to be.
struct SlopeProblem {
  ChainProblem chain;
  std::vector<SpiralForm> form;   ///< of each link
  std::vector<bool> equal_slope;  ///< whether the slopes of both links at a node shall be equal
};

/// Headings and curvatures with equal slopes at the joints of a chain, the most even ones: Newton's
/// method for the equations of Lagrange, with Gauss-Newton's Hessian of the unevenness.
class SlopeSolver {
 public:
  explicit SlopeSolver(const SlopeProblem& problem, const SlopeWeights& weights = {});

  struct Outcome {
    bool valid = false;      ///< all forms exist at the start
    bool converged = false;  ///< no step changes anything but by rounding
    int steps = 0;
    double largest_gap = 0.0;  ///< of the logarithms of slopes that shall be equal
  };
  [[nodiscard]] Outcome run(const std::vector<Element>& start, int most_steps, Watch& watch);

  [[nodiscard]] std::vector<Element> elements(const std::vector<Vec2>& points) const {
    return model_.elements(points, here_.x);
  }
  [[nodiscard]] std::vector<LinkState> links() const { return model_.links(here_.x); }
  /// Logarithm of the slope before over the slope after each node, where they shall be equal.
  [[nodiscard]] const std::vector<double>& gaps() const { return here_.gap; }

 private:
  /// What the unknowns give: the equations at them are made of it.
  struct Place {
    std::vector<double> x, gap;
    std::vector<LinkModel::LinkJet> jet;
    std::vector<SpiralSlopes> slopes;
    double energy = 0.0, gaps = 0.0;
  };
  void evaluate(Place& place) const;
  void set_units();
  void assemble();
  void add_sign_and_fixed(std::size_t node);
  /// The unknowns moved by a part of the solution of the equations.
  void move_trial(double part);
  /// Goes on from the trial to where the last steps lead.
  void extrapolate_trial();
  /// Before the trial becomes the place where the unknowns are.
  void remember_step();

  const SlopeProblem& problem_;
  LinkModel model_;
  SlopeWeights weights_;
  SlopeSystem system_;
  Place here_, trial_;
  std::vector<double> unit_;
  /// A step that was taken, in units: what the equations asked for, and from where it began to
  /// where the unknowns are.
  struct Step {
    std::vector<double> step, move;
  };
  std::vector<double> step_;
  std::vector<Step> past_;  ///< the last one first
};

}  // namespace obvid::chain_detail
