// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/picture/surface_svg.h"
#include "obvid/surface/nurbs_surface.h"

namespace obvid::picture {

struct PrincipalCurvatures {
  double k1 = 0.0, k2 = 0.0;  ///< 1/unit
};

/// Curvature at a point of a surface of this size (`size_of`); at poles and collapsed edges that
/// close by.
[[nodiscard]] SurfaceCurvature curvature_at(const NurbsSurface& surface, double size, double u,
                                            double v);
/// Principal curvatures there, finite.
[[nodiscard]] PrincipalCurvatures principal_at(const NurbsSurface& surface, double size, double u,
                                               double v);

/// Of the four curvature colourings; 0 for the others.
[[nodiscard]] double quantity(SurfaceColouring colouring, PrincipalCurvatures k);
/// Curvature or deviation: colours of a scale with a legend.
[[nodiscard]] bool has_scale(SurfaceColouring colouring);
/// "Gaussian curvature", ...
[[nodiscard]] std::string_view title_of(SurfaceColouring colouring);
/// "1/mm²" or "1/mm", "mm" of deviations.
[[nodiscard]] std::string unit_of(SurfaceColouring colouring, const std::string& units);

/// Which sides (`PatchSide`) of each patch are edges: not those that shrink to a point, nor those
/// where a closed patch goes on smoothly on the other side.
[[nodiscard]] std::vector<std::array<bool, 4>> real_borders(const SurfaceModel& model);

/// A value and the area that it stands for.
struct WeighedValue {
  double value = 0.0;
  double weight = 0.0;
};

/// Range of colours. One hot spot does not flatten all the rest: `low` and `high` leave out the
/// outermost parts of the area, `least` and `most` are the extremes.
struct ValueScale {
  double low = 0.0, high = 0.0;  ///< equal where the value is the same everywhere
  double least = 0.0, most = 0.0;
  bool diverging = false;  ///< 0 stands in the middle
  [[nodiscard]] bool constant() const { return !(high > low); }
};

/// Values whose size is below `resolution` count as 0.
[[nodiscard]] ValueScale value_scale(std::vector<WeighedValue> values, double resolution);
/// Errors: E203 wanted, but nothing was measured; E303 a point that is not finite.
[[nodiscard]] Result<void> check_deviation(SurfaceColouring colouring,
                                           const std::optional<ShownDeviation>& deviation);
/// Deviation at so many places, on all processors. Error: E103.
[[nodiscard]] Result<std::vector<double>> offs_at(const ShownDeviation& deviation,
                                                  std::size_t count,
                                                  const std::function<Vec3(std::size_t)>& place,
                                                  const RunContext& run);
/// Of measured points; `size` of what is shown.
[[nodiscard]] ValueScale scale_of_dots(const std::vector<SceneDot>& dots, double size);
/// So many of them that a picture stays light: the farthest off, and others evenly.
[[nodiscard]] std::vector<SceneDot> shown_dots(const std::vector<SceneDot>& dots,
                                               std::size_t most = 4000);
/// What is 0 within rounding for a surface of this size.
[[nodiscard]] double resolution_of(SurfaceColouring colouring, double size);

using Rgb = std::array<std::uint8_t, 3>;
/// Colour at a part in [0, 1] of a scale.
[[nodiscard]] Rgb palette(bool diverging, double part);
[[nodiscard]] std::string hex(Rgb colour);

/// Text that is valid UTF-8 without control characters, whatever came in.
[[nodiscard]] std::string plain_text(std::string_view text);
/// Number for reading: no trailing zeros, minus as a dash, far from 1 as a·10ⁿ.
[[nodiscard]] std::string readable(double value, int digits);
/// "12 x 30 x 4 mm": edges of a box, with signs of multiplication.
[[nodiscard]] std::string size_text(Vec3 size, const std::string& units);

}  // namespace obvid::picture
