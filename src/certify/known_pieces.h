// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "end_data.h"
#include "obvid/certify/certify.h"
#include "piece_facts.h"

namespace obvid {

/// What follows from a piece alone.
struct KnownPiece {
  PieceFacts facts;
  PieceEnds ends;
  Vec2 middle;         ///< at t = 1/2
  bool known = false;  ///< the rest holds
};

/// The pieces of one contour.
struct PieceMemory::Pieces {
  std::vector<KnownPiece> list;
  bool slopes = false;  ///< ends know theirs

  /// Examines all pieces that are not known.
  void learn(const Contour& contour, Watch& watch);
};

}  // namespace obvid
