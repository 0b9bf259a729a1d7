// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <limits>

#include "mesh/parts.h"
#include "obvid/exchange/internal/mesh/files.h"

namespace obvid {

Result<std::string> ply_text(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                             Watch* watch) {
  auto counts = exchange::counts_of(model, meshes);
  OBVID_TRY(counts);
  // readers take indices for signed numbers
  if (counts->vertices > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    return fail(exchange::too_large("PLY"));
  }
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment by obvid: {}\ncomment unit {}\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property float s\nproperty float t\n"
      "element face {}\nproperty list uchar int vertex_indices\nproperty int patch\nend_header\n",
      exchange::plain_name(model.name, "surface"),
      exchange::plain_name(model.units.text(), "units"), counts->vertices, counts->triangles);
  Questions questions(watch, exchange::kItemsOfMesh);
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    const exchange::TextureMap texture(model.patches[p].surface);
    for (const MeshVertex& v : meshes[p].vertices) {
      if (questions.end()) return fail(cancelled_error());
      exchange::put(out, v.point.x);
      exchange::put(out, v.point.y);
      exchange::put(out, v.point.z);
      exchange::put_single(out, v.normal);
      exchange::put(out, static_cast<float>(texture.s(v)));
      exchange::put(out, static_cast<float>(texture.t(v)));
    }
  }
  std::uint32_t first = 0;
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    for (const auto& t : meshes[p].triangles) {
      if (questions.end()) return fail(cancelled_error());
      exchange::put(out, std::uint8_t{3});
      for (const std::uint32_t v : t) exchange::put(out, first + v);
      exchange::put(out, static_cast<std::uint32_t>(p));
    }
    first += static_cast<std::uint32_t>(meshes[p].vertices.size());
  }
  return out;
}

}  // namespace obvid
