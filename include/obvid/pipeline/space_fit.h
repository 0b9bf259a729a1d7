// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/exchange/internal/points/samples.h"
#include "obvid/io/space_json.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"
#include "obvid/surface/point_grid.h"
#include "obvid/surface/space_curve.h"

namespace obvid {

/// A list of points x, y, z whose z changes; nothing for all other files (drawings, points of the
/// plane, several series, pipes), and where `import` chooses columns. `any_third`: a third column
/// without a name is z. Errors: E301.
[[nodiscard]] Result<std::optional<SpaceSeries>> space_series(const std::string& path,
                                                              bool any_third = false,
                                                              const ImportOptions& import = {});
/// The same of a text that was read already.
[[nodiscard]] Result<std::optional<SpaceSeries>> parse_space_series(
    const std::string& text, const std::string& name, bool any_third = false,
    const ImportOptions& import = {});

/// E203 where something is asked for that points in space cannot have: to be put in order.
[[nodiscard]] Result<void> check_space_import(const ImportOptions& import);

/// How a spatial series becomes a curve.
struct SpaceJob {
  FitJob fit;                      ///< of the projection; headings and radii are those in its frame
  std::vector<FixedData> fixed{};  ///< columns of the file, one entry per point; of a projection
                                   ///< along z only
  std::optional<Vec3> along{};     ///< direction of the projection, any length but 0; with it a
                                   ///< planar series is a space curve like all others
};

/// Heading, curvature and torsion of the curve at a given point.
struct SpacePoint {
  double plan_length = 0.0;         ///< arc length of the projection
  double height = 0.0;              ///< along the direction of the projection
  double curvature = 0.0;           ///< of the space curve, >= 0, 1/unit
  std::optional<double> torsion{};  ///< before the point, 1/unit, right-handed positive; nothing
                                    ///< where the curvature is 0
  std::optional<double> torsion_after{};
};

/// A fair curve in space, as a fair contour in a plane and, unless the points lie in that plane, a
/// second fair contour: height over the arc length of the first. The curve lies on the cylinder
/// over the first contour; the second is what it becomes when that cylinder is unrolled, so both
/// have its arc length and, where both are G2, so is it. Of a closed curve the second is one turn
/// from the start of the first to it again, with one height, heading and curvature at both ends.
struct SpaceFit {
  std::string name;
  Units units;
  std::vector<Vec3> points;     ///< as read
  Frame frame;                  ///< of the first contour; its normal is the direction of heights
  double flatness = 0.0;        ///< largest distance of a point from the plane of the frame; of
                                ///< planar series
  Fit plan;                     ///< the contour in the plane, or of the projection
  std::optional<Fit> unrolled;  ///< x: arc length of the projection, y: height; none: planar
  double largest_move = 0.0;    ///< upper bound of the distance of a point from the curve
  std::vector<SpacePoint> at_points{};                    ///< of spatial curves, as `points`
  double least_curvature = 0.0, largest_curvature = 0.0;  ///< enclose the curvature everywhere
  std::size_t torsion_places = 0;                         ///< where the torsion was looked at
  double least_torsion = 0.0, largest_torsion = 0.0;      ///< at these places; not a bound
  double torsion_step = 0.0;        ///< largest step of the torsion at a joint, 1/unit; of a closed
                                    ///< curve at its seam too
  std::optional<SpaceSeam> seam{};  ///< of closed curves that are not planar
  std::vector<std::string> warnings;
};

/// Forms the curve. Planar: largest distance from the plane of least squares at most the noise (of
/// the job, or half a unit of the last printed digit), at least 1e-9 of the size. Else projected
/// along `along`, or along the one of four directions (normal of the plane of least squares, z, y,
/// x) whose projection and heights together have the fewest vertices and inflections; of equals the
/// first. The noise is shared by projection and heights, so that no point moves by more; heights
/// may always move by the rounding of their print, as the lengths below them are computed. Closed
/// curves are G2 where the projection begins and ends, at a point whose height is met; the slope of
/// the curvature of the heights may step there.
/// Errors: E203 a direction without length, headings or radii without a direction, another carrier
/// than spirals of a curve that is not planar; E310 where the projection or the heights have a
/// corner; E402 projections
/// that run back on themselves; E501 heights of a closed curve that do not meet; those of `fit`,
/// with the part they belong to in front.
[[nodiscard]] Result<SpaceFit> fit_space(const SpaceSeries& series, const SpaceJob& job,
                                         const RunContext& run = {});

/// Curves in space from corner to corner, or one without corners; each keeps what `SpaceFit` says
/// of it. Parts begin and end in the points of the corners.
struct SpaceChain {
  std::string name;
  Units units;
  bool closed = false;       ///< of a chain with corners; one curve says so itself
  std::vector<Vec3> points;  ///< of a chain with corners: without its first one again
  std::vector<SpaceCorner> corners;
  std::vector<SpaceFit> parts;
  double largest_move = 0.0;  ///< upper bound of the distance of a point from its curve
  std::vector<std::string> warnings;
};

/// Cuts a series at its corners and forms each part as `fit_space` does, planar ones in the plane
/// through both of their ends, two points as a line. Corners are those that are marked
/// (`constraints`, `fixed`) and those of the series laid into a plane with its chords and turns,
/// found there as in a contour. A planar series is one contour with its corners. Errors: those of
/// `fit_space`, of a part with its points; E203 headings or radii at a corner, at the ends of a
/// closed chain or of a line.
[[nodiscard]] Result<SpaceChain> fit_space_chain(const SpaceSeries& series, const SpaceJob& job,
                                                 const RunContext& run = {});

/// The curve as one NURBS curve.
struct SpaceNurbs {
  SpaceCurve curve;
  double deviation = 0.0;  ///< units, an upper bound apart from rounding; 0: exact
};
/// A planar curve exactly, as its contour is; others as a C2 cubic by arc length within the
/// tolerance (> 0, units). Errors: E502 where a hundred thousand spans are not enough; E103 where
/// `watch` ends it.
[[nodiscard]] Result<SpaceNurbs> space_nurbs(const SpaceFit& fit, double tolerance,
                                             Watch* watch = nullptr);

/// One curve for each part; `tolerance` in units, default 1e-6 of the size of the chain.
[[nodiscard]] Result<std::vector<SpaceNurbs>> chain_nurbs(const SpaceChain& chain,
                                                          std::optional<double> tolerance,
                                                          const RunContext& run = {});

/// Largest extent of the points, units.
[[nodiscard]] double size_of(const SpaceFit& fit);
[[nodiscard]] double size_of(const SpaceChain& chain);

/// Everything: frame, both contours as contour files, the NURBS curve, the figures.
[[nodiscard]] std::string space_fit_json(const SpaceFit& fit, const SpaceNurbs& nurbs);

/// The same of a chain: the file of its curve where it has no corners.
[[nodiscard]] std::string space_chain_json(const SpaceChain& chain,
                                           const std::vector<SpaceNurbs>& nurbs);

/// The curve of a file.
[[nodiscard]] SpaceFit space_fit_of(const StoredSpace& stored);
[[nodiscard]] SpaceChain space_chain_of(const StoredSpaceChain& stored);

/// Another unit for all of the chain; what is to be warned of, as of a contour.
std::optional<std::string> take_units(SpaceChain& chain, const Units& given);

/// What was found of a stored curve in space.
struct SpaceVerification {
  Verification plan;
  std::optional<Verification> heights;
  std::optional<Error> false_claim;      ///< of the curve itself, E503
  std::vector<std::string> not_checked;  ///< fields that were taken as they stand
};
/// Proves both contours again, each as a contour file, and compares what the file says of frame,
/// points, heights, curvature, torsion, moves and the NURBS curve with what follows from them.
[[nodiscard]] SpaceVerification verify(const StoredSpace& stored);
/// The same; error E103 where it was cancelled.
[[nodiscard]] Result<SpaceVerification> verify(const StoredSpace& stored, const RunContext& run);
/// What the curve fails in: a false claim first.
[[nodiscard]] std::optional<Error> broken_promise(const StoredSpace& stored,
                                                  const SpaceVerification& found);
[[nodiscard]] std::string space_verification_json(const StoredSpace& stored,
                                                  const SpaceVerification& found);

/// What was found of a stored chain.
struct SpaceChainVerification {
  std::vector<SpaceVerification> parts;
  std::optional<Error> false_claim;      ///< of the chain itself, E503
  std::vector<std::string> not_checked;  ///< of a chain with corners, beside those of its parts
};
/// Verifies every part, that the parts have the points of the chain and meet in its corners, and
/// the angles there.
[[nodiscard]] SpaceChainVerification verify(const StoredSpaceChain& stored);
/// The same; error E103 where it was cancelled.
[[nodiscard]] Result<SpaceChainVerification> verify(const StoredSpaceChain& stored,
                                                    const RunContext& run);
[[nodiscard]] std::optional<Error> broken_promise(const StoredSpaceChain& stored,
                                                  const SpaceChainVerification& found);
/// Of one curve as above.
[[nodiscard]] std::string space_verification_json(const StoredSpaceChain& stored,
                                                  const SpaceChainVerification& found);
/// What a chain fails in that was just formed.
[[nodiscard]] std::optional<Error> broken_promise(const SpaceChain& chain);

/// The chain in a format by its file extension (".step"); `nurbs` as `chain_nurbs` gives them.
/// Formats that join what they are given have a file for each part. Errors: E202; those of the
/// formats.
[[nodiscard]] Result<Exported> export_space(const SpaceChain& chain,
                                            const std::vector<SpaceNurbs>& nurbs,
                                            const std::string& ending, const ExportOptions& options,
                                            const RunContext& run = {});

/// Place of a curve in space.
struct SpaceSample {
  Vec3 point;
  Vec3 tangent;                     ///< length 1
  double curvature = 0.0;           ///< >= 0, 1/unit
  std::optional<double> torsion{};  ///< 1/unit; nothing where the curvature is 0, behind a joint
                                    ///< where it steps there
};
[[nodiscard]] double length_of(const SpaceFit& fit);  ///< arc length, units
/// At arc lengths from the start, each from 0 to `length_of` it. Error: E203 beyond.
[[nodiscard]] Result<std::vector<SpaceSample>> sample_space(const SpaceFit& fit,
                                                            std::span<const double> at);

/// Places along each curve at equal steps of its arc length: s (from the start of the chain), x, y,
/// z, curvature, torsion; with corners the part, from 1, behind them. `count` places for each part.
[[nodiscard]] std::string space_samples_csv(const SpaceChain& chain, std::size_t count);
/// The same places of one curve as x y z: "Curve Through XYZ Points" of SolidWorks and others.
[[nodiscard]] std::string space_points_text(const SpaceFit& fit, std::size_t count);

}  // namespace obvid
