// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/run_context.h"
#include "obvid/mesh/mesh.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/space_fit.h"
#include "obvid/pipeline/surface_export.h"

namespace obvid::pipeline_detail {

/// A contour that is written. Lengths in units of the contour.
struct ContourExport {
  const StoredContour& stored;
  const Contour& contour;
  const ExportOptions& options;
  double size = 0.0;           ///< diagonal of its box
  double tolerance = 0.0;      ///< of curves that the format cannot hold
  double arc_tolerance = 0.0;  ///< of arcs, chords and samples
  Watch* watch = nullptr;
};

/// With its tolerances, as `options` say or as they are.
[[nodiscard]] ContourExport contour_export(const StoredContour& stored,
                                           const ExportOptions& options, Watch* watch);

/// A contour for STEP, IGES and BREP, as `export_contour` says.
struct MadeCadCurve {
  CadCurve curve;
  double deviation = 0.0;   ///< of clothoids that a spline follows, units
  std::string in_pieces{};  ///< why it is no one NURBS curve, though not of lines and arcs alone
};
[[nodiscard]] Result<MadeCadCurve> cad_curve(const ContourExport& e);

/// A surface that is written; what several files need is made once.
struct SurfaceExport {
  const SurfaceModel& model;
  SurfaceExportOptions options;
  RunContext run;
  std::vector<Mesh> meshes{};
  std::vector<std::string> warnings{};

  /// Fills the extremes that pictures of curvature and pages tell.
  [[nodiscard]] Result<void> find_extremes_once();
  /// Fills `meshes`; tells how many triangles there are where it does.
  [[nodiscard]] Result<void> tessellate_once(std::vector<std::string>& remarks);
};

/// A curve in space that is written.
struct SpaceExport {
  const SpaceChain& chain;
  const std::vector<SpaceNurbs>& nurbs;
  const ExportOptions& options;
  const RunContext& run;
};

[[nodiscard]] Error not_held_by_format();

/// Error E203 where a plot that was asked for has nothing to show.
[[nodiscard]] Result<void> can_plot(const ContourExport& e);

using ContourWriter = Result<Exported> (*)(const ContourExport& e);
using SurfaceWriter = Result<std::string> (*)(SurfaceExport& e, std::vector<std::string>& remarks);
using SpaceWriter = Result<Exported> (*)(const SpaceExport& e);

#define OBVID_FORMAT(enumerator, endings, contours, surfaces, curves, ...)                        \
  Result<Exported> contour_as_##contours(const ContourExport& e);                                 \
  Result<std::string> surface_as_##surfaces(SurfaceExport& e, std::vector<std::string>& remarks); \
  Result<Exported> space_as_##curves(const SpaceExport& e);
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT

/// Who writes a format. Each of these tables lies beside its writers: what writes contours alone
/// takes no others along (cmake/ObvidFirst.cmake).
[[nodiscard]] ContourWriter contour_writer_of(FileFormat format);
[[nodiscard]] SurfaceWriter surface_writer_of(FileFormat format);
[[nodiscard]] SpaceWriter space_writer_of(FileFormat format);

}  // namespace obvid::pipeline_detail
