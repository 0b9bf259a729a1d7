// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// What the colours of a surface tell. Names: shaded, isolines, gaussian, mean, k1, k2, zebra
/// (mirrored stripes far away), isophotes (equal angles between normal and view), reflection (lamps
/// along the ceiling, one size of the surface above it), deviation (`ShownDeviation`).
enum class SurfaceColouring {
  kShaded,
  kIsolines,
  kGaussian,
  kMean,
  kK1,
  kK2,
  kZebra,
  kIsophotes,
  kReflection,
  kDeviation
};
/// From where a surface is seen, z upwards. Names: iso, front (along y), top (against z), side
/// (against x), back, bottom.
enum class SurfaceView { kIso, kFront, kTop, kSide, kBack, kBottom };

/// Least and greatest curvatures as another report states them: a picture beside it says the same.
struct CurvatureExtremes {
  Range gaussian, mean, k1, k2;
  [[nodiscard]] const Range& of(SurfaceColouring colouring) const;
};

[[nodiscard]] std::string_view name_of(SurfaceColouring colouring);
/// Whether it is one of the four of curvature: these tell extremes beside their colours.
[[nodiscard]] bool is_curvature(SurfaceColouring colouring);
[[nodiscard]] std::string_view name_of(SurfaceView view);
[[nodiscard]] std::optional<SurfaceColouring> colouring_named(std::string_view name);
[[nodiscard]] std::optional<SurfaceView> surface_view_named(std::string_view name);

/// A line in space drawn with a surface. Roles with a look of their own: section, toolpath, rapid.
struct ScenePolyline {
  std::vector<Vec3> points;
  std::string role;
};

/// A point that was measured, and how far it is off, units.
struct SceneDot {
  Vec3 point;
  double value = 0.0;
};

/// How far a surface and what it was measured against are apart: colours of its own places, or
/// coloured points.
struct ShownDeviation {
  std::string title;                     ///< of the legend
  std::function<double(Vec3)> of_place;  ///< units, of a place of the surface; empty: points alone;
                                         ///< called on several threads at a time
  std::vector<SceneDot> dots;
  Range told;  ///< least and greatest deviation, as the report has them
};

/// What stands beside a surface in the graphs of its longitudinals.
struct ShownLongitudinals {
  std::vector<NurbsSurface> before{};  ///< of each patch: the exact skin, where that is another
  std::vector<double> sections{};      ///< parameters v; empty: knots are marked
};

struct SurfacePictureOptions {
  std::string title;  ///< empty: the name of the model
  SurfaceColouring colouring = SurfaceColouring::kShaded;
  SurfaceView view = SurfaceView::kIso;
  std::optional<double> azimuth_deg;    ///< instead of the view's: 0 as front, 90 as side
  std::optional<double> elevation_deg;  ///< instead of the view's: 90 from above
  int isolines_u = 8;                   ///< cells of each patch between isolines; 1: none
  int isolines_v = 8;
  int zebra_stripes = 10;      ///< dark stripes over half a turn of the reflected ray
  std::optional<Range> range;  ///< of the curvature colours; else by percentiles
  std::optional<CurvatureExtremes> extremes;  ///< told; else those of the picture's own places
  double width = 900.0;                       ///< px
  double height = 620.0;                      ///< px
  std::size_t most_facets = 12'000;           ///< cells that the patches are divided into; fewer
                                              ///< where the file would exceed 1.5 MB
  std::vector<ScenePolyline> lines;           ///< drawn over the surface, hidden behind it
  std::optional<ShownDeviation> deviation;    ///< needed by the colouring of that name
};

/// Static picture in parallel projection, one self-contained SVG file on white: shaded, isolines,
/// curvature or deviation in colours with a legend, zebra, isophotes or reflection lines; outlines,
/// borders and isolines without their hidden parts, axes and a scale bar. The patches are divided
/// where they bend, not by a mesh. Same input, same bytes. Of many points of a deviation 4,000 are
/// drawn: the farthest and others evenly. Errors: E103, E203 options out of range, E303 a line or a
/// surface that is not finite, E311 no patches, those of `check` for each patch.
[[nodiscard]] Result<std::string> surface_svg(const SurfaceModel& model,
                                              const SurfacePictureOptions& options = {},
                                              const RunContext& run = {});

}  // namespace obvid
