// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "chain_edits.h"
#include "chain_of_elements.h"
#include "obvid/alignment/internal/borne_grades.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "winding.h"

namespace obvid::alignment {

/// Largest offset over its tolerance after least squares from which no higher power comes back.
inline constexpr double kNoWayBack = 3.0;

/// Points in order with their tolerances. Of a closed row the first point comes again behind the
/// last one, `lap` on.
struct TolerantPoints {
  std::vector<Vec2> points;
  std::vector<double> tolerance;
  Vec2 lap{};
  std::size_t first_given = 0;  ///< number, as given, of the first point
};

/// What elements keep.
struct ElementLimits {
  double least_length = 0.0;
  double largest_curvature = std::numeric_limits<double>::infinity();
  std::optional<BorneGrades> grades;  ///< of a profile: what those at its joints are
};

/// Some elements with their points, cut out to be fitted.
struct ChainWindow {
  std::size_t first = 0;  ///< element
  /// Of its points: where these are nearer than their tolerances, feet need not be in their order.
  std::vector<std::size_t> numbers;
  FootedChain own;
  std::vector<Vec2> points;
  std::vector<double> tolerance;
  std::vector<int> number;  ///< in the whole chain, of each curvature
  Held held;
};

/// A chain along points, moved a window at a time. An edit is taken only where the elements of its
/// window can be fitted to their points within the tolerances, keep the limits, wind between
/// neighbouring points nowhere more than before, and lose no point that others passed.
class ChainOnPoints {
 public:
  /// `closed`: end and start are one joint, which stays.
  ChainOnPoints(TolerantPoints points, FootedChain begun, bool closed, ElementLimits limits,
                std::function<bool()> cancelled);

  [[nodiscard]] const FootedChain& now() const { return now_; }
  [[nodiscard]] const Chain& chain() const { return now_.chain; }
  [[nodiscard]] std::size_t size() const { return now_.chain.size(); }
  [[nodiscard]] const std::vector<Vec2>& points() const { return row_.points; }
  [[nodiscard]] const std::vector<double>& tolerance() const { return row_.tolerance; }
  [[nodiscard]] PointRow row() const { return {row_.points, row_.tolerance, closed_, row_.lap}; }
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] const ElementLimits& limits() const { return limits_; }
  /// Foot of a point, as points were given.
  [[nodiscard]] const Foot& foot_of_given(std::size_t i) const;

  void set(FootedChain other) { now_ = std::move(other); }
  void allow_length(double least);
  /// Leaves this part of the tolerances to elements, and gives them all back.
  void narrow_tolerances(double part);
  void widen_tolerances(double part);
  /// Beyond the limit is at it.
  void limit_curvatures();
  /// Curvatures that are rounding become those of lines: as they are they have signs, and radii,
  /// that no point shows.
  void straighten();
  /// Begins the chain, and the points, with element m.
  void turn_to(std::size_t m);
  /// Begins the chain with the element of the first point.
  void turn_to_first_given();
  /// Leaves out the last point, the first one again, and begins with element m: end and start are
  /// one joint from here on.
  void close_at(std::size_t m);

  /// Elements [first, last) of a chain; joint `end` of those of the present one is where it ends.
  [[nodiscard]] ChainWindow cut(const FootedChain& from, std::size_t first, std::size_t last,
                                const std::vector<Element>& joints, std::size_t end) const;
  /// Those of the present one.
  [[nodiscard]] ChainWindow cut(std::size_t first, std::size_t last) const;
  /// Fits a window. What is left is infinite where there are no such elements.
  [[nodiscard]] Fitted fit(ChainWindow& window) const;
  /// Makes `next` with what was fitted of its window the chain; false, and nothing, where more
  /// intervals of points are wound through than before, or points left that the window passes.
  bool commit(FootedChain next, const ChainWindow& window);
  /// Another chain in the place of this one, where its window can be fitted.
  bool take(Edit edit);
  bool take(std::optional<Edit> edit) { return edit && take(std::move(*edit)); }

  /// Fits all windows, one behind the other. They end at joints of the chain as it is, or where
  /// it is meant to pass.
  Result<void> polish(const RunContext& run, const std::vector<Element>* meant = nullptr);
  /// The same, some times, while a point is left.
  Result<void> polish_to_tolerance(const RunContext& run);

  /// Which intervals of points are not passed as they may be: a point left, or wound through. Finds
  /// the feet.
  [[nodiscard]] std::vector<bool> bad_intervals();
  [[nodiscard]] bool is_good();
  /// The largest offset over its tolerance. Finds the feet.
  [[nodiscard]] double largest();
  /// Whether it turns between neighbouring points as they do not show.
  [[nodiscard]] bool winds() const;
  /// Mean square of the offsets over the tolerances, of what the elements leave open; infinite
  /// where that is less than half of what the points tell. What is a thousandth of the tolerance
  /// counts as that.
  [[nodiscard]] double scatter() const;
  /// Whether an element outside of [first, last) has that curvature. Elements that share one follow
  /// one another.
  [[nodiscard]] bool is_used_outside(const Chain& chain, int number, std::size_t first,
                                     std::size_t last) const;
  [[nodiscard]] Element a_lap_on(Element at) const;

 private:
  [[nodiscard]] bool keeps_limits(const Chain& chain) const;
  [[nodiscard]] bool is_borne(const Chain& chain) const;
  [[nodiscard]] bool loses_points(FootedChain& next, const ChainWindow& window) const;
  [[nodiscard]] bool winds_more(const FootedChain& next, const ChainWindow& window) const;

  TolerantPoints row_;
  FootedChain now_;
  bool closed_ = false;
  ElementLimits limits_;
  std::function<bool()> cancelled_;  ///< that fits ask
};

}  // namespace obvid::alignment
