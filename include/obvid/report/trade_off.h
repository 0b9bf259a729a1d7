// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/units.h"

namespace obvid {

/// What one tolerance for all points brings.
struct TradeOffRow {
  double tolerance = 0.0;  ///< units
  bool formed = false;     ///< false: refused; the figures below mean nothing then
  bool kept = false;     ///< what the carrier promises holds, and the region is as narrow as asked
  bool proved = false;   ///< kept, and monotone by proof
  bool carried = false;  ///< the contour of the row before: this tolerance allows it as well, and
                         ///< nothing better was found
  std::string option;    ///< what to give `obvid fit` for this contour, e.g. "--noise 0.1 --open";
                         ///< empty where none was formed
  std::string refusal;   ///< why it was not formed or not proved
  int vertices = 0;
  int vertices_lower_bound = 0;  ///< what the points force
  int inflections = 0;
  std::size_t pieces = 0;
  double largest_move = 0.0;  ///< units
  double seconds = 0.0;
};

/// Tolerances and the vertices that each of them needs.
struct TradeOff {
  std::string name;                        ///< of the series
  Units units;                             ///< of lengths
  bool closed = false;                     ///< whether the contours are
  std::vector<TradeOffRow> rows;           ///< by ascending tolerance
  std::optional<std::size_t> recommended;  ///< row; nothing when none is kept
  bool promised = true;                    ///< whether the carrier promises to be monotone
};

/// "No tolerance gave a ...": what is looked for.
[[nodiscard]] inline const char* kept_contour(const TradeOff& t) {
  return t.promised ? "proved contour" : "contour that keeps what its carrier promises";
}

}  // namespace obvid
