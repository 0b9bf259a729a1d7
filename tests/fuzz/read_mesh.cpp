// SPDX-License-Identifier: Apache-2.0
// Any bytes give triangles whose corners are there and finite, or an error that says where;
// whatever mesh that is, a plane cuts it into chains of finite points.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "obvid/exchange/mesh_read.h"
#include "obvid/mesh/mesh_cut.h"
#include "promise.h"

namespace obvid {
namespace {

bool finite_point(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void require_triangles(const TriangleMesh& mesh) {
  require(!mesh.triangles.empty());
  for (const Vec3 p : mesh.points) require(finite_point(p));
  for (const auto& corners : mesh.triangles) {
    for (const std::uint32_t i : corners) require(i < mesh.points.size());
    require(corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]);
  }
}

void require_sections(const TriangleMesh& mesh) {
  const auto box = bounds_of(mesh);
  require(box.has_value());
  const Vec3 middle{0.0, 0.0, 0.5 * box->low.z + 0.5 * box->high.z};
  const auto sections = cut_mesh(mesh, {middle});
  require(sections.has_value());
  for (const MeshSection& section : *sections) {
    require(section.points.size() > 1);
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      require(is_finite(section.points[i]));
      require(i == 0 || section.points[i] != section.points[i - 1]);
    }
  }
}

}  // namespace
}  // namespace obvid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace obvid;
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  const auto mesh = parse_mesh(text, is_mesh(text, "fuzz") ? "fuzz" : "fuzz.obj");
  if (!mesh) {
    const int code = exit_code(mesh.error().code);
    require(code == 2 || code == 3);
    require(!mesh.error().what.empty() && !mesh.error().where.empty());
    return 0;
  }
  require_triangles(*mesh);
  require_sections(*mesh);
  return 0;
}
