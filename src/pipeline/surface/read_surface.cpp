// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "files/cad_of_text.h"
#include "obvid/cad/internal/cad.h"
#include "obvid/core/files.h"
#include "obvid/io/internal/file_kind.h"
#include "obvid/io/internal/read_control_net.h"
#include "obvid/io/surface_json.h"
#include "obvid/pipeline/surface_job.h"

namespace obvid {
namespace {

/// With all trims.
Result<SurfaceModel> read_trimmed(const SurfaceInput& input, std::vector<std::string>& warnings,
                                  const RunContext& run) {
  const std::string& path = input.name;
  if (input.points) {
    return error(ErrorCode::kUnsupported, "points are no surface")
        .where(path)
        .hint("give a stored surface");
  }
  const Result<std::string> text = input.text ? *input.text : read_file(path);
  OBVID_TRY(text);
  if (is_json_text(*text)) {
    Watch watch(without_progress(run));
    return surface_from_json(*text, path, &watch);
  }
  if (!needs_cad(*text)) {
    auto net = parse_control_net(*text, path);
    if (!net) return net;
    net->name = std::filesystem::path(path).stem().string();
    if (text->find("patch") == std::string::npos) {  // Bezier patches say theirs by their numbers
      const NurbsSurface& first = net->patches.front().surface;
      warnings.push_back(
          fmt::format("{}: the file states no degrees; {} x {} with uniform knots is assumed", path,
                      first.degree_u, first.degree_v));
    }
    return net;
  }
  const CadRun cad{{}, run.cancelled};
  auto surfaces = input.text ? pipeline_detail::cad_of_text(*text, path, &read_cad_surfaces, cad)
                             : read_cad_surfaces(path, cad);
  OBVID_TRY(surfaces);
  warnings.insert(warnings.end(), surfaces->warnings.begin(), surfaces->warnings.end());
  return std::move(surfaces->model);
}

}  // namespace

Result<SurfaceModel> read_surface(const SurfaceInput& input, std::vector<std::string>& warnings,
                                  const RunContext& run) {
  OBVID_TRY(may_go_on(run));
  return read_trimmed(input, warnings, run);
}

}  // namespace obvid
