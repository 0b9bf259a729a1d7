// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "obvid/mesh/mesh_cut.h"

namespace obvid::exchange {

/// Puts a mesh together from what a file says; equal points become one.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::string_view name, bool needs_triangles = true)
      : name_(name), needs_triangles_(needs_triangles) {}

  /// A point of the file; its place in the mesh. -0 is 0.
  [[nodiscard]] std::uint32_t point(Vec3 p);
  /// Fan from the first corner; what has two equal corners is left out.
  void polygon(const std::vector<std::uint32_t>& corners);
  [[nodiscard]] Result<TriangleMesh> take();

  /// "name: what place"
  [[nodiscard]] Error error(ErrorCode code, std::string what, const std::string& place) const;

 private:
  struct Hash {
    std::size_t operator()(const std::array<std::uint64_t, 3>& bits) const;
  };
  std::string name_;
  bool needs_triangles_;  ///< points alone are no mesh
  TriangleMesh mesh_;
  std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, Hash> places_;
};

[[nodiscard]] Result<TriangleMesh> stl_mesh(std::string_view text, MeshBuilder& builder);
[[nodiscard]] Result<TriangleMesh> ply_mesh(std::string_view text, MeshBuilder& builder);
[[nodiscard]] Result<TriangleMesh> obj_mesh(std::string_view text, MeshBuilder& builder);

/// The words of a text line by line; numbers as files of meshes have them.
class MeshWords {
 public:
  explicit MeshWords(std::string_view text) : text_(text) {}
  /// The words of the next line that has some; false at the end.
  bool next();
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] std::string place() const { return "line " + std::to_string(line_); }
  /// Bytes that were read.
  [[nodiscard]] std::size_t position() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0, line_ = 0;
  std::vector<std::string_view> words_;
};

/// Three numbers from words[first]. Errors: E302, E303.
[[nodiscard]] Result<Vec3> vector_of(const MeshWords& line, std::size_t first,
                                     const MeshBuilder& builder);

}  // namespace obvid::exchange
