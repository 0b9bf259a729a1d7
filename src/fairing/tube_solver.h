// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "tube_model.h"

namespace obvid::fairing_detail {

/// How a search for a point inside all cones ended.
struct Feasibility {
  bool feasible = false;
  double slack = 0.0;  ///< left when not feasible, in units of each link's size
};

/// Damped Newton's method on windows of one tube. Counts its steps; each is work of one unit per
/// node. When the watch says stop, whatever was sought counts as not found.
class TubeSolver {
 public:
  TubeSolver(TubeModel& model, Watch& watch) : model_(model), watch_(watch) {}

  /// Moves x (inside the tube) into all cones, or tells by the duality gap that there is no such x.
  Feasibility find_inside(State& x);
  /// Moves x inside the tube while keeping it smooth: `energy` is the weight of the model's energy
  /// against the barrier. False when no such x was found.
  bool enter_tube(State& x, double energy);
  /// Newton to the minimum of the merit for fixed weights, from inside; at most `most` steps.
  /// Returns whether the decrement fell below `done`.
  bool descend(State& x, const Weights& weights, double done, int most);
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] double slack() const { return slack_; }

 private:
  double step(State& x, const Weights& weights, double slack_cost);

  TubeModel& model_;
  Watch& watch_;
  BorderedSystem system_;
  State direction_, trial_;
  double slack_ = 0.0;
  int steps_ = 0;
};

}  // namespace obvid::fairing_detail
