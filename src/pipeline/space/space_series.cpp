// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <utility>

#include "obvid/core/files.h"
#include "obvid/io/internal/file_kind.h"
#include "obvid/io/internal/read_columns.h"
#include "obvid/io/read_points.h"
#include "obvid/io/read_sections.h"
#include "obvid/pipeline/space_fit.h"

namespace obvid {
Result<std::optional<SpaceSeries>> space_series(const std::string& path, bool any_third,
                                                const ImportOptions& import) {
  // what can be read only once is for whoever reads it: `parse_space_series`
  const std::string head = head_of_file(path, kHeadOfKind);
  if (head.empty() || file_kind(head) != FileKind::kPoints) return std::nullopt;
  const auto text = read_file(path);
  OBVID_TRY(text);
  return parse_space_series(*text, path, any_third, import);
}

Result<void> check_space_import(const ImportOptions& import) {
  if (import.unordered) {
    return error(ErrorCode::kBadOption, "points in space are not put in order")
        .where("--unordered")
        .hint("give them in the order of their curve");
  }
  if (import.drop_outliers) {
    return error(ErrorCode::kBadOption, "outliers are not looked for in space")
        .where("--drop-outliers")
        .hint("leave out what is wrong by hand");
  }
  return {};
}

Result<std::optional<SpaceSeries>> parse_space_series(const std::string& whole,
                                                      const std::string& name, bool any_third,
                                                      const ImportOptions& import) {
  if (file_kind(whole) != FileKind::kPoints || import.list.columns) return std::nullopt;
  const std::string_view text = behind_lines(whole, import.list.skip);
  const auto table = parse_columns(text, name);
  const bool named = table && !table->names.empty();
  if (named ? !table->heights : !any_third) return std::nullopt;
  auto parsed = parse_sections(text, name);
  if (!parsed || parsed->flat || parsed->sections.size() != 1) return std::nullopt;
  SpaceSeries& series = parsed->sections.front();
  series.name = std::filesystem::path(name).filename().string();
  std::vector<Vec3> points;
  for (const Vec3& p : series.points) {
    if (points.empty() || !(points.back() == p)) points.push_back(p);
  }
  series.points = std::move(points);
  const double z = series.points.empty() ? 0.0 : series.points.front().z;
  const bool level = std::all_of(series.points.begin(), series.points.end(),
                                 [&](const Vec3& p) { return p.z == z; });
  if (level) return std::nullopt;
  place(import.placement, series);
  return std::optional(std::move(series));
}

}  // namespace obvid
