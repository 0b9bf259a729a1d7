// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/cad/internal/cad.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/mesh/mesh.h"
#include "obvid/picture/internal/surface_page.h"
#include "obvid/picture/surface_svg.h"

namespace obvid {

/// Files that a surface can be written to, told by their endings.
enum class SurfaceFormat {
  kSurface,  ///< .json
  kStep,     ///< .step, .stp
  kIges,     ///< .iges, .igs
  kBrep,     ///< .brep
  kStl,      ///< .stl
  kObj,      ///< .obj
  kGlb,      ///< .glb
  kPly,      ///< .ply
  kPage,     ///< .html
  kPicture,  ///< .svg
};

[[nodiscard]] std::optional<SurfaceFormat> surface_format_of(std::string_view path);
/// ".json (surface), .step (STEP), ...": for help and errors.
[[nodiscard]] std::string known_surface_endings();

struct SurfaceExportOptions {
  CadFormat step = CadFormat::kStepAp214;
  std::optional<double> chord_tolerance;  ///< units: of triangles [1e-3 of the size]
  double angle = 0.0;                     ///< rad, between normals along an edge [15 degrees]
  SurfaceColouring colouring = SurfaceColouring::kShaded;
  SurfaceView view = SurfaceView::kIso;
  std::vector<ScenePolyline> lines;  ///< drawn on page and picture
  std::optional<CurvatureExtremes>
      extremes;  ///< told by page and picture [what `check_surface` finds]
};

/// A surface in all formats that were asked for; triangles are made once for all of them.
class SurfaceExporter {
 public:
  SurfaceExporter(const SurfaceModel& model, const SurfaceExportOptions& options,
                  RunContext run = {});

  /// Text of one file; `remarks` get what the user should know. Errors: those of the formats.
  [[nodiscard]] Result<std::string> text(SurfaceFormat format, std::vector<std::string>& remarks);
  /// What may be wrong about the texts so far: a unit that is merely assumed.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  [[nodiscard]] Result<std::string> made(SurfaceFormat format, std::vector<std::string>& remarks);
  /// Once, for all pages and pictures.
  [[nodiscard]] const std::optional<CurvatureExtremes>& extremes();
  [[nodiscard]] Result<void> tessellated(std::vector<std::string>& remarks);

  const SurfaceModel& model_;
  SurfaceExportOptions options_;
  RunContext run_;
  std::vector<Mesh> meshes_;
  std::vector<std::string> warnings_;
};

}  // namespace obvid
