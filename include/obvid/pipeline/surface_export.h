// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant, an object is used by one thread at a time: docs/threads.md

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "obvid/cad/internal/cad.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/mesh/mesh.h"
#include "obvid/picture/internal/surface_page.h"
#include "obvid/picture/surface_svg.h"
#include "obvid/pipeline/file_formats.h"

namespace obvid {

namespace pipeline_detail {
struct SurfaceExport;
}

struct SurfaceExportOptions {
  CadFormat step = CadFormat::kStepAp214;
  std::optional<double> chord_tolerance;  ///< units: of triangles [1e-3 of the size]
  double angle = 0.0;                     ///< rad, between normals along an edge [15 degrees]
  SurfaceColouring colouring = SurfaceColouring::kShaded;
  SurfaceView view = SurfaceView::kIso;
  bool longitudinals = false;  ///< pictures have graphs of curvature in place of a view
  ShownLongitudinals beside_longitudinals{};
  std::vector<ScenePolyline> lines;         ///< drawn on page and picture
  std::optional<ShownDeviation> deviation;  ///< likewise
  std::optional<CurvatureExtremes>
      extremes;  ///< told by page and picture [what `check_surface` finds]
};

/// Whether surfaces can be written in a format here, to be asked before the work begins. Error:
/// E310 where the kernel's helper is needed and missing.
[[nodiscard]] Result<void> can_write_surfaces(FileFormat format);

/// A surface in all formats that were asked for; triangles are made once for all of them.
class SurfaceExporter {
 public:
  /// `model` has to live as long as this.
  SurfaceExporter(const SurfaceModel& model, const SurfaceExportOptions& options,
                  RunContext run = {});
  ~SurfaceExporter();
  SurfaceExporter(const SurfaceExporter&) = delete;
  SurfaceExporter& operator=(const SurfaceExporter&) = delete;

  /// Text of one file; `remarks` get what the user should know. Errors: those of the formats.
  [[nodiscard]] Result<std::string> text(FileFormat format, std::vector<std::string>& remarks);
  /// What may be wrong about the texts so far: a unit that is merely assumed.
  [[nodiscard]] const std::vector<std::string>& warnings() const;

 private:
  std::unique_ptr<pipeline_detail::SurfaceExport> parts_;
};

}  // namespace obvid
