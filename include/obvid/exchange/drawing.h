// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/alignment/profile.h"
#include "obvid/alignment/transition.h"
#include "obvid/curve/pieces.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// A curve that another system made, in its plane.
struct DrawnCurve {
  std::string label;          ///< what a user would look for: "SPLINE 2F on layer OUTLINE"
  std::vector<Piece> pieces;  ///< in order; where two do not meet, the gap is the drawing's own
  bool closed = false;        ///< the last piece ends where the first one starts
  std::string layer{};        ///< of the drawing, where it has layers
  std::string name{};         ///< what the file itself calls it, where it does
  std::string id{};           ///< by what the file tells it from others, where it does: "rect7"
  std::optional<double> station{};              ///< of its start, units; of alignments
  std::vector<PlacedTransition> transitions{};  ///< what clothoids stand for, in order
  std::optional<VerticalProfile> profile{};     ///< heights over its stations, units
  std::size_t arcs_more = 0;  ///< pieces beyond those that are drawn: arcs of half a turn or more
                              ///< are some pieces
};

/// What a file of an exchange format holds: curves, and series of points. Lengths in `units`.
struct Drawing {
  std::string name;                   ///< of the file
  Units units;                        ///< as the file says; assumed when it does not
  std::vector<DrawnCurve> curves;     ///< in the order of the file
  std::vector<PointSeries> series;    ///< lists of points, and polylines whose lines are
                                      ///< chords of a curve, in the order of the file
  std::vector<std::string> warnings;  ///< what was left out and why, in sentences
  std::size_t left_out = 0;           ///< what would be curves and was not read, or not in full or
                                      ///< not where it is drawn: `warnings` name it
};

}  // namespace obvid
