// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/picture/surface_svg.h"
#include "page/values.h"

namespace obvid::picture {

/// A patch divided into quadrilaterals, finer where it bends: vertex i of row j stands at
/// j * us.size() + i. A trimmed patch has one for each of its bands.
struct DrawnPatch {
  std::size_t patch = 0;       ///< of the model
  std::vector<double> us, vs;  ///< parameters; of a band: parts of it
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
  std::vector<double> values;  ///< of a curvature colouring, else empty

  [[nodiscard]] std::size_t vertex(std::size_t i, std::size_t j) const { return j * us.size() + i; }
};

/// About `most_facets` cells in all, at least one of each patch, in the order of the patches; of
/// trimmed patches more. Where the watch says stop, not all of them.
[[nodiscard]] std::vector<DrawnPatch> drawn_patches(const SurfaceModel& model,
                                                    SurfaceColouring colouring,
                                                    std::size_t most_facets, Watch* watch);

/// Range of the values of all patches, weighed by area.
[[nodiscard]] ValueScale scale_of(const std::vector<DrawnPatch>& patches,
                                  SurfaceColouring colouring);

}  // namespace obvid::picture
