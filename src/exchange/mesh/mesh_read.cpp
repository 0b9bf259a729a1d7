// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/mesh_read.h"

#include <cstdint>
#include <cstring>
#include <utility>

#include "mesh/mesh_builder.h"
#include "mesh/mesh_bytes.h"
#include "obvid/core/files.h"
#include "obvid/io/internal/mesh_kind.h"

namespace obvid {
namespace exchange {
namespace {

constexpr std::size_t kStlCorners = 12;  // bytes of the normal before them

Result<TriangleMesh> binary_stl(std::string_view text, MeshBuilder& builder) {
  for (std::size_t at = kStlHead; at < text.size(); at += kStlTriangle) {
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t first = at + kStlCorners + 12 * k;
      const auto number = [&](std::size_t i) {
        return static_cast<double>(bytes_as<float>(text, first + 4 * i, true));
      };
      const Vec3 p{number(0), number(1), number(2)};
      if (!is_finite(p)) {
        return fail(builder.error(ErrorCode::kNotFinite, "a coordinate is not finite",
                                  "byte " + std::to_string(first)));
      }
      corners.push_back(builder.point(p));
    }
    builder.polygon(corners);
  }
  return builder.take();
}

Result<TriangleMesh> text_stl(std::string_view text, MeshBuilder& builder) {
  MeshWords lines(text);
  std::vector<std::uint32_t> corners;
  while (lines.next()) {
    const std::string_view word = lines.words().front();
    if (word == "vertex") {
      const auto p = vector_of(lines, 1, builder);
      OBVID_TRY(p);
      corners.push_back(builder.point(*p));
    } else if (word == "endloop") {
      if (corners.size() != 3) {
        return fail(
            builder.error(ErrorCode::kBadCount, "a facet has three corners", lines.place()));
      }
      builder.polygon(corners);
      corners.clear();
    }
  }
  if (!corners.empty()) {
    return fail(builder.error(ErrorCode::kBadCount, "the file ends within a facet", lines.place()));
  }
  return builder.take();
}

}  // namespace

Result<TriangleMesh> stl_mesh(std::string_view text, MeshBuilder& builder) {
  return is_binary_stl(text, text.size()) ? binary_stl(text, builder) : text_stl(text, builder);
}

/// Corners are v, v/vt, v//vn or v/vt/vn; negative ones count back from the last point.
Result<TriangleMesh> obj_mesh(std::string_view text, MeshBuilder& builder) {
  MeshWords lines(text);
  std::vector<std::uint32_t> places;  // of the points of the file
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v") {
      const auto p = vector_of(lines, 1, builder);
      OBVID_TRY(p);
      places.push_back(builder.point(*p));
    } else if (words[0] == "f") {
      std::vector<std::uint32_t> corners;
      for (std::size_t k = 1; k < words.size(); ++k) {
        const std::string word(words[k].substr(0, words[k].find('/')));
        char* end = nullptr;
        const long long index = std::strtoll(word.c_str(), &end, 10);
        const auto count = static_cast<long long>(places.size());
        const long long at = index < 0 ? count + index : index - 1;
        if (word.empty() || *end != '\0' || at < 0 || at >= count) {
          return fail(builder.error(ErrorCode::kBadCount, "there is no point '" + word + "'",
                                    lines.place()));
        }
        corners.push_back(places[static_cast<std::size_t>(at)]);
      }
      if (corners.size() < 3) {
        return fail(builder.error(ErrorCode::kBadCount, "a face has three corners at least",
                                  lines.place()));
      }
      builder.polygon(corners);
    }
  }
  return builder.take();
}

}  // namespace exchange

bool is_mesh(std::string_view text, std::string_view name) {
  return is_mesh(text, text.size(), name);
}

namespace {

Result<TriangleMesh> mesh_of(std::string_view text, std::string_view name,
                             exchange::MeshBuilder& builder) {
  if (is_ply(text)) {
    return exchange::ply_mesh(text, builder);
  }
  if (is_binary_stl(text, text.size()) || is_text_stl(text)) {
    return exchange::stl_mesh(text, builder);
  }
  if (is_mesh(text, name)) return exchange::obj_mesh(text, builder);
  return fail({ErrorCode::kUnknownFormat, "this is no mesh", std::string(name),
               "meshes are STL, PLY and OBJ files; a binary STL whose size does not fit its number "
               "of triangles is damaged"});
}

}  // namespace

Result<TriangleMesh> parse_mesh(std::string_view text, std::string_view name) {
  exchange::MeshBuilder builder(name);
  return mesh_of(text, name, builder);
}

Result<std::vector<Vec3>> parse_mesh_points(std::string_view text, std::string_view name) {
  exchange::MeshBuilder builder(name, false);
  return mesh_of(text, name, builder).map([](TriangleMesh mesh) { return std::move(mesh.points); });
}

Result<TriangleMesh> read_mesh(const std::string& path) {
  const Result<std::string> text = read_file(path);
  OBVID_TRY(text);
  return parse_mesh(*text, path);
}

}  // namespace obvid
