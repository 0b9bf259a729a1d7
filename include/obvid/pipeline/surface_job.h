// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/core/units.h"
#include "obvid/picture/surface_svg.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/skin_sections.h"
#include "obvid/surface/internal/topology.h"
#include "obvid/surface/point_grid.h"
#include "obvid/surface/surface.h"
#include "obvid/surface_builders/internal/fillet.h"
#include "obvid/surface_builders/internal/grid.h"
#include "obvid/surface_builders/internal/scatter.h"
#include "obvid/surface_cut/internal/plane_section.h"

namespace obvid {

/// What surfaces are made of: a file, the text of one that is there already, or points.
struct SurfaceInput {
  std::string name;                     ///< path of the file; of others what errors call them
  std::optional<std::string> text{};    ///< content; nothing: the file is read
  std::optional<SpaceSeries> points{};  ///< in place of both; their name counts

  SurfaceInput() = default;
  SurfaceInput(std::string path) : name(std::move(path)) {}  // NOLINT: a path is an input
  SurfaceInput(const char* path) : name(path) {}             // NOLINT
  [[nodiscard]] static SurfaceInput of_text(std::string name, std::string text);
  [[nodiscard]] static SurfaceInput of_points(SpaceSeries points);
  [[nodiscard]] bool is_file() const { return !text && !points; }
};

/// How a grid becomes a surface.
enum class GridUse { kThrough, kNear, kControl };

// One struct for each kind, with what only this kind has to be told.

/// Skin through section contours.
struct SkinKind {
  SkinMatching matching = SkinMatching::kAutomatic;
  bool straight_across = false;
  std::optional<double> spacing{};  ///< between sections whose files have no z [1]
  std::optional<double> light{};    ///< few control points within so many units of the exact skin
  std::optional<double> fair_across{};  ///< units: how far sections may move to be fair across
};
/// Between two curves, or from one along a direction or to a point. Two lists of points are matched
/// as the sections of a skin.
struct RuledKind {
  std::optional<Vec3> direction{};  ///< from the curve by this vector
  std::optional<Vec3> apex{};       ///< to this point
  SkinKind strips{.straight_across = true};
};
/// A profile about an axis.
struct RevolveKind {
  Vec3 axis_point;
  Vec3 axis_direction{1.0, 0.0, 0.0};
  double angle = kFullTurn;  ///< rad
};
/// Of four border curves.
struct CoonsKind {};
/// Of a net of curves.
struct GordonKind {
  std::vector<SurfaceInput> across{};  ///< curves that cross those of the inputs
};
/// How rows and columns of points become a grid with parameters.
struct GridReading {
  Spread spread = Spread::kChord;
  std::optional<double> spacing{};   ///< of rows and columns of height matrices [1]
  std::optional<std::size_t> row{};  ///< of a list of points: how many are in a row
};
/// Through, near or controlled by a grid of points.
struct GridKind {
  GridUse use = GridUse::kThrough;
  GridReading reading{};
};
/// Of a surface, along the normal du x dv.
struct OffsetKind {
  double distance = 0.0;  ///< units
};
/// Integro-differential spline through a grid.
struct IdKind {
  bool smooth = false;  ///< C1 in place of the values
  GridReading reading{};
};
/// Near points in any order, as heights over a plane; the job's tolerance has to be given.
struct ScatterKind {
  std::optional<Vec3> up{};  ///< direction of the heights; nothing: normal of the best plane
  double steepest = 85.0 * kOneDegree;  ///< rad, what neighbours may force
  bool drop_outliers = false;           ///< left out, in place of named alone
};
/// A part of a surface: above planes or below them, inside or outside a closed contour.
struct TrimKind {
  std::vector<CutPlane> planes{};         ///< above: where the normal points to
  std::optional<SurfaceInput> contour{};  ///< in the plane across `along`, which is projected
  std::size_t along = 2;                  ///< axis of the projection: 0 x, 1 y, 2 z
  bool keep_positive = true;              ///< above, inside; else below, outside
};
/// A blend of a rolling ball between two faces of a model, which are trimmed where it touches them.
struct FilletKind {
  std::array<std::string, 2> faces{};  ///< names, or numbers from 1
  double radius = 0.0;                 ///< units
  std::optional<double> radius_end{};  ///< units, at the end of the spine [the same]
  std::array<BallSide, 2> sides{BallSide::kAutomatic, BallSide::kAutomatic};
  bool whole = false;  ///< faces are not trimmed
};
/// A side of a face.
struct FaceBorder {
  std::string face{};  ///< name, or number from 1
  PatchSide side = kUStart;
};
/// A model in which a patch begins where another one ends: `order` 0 position, 1 tangent planes, 2
/// curvature. The job's tolerance is that of the gap [1e-7 of the size].
struct MatchKind {
  FaceBorder border{}, to{};
  int order = 1;
  std::optional<double> within{};  ///< units: no control point moves farther [as far as it takes]
};
/// A surface as it is.
struct ConvertKind {};

/// A variant of all types but the first.
template <class Begin, class... Types>
using VariantBehind = std::variant<Types...>;
/// One of those above: pipeline/surface_kinds.inc.
using SurfaceKind = VariantBehind<void
#define OBVID_SURFACE_KIND(kind, ...) , kind
#include "obvid/pipeline/surface_kinds.inc"
#undef OBVID_SURFACE_KIND
                                  >;

/// Where curves come from.
struct CurveReading {
  ImportOptions import{};           ///< of curves of drawings
  FitJob sections = section_job();  ///< how contours of points are formed
  bool plain_when_refused = false;  ///< as in `SkinJob`
};

struct SurfaceJob {
  SurfaceKind kind = SkinKind{};
  std::vector<SurfaceInput> inputs{};
  std::optional<Units> units{};       ///< stated by the user; default as the files say
  std::optional<double> tolerance{};  ///< units: of what NURBS do not hold exactly, of skins from
                                      ///< their contours, of grids that are approximated, of
                                      ///< curves that have to meet [1e-5 of the size]
  CurveReading curves{};
};

/// The second list of inputs, of kinds that have one (Gordon: `across`); else null.
[[nodiscard]] std::vector<SurfaceInput>* second_inputs(SurfaceJob& job);
[[nodiscard]] const std::vector<SurfaceInput>* second_inputs(const SurfaceJob& job);

/// A surface with what is known about how it was made.
struct MadeSurface {
  SurfaceModel model;
  std::string kind;        ///< in words: "skin through 21 sections"
  double deviation = 0.0;  ///< units: of the NURBS from what was asked for; 0 exact
  std::optional<FittedSkin> skin;
  std::optional<ScatteredSurface> scatter;                 ///< its surface is in the model
  std::vector<std::pair<std::string, std::string>> facts;  ///< name and value, for the report
  std::vector<ScenePolyline> lines;                        ///< inputs, to be drawn with it
  ShownLongitudinals beside_longitudinals;                 ///< likewise
  std::vector<std::string> warnings;
};

/// Reads the inputs that are not there yet and makes the surface. Forms of several files (matrices
/// whose names differ, blades with their table) are known as files alone. Errors: those of the
/// readers and builders; E201 wrong numbers of inputs; E203 rows that do not fill a grid; E408 an
/// offset that folds (`value`: the largest distance that does not).
[[nodiscard]] Result<MadeSurface> make_surface(const SurfaceJob& job, const RunContext& run = {});

/// What is to be said where section contours were formed but are not proved (E501).
[[nodiscard]] std::optional<Error> not_proved(const MadeSurface& made);

/// A surface from a file: stored (.json), STEP, IGES, BREP, control points (.cpt, .cptw, .csv).
/// `warnings` get what was left out.
[[nodiscard]] Result<SurfaceModel> read_surface(const SurfaceInput& input,
                                                std::vector<std::string>& warnings,
                                                const RunContext& run = {});

/// A curve of space from a file: a contour, a curve of a drawing, or points: in a plane the fair
/// contour through them, else the C2 cubic by chord lengths (with a warning).
struct ReadCurve {
  std::string name;
  Units units;
  SpaceCurve curve;
  std::vector<std::string> warnings;
  double deviation = 0.0;  ///< bound of the curve's distance from what it stands for (clothoids)
};
[[nodiscard]] Result<ReadCurve> read_space_curve(const SurfaceInput& input, const CurveReading& how,
                                                 const RunContext& run = {});

}  // namespace obvid
