// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/internal/mesh_kind.h"

#include "obvid/core/internal/file_ending.h"

namespace obvid {

bool is_binary_stl(std::string_view head, std::uintmax_t size) {
  if (head.size() < kStlHead) return false;
  std::uintmax_t count = 0;  // little-endian
  for (std::size_t i = 1; i <= 4; ++i) {
    count = 256 * count + static_cast<unsigned char>(head[kStlHead - i]);
  }
  return size == kStlHead + kStlTriangle * count;
}

bool is_text_stl(std::string_view head) {
  // one without facets, too: its reader says so
  return head.starts_with("solid") && (head.find("facet") != std::string_view::npos ||
                                       head.find("endsolid") != std::string_view::npos);
}

bool is_ply(std::string_view head) {
  return head.starts_with("ply\n") || head.starts_with("ply\r");
}

bool is_mesh(std::string_view head, std::uintmax_t size, std::string_view name) {
  return is_ply(head) || is_binary_stl(head, size) || is_text_stl(head) || has_ending(name, ".obj");
}

}  // namespace obvid
