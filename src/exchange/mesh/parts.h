// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/internal/questions.h"
#include "obvid/core/result.h"
#include "obvid/mesh/mesh.h"
#include "obvid/surface/surface.h"

namespace obvid::exchange {

/// Points or triangles written between two questions whether the work goes on.
inline constexpr std::size_t kItemsOfMesh = 4096;

/// Numbers in little endian, whatever the machine has.
template <class T>
void put(std::string& out, T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

/// Rounded to the nearest floats.
[[nodiscard]] inline Vec3 single(Vec3 p) {
  return {static_cast<double>(static_cast<float>(p.x)),
          static_cast<double>(static_cast<float>(p.y)),
          static_cast<double>(static_cast<float>(p.z))};
}

inline void put_single(std::string& out, Vec3 p) {
  put(out, static_cast<float>(p.x));
  put(out, static_cast<float>(p.y));
  put(out, static_cast<float>(p.z));
}

struct MeshCounts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

/// Sums of all meshes; the common errors of mesh files.
[[nodiscard]] Result<MeshCounts> counts_of(const SurfaceModel& model,
                                           const std::vector<Mesh>& meshes);

/// Parameters over their ranges, in [0, 1].
struct TextureMap {
  explicit TextureMap(const NurbsSurface& surface) : u(domain_u(surface)), v(domain_v(surface)) {}
  [[nodiscard]] double s(const MeshVertex& at) const { return part(u, at.u); }
  [[nodiscard]] double t(const MeshVertex& at) const { return part(v, at.v); }

 private:
  static double part(const Range& range, double at) {
    return std::clamp((at - range.from) / range.length(), 0.0, 1.0);
  }
  Range u, v;
};

/// A name of printable ASCII without spaces; `otherwise` when nothing is left.
[[nodiscard]] std::string plain_name(std::string_view name, std::string_view otherwise);

[[nodiscard]] Error too_large(std::string_view format);

}  // namespace obvid::exchange
