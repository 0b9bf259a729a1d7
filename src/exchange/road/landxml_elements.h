// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/alignment/transition.h"
#include "obvid/curve/pieces.h"

namespace obvid::exchange {

/// A Curve of LandXML: what the file gives.
struct StatedCurve {
  Vec2 start, end;
  std::optional<Vec2> centre;
  std::optional<double> radius;
  bool left = true;  ///< rot is ccw
};

/// A Spiral: curvatures from the stated radii, without sign.
struct StatedSpiral {
  Vec2 start, end;
  std::optional<Vec2> meeting;  ///< PI
  double kappa0 = 0.0, kappa1 = 0.0, length = 0.0;
  bool left = true;
  Transition law = Transition::kClothoid;
};

/// A piece, how far from its stated end its formula ends, and what is doubtful about it.
struct PlacedPiece {
  Piece piece;
  double off_end = 0.0;
  std::string doubt;
};

/// The arc between its ends, or the reason why there is none. Of a spiral of another law the
/// clothoid with its heading, curvatures and length, which ends elsewhere.
[[nodiscard]] std::optional<PlacedPiece> placed(const StatedCurve& curve, std::string& why);
[[nodiscard]] std::optional<PlacedPiece> placed(const StatedSpiral& spiral, std::string& why);

/// Two pieces that continue each other as one arc that turns by less than half a turn, or as one
/// clothoid; nothing where they do not.
[[nodiscard]] std::optional<Piece> joined(const Piece& first, const Piece& second);

/// Whether the last piece ends where the first begins, to 1e-9 of the summed chords; then it ends
/// exactly there.
[[nodiscard]] bool closed_up(std::vector<Piece>& pieces);

}  // namespace obvid::exchange
