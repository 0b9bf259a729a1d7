// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/curve/contour.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// Of the larger curvature: what more than that counts as a jump where two pieces meet.
inline constexpr double kMostCurvatureStep = 1e-6;

/// Something that a curvature comb shows at one place of a curve.
struct AuditPlace {
  enum class Kind {
    kVertex,         ///< curvature turns back
    kInflection,     ///< curvature changes its sign
    kCurvatureJump,  ///< common tangent, different curvatures
    kCorner,         ///< different tangents
    kGap,            ///< pieces that do not meet
  } kind = Kind::kVertex;
  double s = 0.0;  ///< arc length from the start, units
  Vec2 point;
  double kappa_before = 0.0;  ///< 1/unit; the same on both sides unless curvature jumps
  double kappa_after = 0.0;
  double size = 0.0;  ///< corner: turn, rad; gap: distance, units; else 0
};

[[nodiscard]] const char* to_string(AuditPlace::Kind kind);

/// The curvature of a curve that another system made.
struct CurveAudit {
  std::string label;
  std::string layer;                          ///< of the drawing, where it has layers
  std::string name;                           ///< what the file itself calls it; empty: nothing
  std::optional<double> station;              ///< of its start, units; of alignments
  std::vector<PlacedTransition> transitions;  ///< which pieces are clothoids in their place
  std::optional<VerticalProfile> profile;     ///< of alignments whose file has heights
  Contour contour;          ///< the pieces with joints; promises nothing (carrier `baseline`)
  Certificate certificate;  ///< proved verdict of each piece, gaps, counts
  double length = 0.0;      ///< units
  /// Signed, 1/unit, sampled. NaN where an end of a piece has no curvature: it has no bound then.
  double least_kappa = 0.0, largest_kappa = 0.0;
  bool counted = true;  ///< false where a piece has no curvature somewhere (a control point on an
                        ///< end): then nobody counted the three figures that follow
  int vertices = 0;     ///< all of them, as the certificate counts
  int visible_vertices = 0;  ///< those that swing by more than 1 % of the range of the curvature
  int inflections = 0;
  std::size_t straightened = 0;    ///< ends and pieces that are straight but for rounding, and were
                                   ///< taken so
  double flat_curvature = 0.0;     ///< largest curvature that counted as rounding there, 1/unit
  int continuity = 3;              ///< of all joints: 3 slope of curvature, 2 curvature, 1 heading,
                                   ///< 0 position, -1 gaps
  std::vector<AuditPlace> places;  ///< in order along the curve; tiny swings of rounding left out
};

/// "as drawn: 8 vertices, 2 inflections, 3 corners": what a picture says of it, no verdict.
[[nodiscard]] std::string as_drawn(const CurveAudit& audit);

/// Audits a connected curve. A piece whose height over its chord is below eight roundings of its
/// coordinates is straight: curvature below 64 2^-53 times the largest coordinate over the squared
/// length is none, and neither are such curvatures at the ends of clothoids, unless they go on
/// continuously (as below) from a curvature that is more. Gaps, corners and jumps are what the
/// numbers say beyond rounding: gaps above 1e-9 of the size, turns above 1e-6 rad, jumps above 1e-6
/// of the larger curvature. Places are found at 200 samples of each piece and refined: narrower
/// swings are counted, not placed.
[[nodiscard]] CurveAudit audit(const DrawnCurve& curve, const Units& units);
/// The same of work that may be stopped: asks for each piece. Error: E103.
[[nodiscard]] Result<CurveAudit> audit(const DrawnCurve& curve, const Units& units,
                                       const RunContext& run);

/// The contour alone that an audit speaks of: pieces, what is straight but for rounding straight,
/// with joints; without runs and without a proof of anything.
[[nodiscard]] Contour contour_as_drawn(const DrawnCurve& curve, const Units& units);

}  // namespace obvid
