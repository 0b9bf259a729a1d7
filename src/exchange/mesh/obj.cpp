// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <iterator>
#include <unordered_map>

#include "mesh/parts.h"
#include "obvid/core/internal/format_into.h"
#include "obvid/exchange/internal/mesh/files.h"

namespace obvid {
namespace {

struct HashOfPoint {
  std::size_t operator()(const Vec3& p) const {
    const std::hash<double> hash;                      // of 0 and -0 the same, as == has it
    constexpr std::size_t kMix = 0x9E3779B97F4A7C15U;  // golden ratio: spreads neighbours
    return (hash(p.x) * kMix + hash(p.y)) * kMix + hash(p.z);
  }
};

class ObjWriter {
 public:
  explicit ObjWriter(Watch* watch) : questions_(watch, exchange::kItemsOfMesh) {}

  std::string take() { return std::move(text_); }

  void head(const SurfaceModel& model) {
    add("# Wavefront OBJ by obvid: {}\n# unit {}\n", exchange::plain_name(model.name, "surface"),
        exchange::plain_name(model.units.text(), "units"));
  }

  void patch(const SurfacePatch& patch, const Mesh& mesh, std::size_t number) {
    if (mesh.triangles.empty()) {
      add("# patch {} has no triangles\n", number);
      return;
    }
    add("o {}\n", exchange::plain_name(patch.name, fmt::format("patch_{}", number)));
    const std::vector<std::size_t> points = add_points(mesh);
    const exchange::TextureMap texture(patch.surface);
    for (const MeshVertex& v : mesh.vertices) {
      if (questions_.end()) return;
      add("vt {:.9g} {:.9g}\n", texture.s(v), texture.t(v));
    }
    for (const MeshVertex& v : mesh.vertices) {
      if (questions_.end()) return;
      add("vn {:.7g} {:.7g} {:.7g}\n", v.normal.x, v.normal.y, v.normal.z);
    }
    for (const auto& t : mesh.triangles) {
      if (questions_.end()) return;
      add("f {0}/{1}/{1} {2}/{3}/{3} {4}/{5}/{5}\n", points[t[0]], corners_ + t[0] + 1,
          points[t[1]], corners_ + t[1] + 1, points[t[2]], corners_ + t[2] + 1);
    }
    corners_ += mesh.vertices.size();
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    format_into(text_, format, std::forward<Args>(args)...);
  }

  /// Numbers of the mesh's points; those that a neighbour has written keep theirs.
  std::vector<std::size_t> add_points(const Mesh& mesh) {
    std::vector<std::size_t> numbers;
    numbers.reserve(mesh.vertices.size());
    for (const MeshVertex& v : mesh.vertices) {
      if (questions_.end()) break;
      const auto [place, is_new] = points_.try_emplace(v.point, points_.size() + 1);
      numbers.push_back(place->second);
      if (is_new) add("v {} {} {}\n", v.point.x, v.point.y, v.point.z);
    }
    return numbers;
  }

  Questions questions_;
  std::string text_;
  std::unordered_map<Vec3, std::size_t, HashOfPoint> points_;
  std::size_t corners_ = 0;  ///< normals and texture coordinates so far
};

}  // namespace

Result<std::string> obj_mesh_text(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                                  Watch* watch) {
  OBVID_TRY(exchange::counts_of(model, meshes));
  ObjWriter writer(watch);
  writer.head(model);
  for (std::size_t p = 0; p < meshes.size(); ++p) writer.patch(model.patches[p], meshes[p], p + 1);
  if (has_ended(watch)) return fail(cancelled_error());
  return writer.take();
}

}  // namespace obvid
