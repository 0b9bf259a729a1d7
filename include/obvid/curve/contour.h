// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/curve/carrier.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"
#include "obvid/geom/internal/value_range.h"

namespace obvid {

/// What a contour claims to be continuous at its joints that are no corners.
enum class Continuity {
  kG2,  ///< heading and curvature
  kG3,  ///< the slope of curvature too: the plot of curvature over arc length has no kinks
};
/// G2 or G3.
[[nodiscard]] const char* to_string(Continuity continuity);
[[nodiscard]] std::optional<Continuity> continuity_of(std::string_view name);

/// A joint of the contour: point, heading, curvature, and the input point it stands on, if any.
struct Joint {
  Element element;
  std::optional<std::size_t> source;  ///< index into `Contour::points`
  std::optional<Element> leaving{};   ///< heading and curvature after it where they are others:
                                      ///< at a corner, and where the curvature steps between pieces
                                      ///< that the input drew
  bool slope_step = false;            ///< in a contour that is G3 elsewhere: G2 only
  std::optional<std::size_t> after{};  ///< of a corner that stands on no point: the one before it,
                                       ///< index into `Contour::points`; the next one lies behind
};

/// Whether a joint is one of those between which a report says what it knows: it stands on a point,
/// or is a corner between two.
[[nodiscard]] inline bool is_station(const Joint& joint) { return joint.source || joint.after; }

/// What the user fixed at a point.
struct GivenDatum {
  std::size_t point = 0;               ///< index into `Contour::points`
  std::optional<double> theta{};       ///< heading, rad, modulo a full turn
  std::optional<double> kappa{};       ///< signed curvature, 1/unit
  bool corner = false;                 ///< the contour may turn here at once
  std::optional<ValueRange> thetas{};  ///< range of headings, rad, modulo a full turn
  std::optional<ValueRange> kappas{};  ///< range of signed curvatures, 1/unit
};

/// Neighbouring pieces that turn by no more have a common tangent, rad.
inline constexpr double kTangentTurn = 1e-6;

/// Whether the contour turns at once at a joint: not where its curvature alone steps, as between a
/// line and an arc of a drawing.
[[nodiscard]] bool is_corner(const Joint& joint);

/// Maximal part with curvature changing one way; pieces are counted from 0, both ends included.
struct Run {
  std::size_t first_piece = 0;
  std::size_t last_piece = 0;
  int direction = 0;  ///< +1 signed curvature increases, -1 decreases, 0 constant
};

/// A whole contour: pieces in order, each starting where the one before ends.
/// `joints.size()` is `pieces.size() + 1` for an open contour, `pieces.size()` for a closed one,
/// whose first joint is its last one too.
struct Contour {
  Units units;
  bool closed = false;
  Carrier carrier = Carrier::kSpiral;
  Continuity continuity = Continuity::kG2;
  std::vector<Vec2> points;             ///< input points as read (consecutive duplicates merged)
  std::vector<double> point_tolerance;  ///< per point: how far from it the contour may pass, units;
                                        ///< empty: it passes through all of them
  std::vector<GivenDatum> given;        ///< ascending by point
  std::vector<Joint> joints;
  std::vector<Piece> pieces;
  std::vector<Run> runs;
  std::vector<std::size_t> kept;  ///< pieces that the input drew itself and that were taken over as
                                  ///< they are, ascending
};

/// What a contour keeps of a drawing. Parts of one arc or ellipse count once.
struct KeptPieces {
  std::size_t lines = 0, arcs = 0, ellipses = 0, clothoids = 0;
};
[[nodiscard]] KeptPieces kept_pieces(const Contour& contour);

}  // namespace obvid
