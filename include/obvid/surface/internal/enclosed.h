// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/surface/surface.h"

namespace obvid {

/// A volume, and what a relative error of 1 in all coordinates would make of it.
struct SignedVolume {
  double value = 0.0, size = 0.0;
  /// +1 or -1; 0 where rounding decides.
  [[nodiscard]] int sign() const;
  SignedVolume& operator+=(const SignedVolume& other);
};

/// Volume between a surface and a point, positive where du x dv points away from that: of triangles
/// between places of the surface, up to the accuracy of a sign.
[[nodiscard]] SignedVolume volume_from(const NurbsSurface& surface, Vec3 apex);

/// Volume that patches enclose, each of which goes on at its border u = end in the next one, the
/// last in the first (one patch alone also across v), with fans of triangles over both open ends:
/// positive where normals du x dv point out of it. None where they do not close.
[[nodiscard]] std::optional<SignedVolume> enclosed_volume(const std::vector<SurfacePatch>& patches);

/// Lets u of all patches run backwards where they close around a volume (`enclosed_volume`) and
/// their normals point into it. Patches with trims stay. Returns whether they were turned.
bool turn_outward(std::vector<SurfacePatch>& patches);

}  // namespace obvid
