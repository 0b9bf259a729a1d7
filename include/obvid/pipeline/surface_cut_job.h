// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/exchange/internal/sketch.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/report/stored_contour.h"
#include "obvid/surface/surface.h"
#include "obvid/surface_cut/internal/displaced.h"
#include "obvid/surface_cut/internal/plane_section.h"

namespace obvid {

/// What a section is to a shipbuilder: x runs along the ship, y to port or starboard, z up.
enum class SectionKind { kPlane, kStation, kWaterline, kButtock };
/// "plane", "station", "waterline", "buttock".
[[nodiscard]] const char* to_string(SectionKind kind);

/// Planes across one axis: at given places, at multiples of a step, and so many at equal distances
/// between the ends of the surface, which are left out.
struct PlacesAcross {
  std::vector<double> at;       ///< units
  std::optional<double> every;  ///< units, > 0
  std::optional<std::size_t> count;
  [[nodiscard]] bool any() const { return !at.empty() || every || count; }
};

struct SurfaceCutJob {
  std::vector<CutPlane> planes;
  PlacesAcross stations;            ///< x = const, points y, z
  PlacesAcross waterlines;          ///< z = const, points x, y
  PlacesAcross buttocks;            ///< y = const, points x, z
  std::optional<double> tolerance;  ///< units: of chords between points [1e-5 of the size]
  std::optional<double> fair;       ///< units, > 0: branches become contours within so much
  std::optional<double> draught;    ///< units: z of the waterplane, to measure what is below
  bool half = false;                ///< the surface is one half of a body, symmetric to y = 0
  std::optional<double> density;    ///< mass in a unit^3, > 0: of the displacement
};

/// A branch as the contour that `fit` forms of its points.
struct FairBranch {
  StoredContour stored;
  bool proved = false;
  std::optional<Error> error;  ///< why there is none
};

struct MadeSection {
  SectionKind kind = SectionKind::kPlane;
  double at = 0.0;   ///< of stations, waterlines, buttocks: the place along their axis, units
  std::string name;  ///< "waterline 0.5"
  std::string id;    ///< "waterline-1", for names of files
  CutPlane plane;
  Frame frame;  ///< of the coordinates in the plane
  PlaneSection section;
  std::vector<FairBranch> fair;  ///< of each branch, where asked for
};

struct MadeSurfaceCut {
  std::vector<MadeSection> sections;
  Units units;
  double size = 0.0, tolerance = 0.0;  ///< units
  std::optional<Displaced> displaced;
  std::optional<double> displacement;  ///< mass, as of `density`
  std::vector<std::string> warnings;
};

/// Cuts by all planes, in the order planes, stations, waterlines, buttocks; on several threads,
/// same input, same result. Coordinates in a plane are those of the space (y, z of stations; x, y
/// of waterlines; x, z of buttocks); in other planes the first axis is horizontal and the origin
/// the place nearest to that of the space. Errors: E201 nothing to cut by and no draught; E203
/// steps that are not above 0, more than 10,000 planes; those of `ModelCutter`.
[[nodiscard]] Result<MadeSurfaceCut> cut_surface(const SurfaceModel& model,
                                                 const SurfaceCutJob& job,
                                                 const RunContext& run = {});

/// E501 where contours are formed but not proved, else the first that was refused.
[[nodiscard]] std::optional<Error> not_proved(const MadeSurfaceCut& made);

/// One branch of one section; in file names by its id, "waterline-1-2".
struct BranchPlace {
  std::size_t section = 0;
  std::size_t branch = 0;
  std::string id;
};
/// All branches, in their order.
[[nodiscard]] std::vector<BranchPlace> branches_of(const MadeSurfaceCut& made);
/// Whether a branch is written in the format: where branches became contours any of theirs, else
/// its points (.csv). Error: E202.
[[nodiscard]] Result<FileFormat> branch_format_of(std::string_view path, bool fair);
/// Points or contour of one branch as a file; no files where its contour was refused. Errors: those
/// of `export_contour`.
[[nodiscard]] Result<Exported> branch_file(const MadeSurfaceCut& made, const BranchPlace& place,
                                           FileFormat format, const RunContext& run = {});
/// All sections: .json and .csv (points), .svg and .dxf (lines drawing, `title` above it). Errors:
/// E202; E103.
[[nodiscard]] Result<std::string> sections_file(FileFormat format, const MadeSurfaceCut& made,
                                                const std::string& title,
                                                const RunContext& run = {});
/// E202: which files there are of them.
[[nodiscard]] Error no_such_sections();

// Under watch, a text that was cancelled is worth nothing.

/// All branches: columns section, branch, x, y, z.
[[nodiscard]] std::string sections_csv(const MadeSurfaceCut& made, Watch* watch = nullptr);
/// One branch in its plane: columns x and y, which `fit` reads; of closed ones the first point
/// comes again at the end.
[[nodiscard]] std::string branch_csv(const MadeSurfaceCut& made, std::size_t section,
                                     std::size_t branch);
/// docs/schema/surface_cut.schema.json; `points`: with all points.
[[nodiscard]] std::string surface_cut_json(const MadeSurfaceCut& made, const Written& written,
                                           bool points, Watch* watch = nullptr);
/// Lines drawing: profile (buttocks), half-breadth plan (waterlines) below it, body plan (stations)
/// beside it, aligned, in one scale; other planes each for themselves below. For .svg and .dxf.
[[nodiscard]] Sketch lines_drawing(const MadeSurfaceCut& made, const std::string& title);

/// As it is typed. Errors: E203.
struct SurfaceCutValues {
  std::vector<std::string> planes;                            ///< "NX,NY,NZ,D"
  std::optional<std::string> stations, waterlines, buttocks;  ///< "1,2.5", "every:0.5", "count:20"
  std::optional<double> tolerance, fair, draught, density;
  bool half = false;
};
[[nodiscard]] Result<void> set_surface_cut(const SurfaceCutValues& typed, SurfaceCutJob& job);

}  // namespace obvid
