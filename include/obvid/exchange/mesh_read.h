// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/mesh/mesh_cut.h"

namespace obvid {

/// Whether the text is a mesh file by its content: PLY by its first word, STL by its header and
/// size; OBJ has no mark and is told by the ending of the name.
[[nodiscard]] bool is_mesh(std::string_view text, std::string_view name);

/// Triangles of an STL file (binary or text), a PLY file (text, or binary of either byte order) or
/// a Wavefront OBJ file. Polygons become fans of triangles from their first corner. Equal points
/// become one, so that neighbours share them; triangles with two equal corners are left out.
/// Lengths are as the file has them: none of these formats states a unit that can be trusted.
/// Errors, with line or byte: E202 no mesh file; E302 no number; E303 not finite; E304 no
/// triangles; E307 a count or index that does not fit the file; E310 a PLY property list or type
/// that is not known.
[[nodiscard]] Result<TriangleMesh> parse_mesh(std::string_view text, std::string_view name);
/// The points of such a file alone, each once, in the order of their first mention: scans are
/// stored without triangles too. Errors: as above, but for missing triangles.
[[nodiscard]] Result<std::vector<Vec3>> parse_mesh_points(std::string_view text,
                                                          std::string_view name);
/// Of a file. Errors: also those of `read_file`.
[[nodiscard]] Result<TriangleMesh> read_mesh(const std::string& path);

}  // namespace obvid
