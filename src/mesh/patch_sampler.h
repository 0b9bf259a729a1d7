// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "obvid/surface/nurbs_surface.h"
#include "patch_axis.h"

namespace obvid::mesh {

/// A point of the surface with its normal of length 1 (zero only where no limit is found).
struct Sample {
  Vec3 point;
  Vec3 normal;
};

/// Evaluates one patch from a chosen side of its knots. Keeps references: the surface outlives it.
class PatchSampler {
 public:
  explicit PatchSampler(const NurbsSurface& surface);

  [[nodiscard]] const PatchAxis& u() const { return u_; }
  [[nodiscard]] const PatchAxis& v() const { return v_; }
  [[nodiscard]] const NurbsSurface& surface() const { return surface_; }

  [[nodiscard]] SurfacePoint at(const Place& u, const Place& v) const;
  [[nodiscard]] Sample sample(const Place& u, const Place& v) const;
  /// All (us[i], vs[j]) at out[j * us.size() + i]; us ascend.
  void block(std::span<const Place> us, std::span<const Place> vs, std::vector<Sample>& out);

 private:
  [[nodiscard]] Vec3 normal_at(const SurfacePoint& p, const Place& u, const Place& v) const;
  [[nodiscard]] bool is_regular(const SurfacePoint& p) const;
  void condense(const SpanBasis& b, std::size_t from, std::size_t to);
  [[nodiscard]] SurfacePoint on_lines(const SpanBasis& b, std::size_t from) const;

  const NurbsSurface& surface_;
  PatchAxis u_, v_;
  std::size_t count_u_;
  Vec3 origin_{};  ///< points are summed from here, so that derivatives keep digits far from 0
  bool weighted_;
  double least_du_, least_dv_;  ///< derivatives below are rounding
  std::vector<SpanBasis> columns_;
  std::vector<Vec3> here_, slope_;        ///< the net condensed along v: numerators,
  std::vector<double> here_w_, slope_w_;  ///< weights
};

}  // namespace obvid::mesh
