// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "layout.h"
#include "obvid/core/internal/watch.h"
#include "tube_model.h"

namespace obvid::fairing_detail {

/// Which curves must exist over every link while runs are searched.
inline constexpr Cone kSearchCone = Cone::kSpiral;

/// Courses of all links in few alternating runs.
struct Runs {
  Layout layout;
  int vertices = 0;
  bool feasible = false;    ///< the whole tube at once, not only its windows
  std::size_t trouble = 0;  ///< link whose barrier pushes hardest, when not feasible
  double slack = 0.0;       ///< left then, in units of the links' sizes
};

/// Searches few alternating runs on a tube with a smooth curve in it (docs/methods/fairing.md).
class RunSearch {
 public:
  RunSearch(const Tube& tube, const State& smooth, Watch& watch)
      : tube_(tube), smooth_(smooth), watch_(watch) {}

  /// Starts from the courses of the smooth curve and takes vertices away, the weakest runs first,
  /// as long as a neighbourhood of each change stays feasible; stops at `enough` vertices, fewer
  /// than which no curve has. Then solves the whole, and mends it where the neighbourhoods promised
  /// more than it holds.
  Runs search(int enough);

  [[nodiscard]] int newton_steps() const { return steps_; }
  [[nodiscard]] int solves() const { return solves_; }

 private:
  struct Run {
    std::size_t first = 0, last = 0;  ///< links first .. last - 1
    double strength = 0.0;            ///< change of curvature times length^2, in reaches
  };

  [[nodiscard]] std::vector<double> smooth_curvatures() const;
  [[nodiscard]] Layout smooth_layout() const;
  [[nodiscard]] std::vector<Run> runs_of(const Layout& layout) const;
  [[nodiscard]] Window neighbourhood(const Layout& layout, std::size_t from, std::size_t to) const;
  double slack_of(Window window, const Layout& layout);
  bool accept(Layout& layout, const Layout& trial, std::size_t from, std::size_t to);
  bool drop_weakest(Layout& layout, int enough);
  bool swallow(Layout& layout, int enough);
  bool mend(Runs& runs);
  void solve_whole(Runs& runs);

  const Tube& tube_;
  const State& smooth_;
  Watch& watch_;
  int steps_ = 0, solves_ = 0;
};

}  // namespace obvid::fairing_detail
