// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/curve/contour.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// One section of a body: its points in space, and the fair contour through them in their plane.
/// Sections need not be quite plane: heights of the points over the plane are carried along the
/// contour by a C2 spline.
struct SkinSection {
  std::string name;
  std::vector<Vec3> points;  ///< in space; all the same: the body ends in a point here
  Frame frame;               ///< plane of the contour
  Contour contour;           ///< through the points as they lie in the plane; no pieces when the
                             ///< points are all the same
  std::vector<std::size_t> on_contour;  ///< for each point: which point of `contour.points` it is
};

/// What tells which places of neighbouring sections belong together.
enum class SkinMatching {
  kAutomatic,  ///< by points when all sections have equally many, else by length; of skins that are
               ///< fair across the one that forces the fewest changes of bending, of those that
               ///< keep the runs of curvature of the sections
  kByPoints,   ///< point i of each section belongs to point i of the others
  kByLength,   ///< equal shares of arc length between corners, and between ends of runs where all
               ///< sections have the same runs
  kByAngle,    ///< between corners equal steps of half arc length and half turned angle
  kOptimised   ///< between corners such that the lines across bend little, by least squares
};

/// What one matching forces, on lines of its own.
struct MatchingTrial {
  SkinMatching matching = SkinMatching::kByPoints;
  std::size_t isolines = 0;
  std::size_t forced = 0;  ///< fewest changes of bending within the tolerance, all lines together
  /// Largest change of curvature against its run in the exact skin's sections, as far as it was
  /// looked for: where this matching forces less than the first of the list did.
  std::optional<double> ripple{};
  std::optional<double> heavier{};  ///< likewise: its spans along, of those of the first
};

struct SkinOptions {
  double tolerance = 0.0;  ///< units, > 0: largest distance of the surface's sections from the
                           ///< contours
  SkinMatching matching = SkinMatching::kAutomatic;
  bool straight_across = false;  ///< ruled strips between neighbouring sections, else C2 cubics
  /// Units, > 0: few control points instead, so that no point of the skin lies farther from where
  /// it lay.
  std::optional<double> light{};
  /// Units, > 0: each section may move by as much where lines across then change their bending less
  /// often. Not with `straight_across`; with `light`, which has to be less, sections stay within
  /// this of the contours' exact skin all in all.
  std::optional<double> fair_across{};
};

/// What a light skin gave up, and for what.
struct LightSkinReport {
  double tolerance = 0.0;  ///< as it was asked for, units
  /// Bound of the distance of any point of the skin from the exact one, units. That of one that is
  /// fair besides is not bounded by the tolerance: sections moved, and between them it goes
  /// farther.
  double moved = 0.0;
  double knots_alone = 0.0;  ///< bound of what few knots alone moved any point by; <= tolerance
  std::size_t points_before = 0;  ///< control points of all patches
  std::size_t points = 0;
};

/// How one section came out.
struct SkinSectionReport {
  std::string name;
  double parameter = 0.0;    ///< v of the section in the patches
  double deviation = 0.0;    ///< largest distance from the contour, measured, units
  double from_points = 0.0;  ///< largest distance of a data point from the surface's section
  std::size_t runs = 0;      ///< of the contour: stretches of monotone curvature
  double ripple = 0.0;       ///< monotonicity violation: largest change of curvature against its
                             ///< run, as a share of the section's largest curvature; 0: monotone
                             ///< wherever the contour is
};

/// Waves across the sections, along isolines u = const of the patches: changes of sign of the
/// normal curvature that bulge more than the tolerance, against the fewest that heights within the
/// tolerance of the sections' points can have. Heights are those of the line developed into a
/// plane, over its chords, along the surface's normals: the figures are of these lines and these
/// normals.
struct AcrossReport {
  double tolerance = 0.0;  ///< units: of bulges that count, and of heights
  std::size_t isolines = 0;
  std::size_t found = 0;   ///< changes on all isolines together
  std::size_t forced = 0;  ///< fewest that were found possible: of the string drawn tight
  std::size_t proved = 0;  ///< of them certified: no heights within the tolerance have fewer
  std::size_t beyond = 0;  ///< found more than forced, summed over the lines that have more
  std::size_t worst = 0;   ///< most of them on one isoline
  // the same of shallower bulges, against the same forced ones; where sections did not move, equal
  double fine = 0.0;           ///< units: of bulges that count here
  std::size_t all = 0;         ///< changes
  std::size_t all_beyond = 0;  ///< more than forced, summed over the lines that have more
};

/// A skin that is fair across: what it was before, and how far its sections moved.
struct FairAcrossReport {
  double tolerance = 0.0;  ///< as it was asked for, units
  double moved = 0.0;   ///< bound of the distance of any section from where the exact skin has it,
                        ///< units: of control points, by the convex hull; <= tolerance
  bool enough = false;  ///< there were changes enough to move sections for
  /// How far any section may move, units, where that is less than the tolerance: 1 % of the length
  /// of the longest.
  std::optional<double> reach;
  AcrossReport before;               ///< of the exact (or light) skin, by this tolerance
  std::vector<MatchingTrial> tried;  ///< with `SkinMatching::kAutomatic`: the one used, then others
};

struct Skin {
  std::vector<SurfacePatch> patches;  ///< from corner to corner of the sections; u runs along the
                                      ///< sections, v across them, neighbours share their border
  std::vector<NurbsSurface> exact{};  ///< of each patch, where it was made fair across
  std::vector<SkinSectionReport> sections;
  AcrossReport across;
  /// Then `sections` and `across` are those of the light one, whose isolines are its own knots.
  std::optional<LightSkinReport> light;
  /// Then `sections` and `across` are those of the fair one, `across` by its tolerance and against
  /// what the exact skin's points force.
  std::optional<FairAcrossReport> fair;
  SkinMatching matching = SkinMatching::kByPoints;  ///< what was used
  std::vector<std::string> warnings;
};

/// The surface through section contours. Along the sections it is a C2 spline of degree 5 that
/// takes over point, tangent and curvature of each contour at common knots and follows it within
/// the tolerance between them; across, a C2 cubic through the sections (of 3 a parabola, of 2
/// straight lines), which are met exactly. Parameters: arc length between matched places, averaged
/// over the sections; across, chords averaged over the places. Derivation: docs/methods/skin.md.
///
/// With `light` the skin that is so made stays within that distance, with few control points
/// (`lightened`): its sections are no longer those of the contours, and `ripple` says how much of
/// their runs of curvature is lost.
///
/// With `fair_across` the skin is corrected within that tolerance: each of its sections stays
/// within it (proved, `FairAcrossReport::moved`), borders between patches stay as they are, borders
/// in a coordinate plane stay in it, and curvature along falls against the contour's run by no more
/// than 1e-3 of the section's largest (as measured in `ripple`); where the section had lost more of
/// it before, by no more than then, and against its own run by no more than 1e-3. Where no
/// correction with less waves is found, the skin stays as it was. With `light` besides, the net has
/// few control points along and the sections' own across, and the correction its knots.
///
/// Not guaranteed: what happens between sections beyond being C2; `across` counts the waves there;
/// with `fair_across`, that only forced changes of bending are left: `across` tells.
///
/// Errors: E201 numbers that do not belong together; E203 tolerance <= 0, options that contradict
/// each other, sections whose corners
/// cannot be matched (`index`: the section); E312 fewer than two sections; E313 neighbouring
/// sections at the same place (`index`); E402 a contour with a cusp (`index`: the section); E502
/// the tolerance is not reached within 2^10 parts of a stretch.
[[nodiscard]] Result<Skin> skin(const std::vector<SkinSection>& sections,
                                const SkinOptions& options, const RunContext& run = {});

}  // namespace obvid
