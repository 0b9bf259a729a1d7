// SPDX-License-Identifier: Apache-2.0
#include "mesh/parts.h"

#include <fmt/format.h>

#include <cmath>

#include "obvid/exchange/internal/mesh/files.h"

namespace obvid {
namespace exchange {
namespace {

Error wrong(ErrorCode code, std::string what, std::size_t patch) {
  return {
      code, std::move(what), fmt::format("patch {}", patch), "", static_cast<std::ptrdiff_t>(patch),
      0.0};
}

Result<void> check_mesh(const Mesh& mesh, std::size_t patch) {
  for (const auto& t : mesh.triangles) {
    if (std::max({t[0], t[1], t[2]}) >= mesh.vertices.size()) {
      return fail(wrong(ErrorCode::kBadCount, "a triangle has a corner without a vertex", patch));
    }
  }
  for (const MeshVertex& v : mesh.vertices) {
    if (!is_finite(v.point) || !is_finite(v.normal) || !std::isfinite(v.u + v.v)) {
      return fail(wrong(ErrorCode::kNotFinite, "a vertex is not finite", patch));
    }
  }
  return {};
}

}  // namespace

Result<MeshCounts> counts_of(const SurfaceModel& model, const std::vector<Mesh>& meshes) {
  if (model.patches.size() != meshes.size()) {
    return error(ErrorCode::kBadCount,
                 fmt::format("{} meshes for {} patches", meshes.size(), model.patches.size()))
        .value(static_cast<double>(meshes.size()));
  }
  MeshCounts counts;
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    OBVID_TRY(check_mesh(meshes[p], p));
    counts.vertices += meshes[p].vertices.size();
    counts.triangles += meshes[p].triangles.size();
  }
  if (counts.triangles == 0) {
    return error(ErrorCode::kNothingThere, "there are no triangles to write");
  }
  return counts;
}

std::string plain_name(std::string_view name, std::string_view otherwise) {
  std::string plain;
  for (const char c : name) plain += c > ' ' && c <= '~' ? c : '_';
  return plain.find_first_not_of('_') == std::string::npos ? std::string(otherwise) : plain;
}

Error too_large(std::string_view format) {
  return error(ErrorCode::kSizeOutOfRange, fmt::format("more than {} can hold", format))
      .hint("allow a larger chord tolerance");
}

}  // namespace exchange

double single_precision_loss(const std::vector<Mesh>& meshes) {
  double loss = 0.0;
  for (const Mesh& mesh : meshes) {
    for (const MeshVertex& v : mesh.vertices) {
      const Vec3 p = v.point;
      const Vec3 single{static_cast<double>(static_cast<float>(p.x)),
                        static_cast<double>(static_cast<float>(p.y)),
                        static_cast<double>(static_cast<float>(p.z))};
      loss = std::max(loss, norm(single - p));
    }
  }
  return loss;
}

}  // namespace obvid
