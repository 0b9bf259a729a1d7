// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace obvid {

/// Layout of a binary STL file, bytes: a head whose last four are the number of triangles.
inline constexpr std::size_t kStlHead = 84;
inline constexpr std::size_t kStlTriangle = 50;  ///< 12 floats, 2 bytes of attributes

/// By its size: texts begin with "solid", and so do some binary files. `size` is that of the whole
/// file, `head` its first bytes.
[[nodiscard]] bool is_binary_stl(std::string_view head, std::uintmax_t size);
[[nodiscard]] bool is_text_stl(std::string_view head);
[[nodiscard]] bool is_ply(std::string_view head);

/// Whether a file is a mesh: PLY by its first word, STL by its head and size; OBJ has no mark and
/// is told by the ending of the name.
[[nodiscard]] bool is_mesh(std::string_view head, std::uintmax_t size, std::string_view name);

}  // namespace obvid
