// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/mesh/mesh.h"
#include "obvid/picture/surface_svg.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// How the page looks when it is opened. The address may say otherwise, for links:
/// `page.html#mode=zebra&view=top&projection=orthographic&wireframe=1&u=12&v=6&stripes=20`.
struct PageOptions {
  std::string title;  ///< empty: the name of the model
  SurfaceColouring colouring = SurfaceColouring::kShaded;
  SurfaceView view = SurfaceView::kIso;
  bool orthographic = false;
  int isolines_u = 10;  ///< cells of each patch between isolines
  int isolines_v = 10;
  int zebra_stripes = 10;                   ///< dark stripes over half a turn of the reflected ray
  std::vector<ScenePolyline> lines;         ///< sections, tool paths
  std::optional<ShownDeviation> deviation;  ///< needed by the colouring of that name
  std::optional<CurvatureExtremes> extremes;  ///< told; else those of the triangles' corners
  std::size_t most_triangles = 2'000'000;  ///< of all patches, E502 beyond: 80 bytes each at most
};

/// One self-contained HTML page that shows the surface in a browser (WebGL 2), without a network:
/// turned, moved and zoomed by mouse, touch and keys; shaded, isolines, curvature colours, zebra,
/// isophotes, reflection lines, and where it is given the deviation (of points at most 200,000).
/// `meshes[i]` belongs to patch i; its accuracy is the caller's choice. Curvatures are computed
/// here, coordinates are stored as offsets from the centre in single precision. Errors: E203
/// options out of range, E303 what is not finite, E311 no triangles, E307 meshes that do not belong
/// to the patches, E502 too many triangles, those of `check` for each patch.
[[nodiscard]] Result<std::string> surface_page(const SurfaceModel& model,
                                               const std::vector<Mesh>& meshes,
                                               const PageOptions& options = {},
                                               const RunContext& run = {});

}  // namespace obvid
