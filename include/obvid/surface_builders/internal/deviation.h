// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "obvid/core/run_context.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// Where a model is nearest to a point.
struct NearestPlace {
  std::size_t patch = 0;
  double u = 0.0, v = 0.0;
  Vec3 point;
  double distance = std::numeric_limits<double>::infinity();  ///< units
  double off = 0.0;     ///< the distance, negative on the side that du x dv points away from
  bool beside = false;  ///< not along the normal: the nearest place lies on a border, and the point
                        ///< beside the surface
};

/// Looks for the nearest places of a model, many times: spans of all patches in a tree of boxes,
/// Newton's steps in those that may hold a nearer place, and such spans divided until bounds leave
/// none that is nearer by more than 1e-10 of the model's size, or 1,000 are divided (beside centres
/// of curvature). The place is one of the model, so the true distance is not larger. Reentrant.
class NearestOnModel {
 public:
  /// `model` has to live as long as this, with one patch or more that `check` accepts.
  explicit NearestOnModel(const SurfaceModel& model);
  ~NearestOnModel();
  NearestOnModel(const NearestOnModel&) = delete;
  NearestOnModel& operator=(const NearestOnModel&) = delete;

  [[nodiscard]] NearestPlace at(Vec3 point) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// A place that was measured, and the place of the other model that is nearest to it.
struct MeasuredPlace {
  double off = 0.0;  ///< units; sign as of `NearestPlace`
  Vec3 point;
  std::size_t number = 0;   ///< of points: which one; of surfaces: the patch
  double u = 0.0, v = 0.0;  ///< of surfaces
  NearestPlace nearest;
};

/// How far points or a surface are from a model.
struct Deviation {
  std::size_t places = 0;         ///< points, or places of the raster
  MeasuredPlace least, most;      ///< of smallest and of greatest `off`
  double root_mean_square = 0.0;  ///< units, of surfaces over their area
  double mean = 0.0;              ///< likewise, with signs
  double beside = 0.0;         ///< share of the points, or of the area, that lies beside the model
  std::vector<double> offs{};  ///< of each point, in their order; empty for surfaces

  /// The place that is farthest off, on either side.
  [[nodiscard]] const MeasuredPlace& farthest() const {
    return -least.off > most.off ? least : most;
  }
};

/// Of points, one or more. Error: E103.
[[nodiscard]] Result<Deviation> deviation_of(const std::vector<Vec3>& points,
                                             const NearestOnModel& from, const RunContext& run);

/// Of a surface: about `samples` places per direction and patch, two or more in each span (in even
/// cells where a direction has more than 4 `samples` spans), and the extremes climbed to from the
/// best of them. Not proved: an extreme between the places can be missed. Error: E103.
[[nodiscard]] Result<Deviation> deviation_of(const SurfaceModel& model, const NearestOnModel& from,
                                             std::size_t samples, const RunContext& run);

}  // namespace obvid
