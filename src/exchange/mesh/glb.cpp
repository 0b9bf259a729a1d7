// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 in one file: a header, a chunk of JSON, a chunk of numbers.
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "mesh/parts.h"
#include "obvid/exchange/internal/mesh/files.h"
#include "obvid/geom/internal/box.h"

namespace obvid {
namespace {

using nlohmann::json;

// Numbers of the format.
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kDataChunk = 0x004E4942;  // "BIN"
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;
constexpr int kTriangles = 4;
constexpr std::size_t kGlbHeader = 12, kChunkHeader = 8;  // bytes

json as_json(Vec3 p) { return json::array({p.x, p.y, p.z}); }

class GlbWriter {
 public:
  GlbWriter(const SurfaceModel& model, const std::vector<Mesh>& meshes, double metres, Watch* watch)
      : model_(model),
        meshes_(meshes),
        metres_(metres),
        watch_(watch),
        questions_(watch, exchange::kItemsOfMesh) {
    Box3 box;
    for (const Mesh& mesh : meshes) {
      for (const MeshVertex& v : mesh.vertices) box.add(v.point);
    }
    middle_ = box.middle();
  }

  Result<std::string> run() {
    head();
    for (std::size_t p = 0; p < meshes_.size(); ++p) {
      if (meshes_[p].triangles.empty()) continue;
      const bool held = add_mesh(p);
      if (has_ended(watch_)) return fail(cancelled_error());
      if (!held) return fail(exchange::too_large("glTF"));
    }
    document_["buffers"] = json::array({{{"byteLength", data_.size()}}});
    std::string text = document_.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');  // chunks end at multiples of 4
    const std::size_t size = kGlbHeader + 2 * kChunkHeader + text.size() + data_.size();
    if (size > std::numeric_limits<std::uint32_t>::max()) return fail(exchange::too_large("glTF"));
    return assembled(text, static_cast<std::uint32_t>(size));
  }

 private:
  /// The node above all patches: z up becomes y up, units become metres, the middle its place.
  void head() {
    const double scale = metres_;
    const double half = std::numbers::sqrt2 / 2.0;
    json root = {{"name", model_.name},
                 {"rotation", json::array({-half, 0.0, 0.0, half})},
                 {"scale", json::array({scale, scale, scale})},
                 {"translation", as_json(scale * Vec3{middle_.x, middle_.z, -middle_.y})},
                 {"extras",
                  {{"units", model_.units.name}, {"units_source", to_string(model_.units.source)}}},
                 {"children", json::array()}};
    document_ = {
        {"asset", {{"version", "2.0"}, {"generator", "obvid"}}},
        {"scene", 0},
        {"scenes", json::array({{{"nodes", json::array({0})}}})},
        {"nodes", json::array({std::move(root)})},
        {"meshes", json::array()},
        {"materials", json::array({{{"name", "surface"},
                                    {"doubleSided", true},
                                    {"pbrMetallicRoughness",
                                     {{"baseColorFactor", json::array({0.6, 0.7, 0.8, 1.0})},
                                      {"metallicFactor", 0.1},
                                      {"roughnessFactor", 0.5}}}}})},
        {"accessors", json::array()},
        {"bufferViews", json::array()}};
  }

  /// Describes the numbers from `from` to the end of the data.
  std::size_t accessor(std::size_t from, int target, json what) {
    json& views = document_["bufferViews"];
    views.push_back({{"buffer", 0},
                     {"byteOffset", from},
                     {"byteLength", data_.size() - from},
                     {"target", target}});
    what["bufferView"] = views.size() - 1;
    document_["accessors"].push_back(std::move(what));
    return document_["accessors"].size() - 1;
  }

  std::size_t floats(std::size_t from, const char* type, std::size_t count) {
    return accessor(from, kArrayBuffer,
                    {{"componentType", kFloat}, {"type", type}, {"count", count}});
  }

  bool add_mesh(std::size_t p) {
    const Mesh& mesh = meshes_[p];
    const std::size_t count = mesh.vertices.size();
    std::size_t from = data_.size();
    Box3 box;
    for (const MeshVertex& v : mesh.vertices) {
      if (questions_.end()) return false;
      box.add(exchange::single(v.point - middle_));
      exchange::put_single(data_, v.point - middle_);
    }
    if (!is_finite(box.low) || !is_finite(box.high)) return false;
    json attributes;
    attributes["POSITION"] = accessor(from, kArrayBuffer,
                                      {{"componentType", kFloat},
                                       {"type", "VEC3"},
                                       {"count", count},
                                       {"min", as_json(box.low)},
                                       {"max", as_json(box.high)}});
    from = data_.size();
    for (const MeshVertex& v : mesh.vertices) {
      if (questions_.end()) return false;
      exchange::put_single(data_, v.normal);
    }
    attributes["NORMAL"] = floats(from, "VEC3", count);
    from = data_.size();
    const exchange::TextureMap texture(model_.patches[p].surface);
    for (const MeshVertex& v : mesh.vertices) {
      if (questions_.end()) return false;
      exchange::put(data_, static_cast<float>(texture.s(v)));
      exchange::put(data_, static_cast<float>(texture.t(v)));
    }
    attributes["TEXCOORD_0"] = floats(from, "VEC2", count);
    from = data_.size();
    for (const auto& t : mesh.triangles) {
      if (questions_.end()) return false;
      for (const std::uint32_t v : t) exchange::put(data_, v);
    }
    const std::size_t indices = accessor(from, kElementBuffer,
                                         {{"componentType", kUnsignedInt},
                                          {"type", "SCALAR"},
                                          {"count", 3 * mesh.triangles.size()}});
    add_node(p, {{"attributes", std::move(attributes)},
                 {"indices", indices},
                 {"material", 0},
                 {"mode", kTriangles}});
    return data_.size() <= std::numeric_limits<std::uint32_t>::max();
  }

  void add_node(std::size_t p, json primitive) {
    const std::string& given = model_.patches[p].name;
    const std::string name = given.empty() ? "patch " + std::to_string(p + 1) : given;
    json& all = document_["meshes"];
    all.push_back({{"name", name}, {"primitives", json::array({std::move(primitive)})}});
    json& nodes = document_["nodes"];
    nodes.push_back({{"name", name}, {"mesh", all.size() - 1}});
    nodes[0]["children"].push_back(nodes.size() - 1);
  }

  [[nodiscard]] std::string assembled(const std::string& text, std::uint32_t size) const {
    std::string out;
    out.reserve(size);
    exchange::put(out, kMagic);
    exchange::put(out, std::uint32_t{2});
    exchange::put(out, size);
    exchange::put(out, static_cast<std::uint32_t>(text.size()));
    exchange::put(out, kJsonChunk);
    out += text;
    exchange::put(out, static_cast<std::uint32_t>(data_.size()));
    exchange::put(out, kDataChunk);
    out += data_;  // numbers of 4 bytes: ends at a multiple of 4
    return out;
  }

  const SurfaceModel& model_;
  const std::vector<Mesh>& meshes_;
  double metres_;  ///< in a unit of the model
  Watch* watch_;
  Questions questions_;
  Vec3 middle_;
  json document_;
  std::string data_;
};

}  // namespace

Result<std::string> glb_text(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                             Watch* watch) {
  OBVID_TRY(exchange::counts_of(model, meshes));
  const auto metres = unit_ratio(model.units, "m", "glTF files");
  OBVID_TRY(metres);
  return GlbWriter(model, meshes, *metres, watch).run();
}

}  // namespace obvid
