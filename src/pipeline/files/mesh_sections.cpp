// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/mesh_sections.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/exchange/mesh_read.h"
#include "obvid/mesh/mesh_cut.h"

namespace obvid::pipeline_detail {
namespace {

constexpr int kBoundDigits = 6;  // of bounds in messages

/// From where to where the mesh lies along the axis.
std::string extent_text(const TriangleMesh& mesh, char axis) {
  const auto bounds = bounds_of(mesh);
  if (!bounds) return {};
  const Vec3 normal = plane_across(axis, 0.0).normal();
  const double low = dot(bounds->low, normal), high = dot(bounds->high, normal);
  if (low == high) return fmt::format("{} = {} alone", axis, significant(low, kBoundDigits));
  return fmt::format("{} = {} to {}", axis, significant(low, kBoundDigits),
                     significant(high, kBoundDigits));
}

/// Axes across which planes lie, each once.
std::string axes_of(const std::vector<PlaneRow>& planes) {
  std::string out;
  for (const PlaneRow& row : planes) {
    if (out.find(row.axis) == std::string::npos) out += row.axis;
  }
  return out;
}

/// Where a mesh lies that has no extent along the axis.
std::optional<double> flat_at(const TriangleMesh& mesh, char axis) {
  const auto bounds = bounds_of(mesh);
  if (!bounds) return std::nullopt;
  const Vec3 normal = plane_across(axis, 0.0).normal();
  const double low = dot(bounds->low, normal), high = dot(bounds->high, normal);
  return low == high ? std::optional(low) : std::nullopt;
}

/// An axis across which a plane lies in a mesh that is flat there.
std::optional<char> flat_across(const TriangleMesh& mesh, const std::vector<PlaneRow>& planes) {
  for (const PlaneRow& row : planes) {
    const auto flat = flat_at(mesh, row.axis);
    for (std::size_t i = 0; flat && i < row.count(); ++i) {
      if (row.at(i) == *flat) return row.axis;
    }
  }
  return std::nullopt;
}

Error missed(const TriangleMesh& mesh, const std::vector<PlaneRow>& planes,
             const std::string& path) {
  std::string lies;
  for (const char axis : axes_of(planes)) {
    lies += (lies.empty() ? "it lies at " : " and ") + extent_text(mesh, axis);
  }
  if (const auto axis = flat_across(mesh, planes)) {
    return {ErrorCode::kNothingThere,
            fmt::format("all of the mesh lies in the plane {}: it has no sections there",
                        plane_name(*axis, *flat_at(mesh, *axis))),
            path, "cut it across another axis"};
  }
  return {ErrorCode::kNothingThere, "no plane of --cut meets the mesh", path, lies};
}

Error uncut(const TriangleMesh& mesh, const std::string& path) {
  return {ErrorCode::kNothingThere, "a mesh has no curve until a plane cuts it", path,
          fmt::format("say where: --cut z=12 for one plane, --cut z=FROM:STEP:TO for many, x and y "
                      "likewise; it lies at {}, {} and {}",
                      extent_text(mesh, 'x'), extent_text(mesh, 'y'), extent_text(mesh, 'z'))};
}

PointSeries series_of(const MeshSection& section, std::string name) {
  PointSeries out;
  out.name = std::move(name);
  out.points = section.points;
  if (section.closed) out.points.push_back(section.points.front());
  return out;
}

/// Which coordinates points of the sections have, where these are not x and y.
std::string coordinates_text(const std::vector<PlaneRow>& planes) {
  std::string text;
  for (const char axis : axes_of(planes)) {
    if (axis == 'z') continue;
    text += fmt::format(
        "{}points of sections {}=... have {}", text.empty() ? "" : ", ", axis,
        axis == 'x' ? "y and z of the mesh as x and y" : "z and x of the mesh as x and y");
  }
  return text;
}

/// What scanners write: points without triangles. Those of a slice are a series.
Result<Drawing> series_of_cloud(const TriangleMesh& cloud, const std::string& path,
                                const std::vector<PlaneRow>& planes) {
  if (!planes.empty()) {
    return error(ErrorCode::kBadOption, "planes cut triangles, and " + path + " has points alone")
        .where("--cut")
        .hint("leave it out where they are one slice, or give the mesh of the scan");
  }
  Drawing out;
  out.name = std::filesystem::path(path).filename().string();
  for (const char axis : {'z', 'x', 'y'}) {
    const auto at = flat_at(cloud, axis);
    if (!at) continue;
    const Frame plane = plane_across(axis, *at);
    PointSeries& series = out.series.emplace_back();
    series.name = plane_name(axis, *at);
    for (const Vec3 p : cloud.points) series.points.push_back(plane.in_plane(p));
    if (std::string told = coordinates_text({PlaneRow{axis}}); !told.empty()) {
      out.warnings.push_back(std::move(told));
    }
    return out;
  }
  return error(ErrorCode::kNothingThere,
               "points without triangles, and no plane x, y or z holds them all")
      .where(path)
      .hint(
          "give the mesh with --cut, or x,y,z as .csv: in order a curve in space, else `obvid "
          "surface scatter`");
}

}  // namespace

Result<Drawing> sections_of_mesh(std::string_view text, const std::string& path,
                                 const std::vector<PlaneRow>& planes, const RunContext& run) {
  const auto mesh = parse_mesh(text, path);
  if (!mesh && mesh.error().code == ErrorCode::kTooFewPoints) {
    auto points = parse_mesh_points(text, path);
    if (points && !points->empty()) return series_of_cloud({std::move(*points), {}}, path, planes);
  }
  OBVID_TRY(mesh);
  if (planes.empty()) return fail(uncut(*mesh, path));
  Drawing out;
  out.name = std::filesystem::path(path).filename().string();
  std::size_t all = 0, empty = 0;
  for (const PlaneRow& row : planes) {
    for (std::size_t i = 0; i < row.count(); ++i) {
      OBVID_TRY(may_go_on(run));
      const auto chains = cut_mesh(*mesh, plane_across(row.axis, row.at(i)));
      OBVID_TRY(chains);
      ++all;
      empty += chains->empty() ? 1 : 0;
      for (std::size_t k = 0; k < chains->size(); ++k) {
        std::string name = plane_name(row.axis, row.at(i));
        if (chains->size() > 1) name += fmt::format("/{}", k + 1);
        out.series.push_back(series_of((*chains)[k], std::move(name)));
      }
    }
  }
  if (out.series.empty()) return fail(missed(*mesh, planes, path));
  if (empty > 0) {
    out.warnings.push_back(fmt::format("{} of {} planes do not cut the mesh", empty, all));
  }
  if (std::string told = coordinates_text(planes); !told.empty()) {
    out.warnings.push_back(std::move(told));
  }
  return out;
}

}  // namespace obvid::pipeline_detail
