// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/region/internal/curvature_chains.h"

namespace obvid {

/// A chord of a series, with the way in which the curvature changes over it.
struct RangeLink {
  double h = 0.0;      ///< length, units
  double omega = 0.0;  ///< heading, rad, unwrapped along the series
  /// +1 curvature grows, -1 falls, 0 an arc or line that stays; nothing: a vertex lies inside.
  std::optional<int> direction;
};

/// What is given at a point.
struct RangeNode {
  std::optional<double> theta;         ///< heading, rad, unwrapped like the chords
  std::optional<double> kappa;         ///< signed curvature, 1/unit
  int curvature_sign = 0;              ///< +1 or -1: the curvature keeps this sign
  std::optional<ValueRange> thetas{};  ///< headings that do, rad, unwrapped like the chords
  std::optional<ValueRange> kappas{};  ///< signed curvatures that do, 1/unit
};

/// Range of the heading at one point, ends excluded, rad, unwrapped like the chords.
struct HeadingRange {
  double low = 0.0;
  double high = 0.0;
  /// Nothing ends the range there but what is looked at: at the first and the last point headings
  /// up to a right angle from the chord, elsewhere curves that turn by less than half a turn
  /// between two points.
  bool low_is_open = false, high_is_open = false;
};

/// What a point may have when all else that is given stays.
struct FeasibleData {
  std::optional<HeadingRange> heading;  ///< with the heading of this point freed; nothing: none
  std::optional<CurvatureRange> kappa;  ///< with the curvature of this point freed; nothing: none
};

/// Ranges of heading and curvature at every point in which a curve through all points exists whose
/// curvature grows and falls over the chords as said and which has everything else that is given
/// ([Kurnosenko 2013]; headings count as less than half a turn from their chords, and curves turn
/// by less than half a turn over a chord whose heading before is free).
///
/// Exact but for interpolation: the least curvature at each point as a function of its heading
/// is carried from chord to chord in closed form (docs/methods/region.md), forward and backward;
/// the range is where it stays below the greatest. The function is kept at some hundred headings
/// and interpolated with its slope: ends are good to about 1e-7 rad, and to 1e-6 of a curvature.
/// `links` has one entry less than `nodes`. O(n). `watch` is asked at every chord: nothing is known
/// of any point when the work is to end.
[[nodiscard]] std::vector<FeasibleData> feasible_data(const std::vector<RangeLink>& links,
                                                      const std::vector<RangeNode>& nodes,
                                                      Watch* watch = nullptr);

/// The order in which data are chosen; each choice leaves the others about half of their room.
enum class ChoiceOrder {
  kAlong,   ///< from point to point, as [003] does
  kHalves,  ///< halfway between points chosen before: of n points none is left less room than about
            ///< 1/n, where one order along them may leave 2^-n. Costs log2(n) times as much
};

/// Curvatures at vertices and at the ends of the series, which may be as sharp as one likes.
enum class SharpCurvature {
  kMiddle,  ///< in the middle like all others
  kCalm,    ///< beyond the bluntest one by what the angles of the chords beside it ask for, so that
            ///< the curvature does not leap over them where they hardly turn
};

/// Headings and curvatures for a whole series, each in the middle of what is left to it: first the
/// headings in the order given, then the curvatures at these headings, by the middle of the radii
/// where both ends of their range are finite and of one sign (the rule of [003] for both). What
/// is given stays. Every chord then has a curve of monotone curvature with these ends. Nothing when
/// there is no such curve through all points. `wanted`, empty or one per node: curvatures that are
/// taken where the range that is left holds them and they do not lie beside an end of it; else
/// halfway from that end to its middle. Nothing, too, when `watch`, asked at every chord, ends it.
[[nodiscard]] std::optional<std::vector<RangeNode>> central_data(
    const std::vector<RangeLink>& links, std::vector<RangeNode> nodes,
    const std::vector<std::optional<double>>& wanted = {}, ChoiceOrder order = ChoiceOrder::kAlong,
    SharpCurvature sharp = SharpCurvature::kMiddle, Watch* watch = nullptr);

/// The same around a closed series: `links` and `nodes` are equally many, the last link leads back
/// to the first node. The result has one node more, the first one again, a turn later. The heading
/// at a vertex (or beside an arc, or behind a link with a vertex inside) is chosen first, in the
/// middle of those with which one turn closes; there the curvature may always be sharper, so one
/// turn from it, with equal curvatures at its ends, is all that closing asks for. Nothing when no
/// such curve closes, or when the curvature grows, or falls, all around; nor
/// when `watch` ends it.
[[nodiscard]] std::optional<std::vector<RangeNode>> central_loop(
    const std::vector<RangeLink>& links, const std::vector<RangeNode>& nodes,
    const std::vector<std::optional<double>>& wanted = {}, Watch* watch = nullptr);

/// Whether `central_loop` has a curve, without the choice of its middle.
[[nodiscard]] bool loop_closes(const std::vector<RangeLink>& links,
                               const std::vector<RangeNode>& nodes, Watch* watch = nullptr);

}  // namespace obvid
