// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <vector>

#include "obvid/alignment/transition.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/geom/element.h"

namespace obvid {

/// What surveyors call the elements of a horizontal alignment.
/// The last one is none of theirs: a cubic of a drawing, in two coordinates over a parameter
/// (OpenDRIVE's paramPoly3 and poly3), which no alignment that is formed has.
enum class AlignmentKind {
  kLine,
  kArc,
  kClothoid,
  kBloss,
  kSine,
  kCosine,
  kHelmert,
  kCubic,
  kPolynomial
};
inline constexpr std::size_t kAlignmentKinds = 9;

/// The law of an element whose curvature changes; that of clothoids for all others.
[[nodiscard]] Transition transition_of(AlignmentKind kind);

/// One element: curvature changes linearly along it, or by the law of its kind.
struct AlignmentElement {
  AlignmentKind kind = AlignmentKind::kLine;
  double station = 0.0;  ///< arc length of its start along the alignment, units
  Element start;         ///< point, heading (rad, unwrapped), curvature at the start (1/unit)
  double length = 0.0;   ///< units
  double kappa1 = 0.0;   ///< curvature at the end, 1/unit
  bool step = false;     ///< the curvature at its start differs from that before; around a loop
                         ///< the last element is before the first one
};

/// How far a point lies from the alignment.
struct AlignmentDeviation {
  double station = 0.0;  ///< of its foot, units
  double offset = 0.0;   ///< to the left positive, units
};

struct Alignment {
  std::vector<AlignmentElement> elements;
  Element end;          ///< of the last element
  double length = 0.0;  ///< units
  bool closed = false;  ///< `end` is the start of the first element. Stations count from the foot
                        ///< of the first point, which lies on the first element: that begins at a
                        ///< station of 0 or less, and points before its start have the last ones
  std::vector<AlignmentDeviation> deviations;  ///< of each point
  double largest_share = 0.0;  ///< largest |offset| over the point's tolerance: 1 or less
  double rms = 0.0;            ///< root of the mean square of the offsets, units
  double found_within = 1.0;   ///< part of the tolerances that every point keeps: less than 1 where
                               ///< no search within all of them came to elements as few
  bool has_chords = false;     ///< stretches began as chords with rounded corners, which are no
                            ///< search's: there may be fewer elements, as where less than 1 is kept
};

struct AlignmentOptions {
  /// Divisions of the intervals between points at which the search tries joints; joints move freely
  /// afterwards. More find steps of curvature between coarse points.
  std::size_t divisions = 2;
  double least_length = 0.0;  ///< of each element, units; 0: a quarter of the mean distance of
                              ///< points. An alignment of one element may be shorter
  double least_radius = 0.0;  ///< of each place, units; 0: any
  bool closed = false;        ///< around a loop: behind the last point comes the first one
  /// What takes the place of clothoids between lines and arcs, and at the ends, wherever the
  /// tolerance allows it; others stay clothoids.
  Transition transitions = Transition::kClothoid;
  /// Lines and arcs alone, with common tangents: `transitions` and `without_steps` say nothing
  /// then.
  bool without_transitions = false;
  /// Curvature goes on without steps (G2): clothoids, or transitions of the wanted kind, are put
  /// between elements of different curvatures. There are more elements then.
  bool without_steps = false;
};

/// Few lines, arcs and clothoids, each beginning with the tangent of the one before (G1), within
/// `tolerance[i]` of point i, which are passed in order; first and last point are met by their feet
/// at the ends. Among elements of the same number curvatures without steps, arcs and lines are
/// preferred wherever the tolerance allows them.
///
/// Closed alignments go on behind the last point to the first one, with nothing of their own where
/// they begin: no point is met by a joint. The ends of an open search are joined there, and
/// everything is tried again with the seam elsewhere. A last point that is the first one again
/// stands for it. Points that lie on one circle have one arc.
///
/// Where searches within all of the tolerances come to nothing, or to stretches that have to be
/// chords with rounded corners, those within parts of them are tried.
///
/// Guaranteed: every offset is at most its tolerance (else an error), elements join exactly but for
/// rounding, and are as long and as blunt as the options ask for. Not guaranteed: that no fewer
/// elements exist (the number is the fewest that a search by dynamic programming over polygons of
/// possible offsets and headings found: docs/methods/alignment.md). Deterministic; reentrant.
///
/// Errors: E203 a least length or radius that is negative or no number, E304 fewer than two points
/// (closed: three), E402 coinciding neighbours, E401 none
/// found (`index`: the first point that was not reached), E502 not within the tolerance with such
/// lengths and radii, or with a step of the curvature that no transition of such a length takes
/// the place of, E103 cancelled.
[[nodiscard]] Result<Alignment> fit_alignment(const std::vector<Vec2>& points,
                                              const std::vector<double>& tolerance,
                                              const AlignmentOptions& options = {},
                                              const RunContext& run = {});

}  // namespace obvid
