// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <sstream>
#include <utility>

#include "obvid/cad/cad.h"
#include "obvid/io/read_control_net.h"
#include "obvid/io/surface_json.h"
#include "obvid/pipeline/surface_job.h"

namespace obvid {
namespace {

Result<std::string> text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (file) return text.str();
  return fail({ErrorCode::kCannotOpen, "cannot read the file", path,
               "check the path and the permissions", -1, 0.0});
}

bool starts_with_brace(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{';
}

}  // namespace

Result<SurfaceModel> read_surface(const std::string& path, std::vector<std::string>& warnings) {
  const Result<std::string> text = text_of(path);
  if (!text) return fail(text.error());
  if (starts_with_brace(*text)) return surface_from_json(*text, path);
  if (!is_cad_text(*text)) return read_control_net(path);
  auto surfaces = read_cad_surfaces(path);
  if (!surfaces) return fail(surfaces.error());
  warnings.insert(warnings.end(), surfaces->warnings.begin(), surfaces->warnings.end());
  return std::move(surfaces->model);
}

}  // namespace obvid
