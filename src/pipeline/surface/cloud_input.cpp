// SPDX-License-Identifier: Apache-2.0
#include "surface/cloud_input.h"

#include <filesystem>
#include <utility>

#include "obvid/core/files.h"
#include "obvid/core/internal/file_ending.h"
#include "obvid/exchange/mesh_read.h"
#include "obvid/io/internal/file_kind.h"
#include "obvid/pipeline/import.h"

namespace obvid::pipeline_detail {

Result<PointCloud> cloud_of(const SurfaceInput& input) {
  if (input.points) return PointCloud{*input.points, {}};
  std::string text;
  if (input.text) {
    text = *input.text;
  } else {
    auto read = read_file(input.name);
    OBVID_TRY(read);
    text = std::move(*read);
  }
  if (!is_mesh(text, input.name)) return parse_cloud(text, input.name);
  auto points = parse_mesh_points(text, input.name);
  OBVID_TRY(points);
  PointCloud out;
  out.points.name = std::filesystem::path(input.name).stem().string();
  out.points.points = std::move(*points);
  return out;
}

bool holds_surface(const std::string& text, const std::string& name) {
  if (is_mesh(text, name)) return false;
  if (is_json_text(text)) return true;
  return needs_cad(text) || has_ending(name, ".cpt .cptw");
}

}  // namespace obvid::pipeline_detail
