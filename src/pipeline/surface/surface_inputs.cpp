// SPDX-License-Identifier: Apache-2.0
#include "surface/surface_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "obvid/core/files.h"
#include "obvid/io/internal/read_cloud.h"
#include "obvid/io/internal/read_grid.h"
#include "obvid/io/read_sections.h"

namespace obvid {

SurfaceInput SurfaceInput::of_text(std::string name, std::string text) {
  SurfaceInput out(std::move(name));
  out.text = std::move(text);
  return out;
}

SurfaceInput SurfaceInput::of_points(SpaceSeries points) {
  SurfaceInput out(points.name);
  out.points = std::move(points);
  return out;
}

namespace pipeline_detail {
namespace {

std::vector<std::string> paths_of(const std::vector<SurfaceInput>& inputs) {
  std::vector<std::string> out;
  for (const SurfaceInput& input : inputs) out.push_back(input.name);
  return out;
}

bool are_files(const std::vector<SurfaceInput>& inputs) {
  return std::all_of(inputs.begin(), inputs.end(),
                     [](const SurfaceInput& input) { return input.is_file(); });
}

Result<ParsedSections> parsed(const SurfaceInput& input, const SectionOptions& options,
                              const RunContext& run) {
  if (input.points) return ParsedSections{{*input.points}, false};
  if (input.text) return parse_sections(*input.text, input.name, options, run);
  auto read = read_sections({input.name}, options, nullptr, run);
  OBVID_TRY(read);
  return ParsedSections{std::move(*read), false};
}

}  // namespace

Result<std::vector<SpaceSeries>> sections_of(const std::vector<SurfaceInput>& inputs,
                                             std::optional<double> spacing,
                                             std::vector<std::string>* assumed,
                                             const RunContext& run) {
  const SectionOptions options{spacing.value_or(1.0)};
  if (are_files(inputs)) return read_sections(paths_of(inputs), options, assumed, run);
  std::vector<SpaceSeries> out;
  for (const SurfaceInput& input : inputs) {
    OBVID_TRY(may_go_on(run));
    auto some = parsed(input, options, run);
    OBVID_TRY(some);
    for (const std::string& what : some->assumed) {
      if (assumed != nullptr) assumed->push_back(input.name + ": " + what);
    }
    const bool named_by_file = !input.points && inputs.size() > 1 && some->sections.size() == 1;
    if (named_by_file) {
      some->sections.front().name = std::filesystem::path(input.name).filename().string();
    }
    // texts without z follow each other by the spacing, as files do
    const double height = options.spacing * static_cast<double>(out.size());
    for (SpaceSeries& section : some->sections) {
      for (Vec3& p : section.points) p.z += some->flat ? height : 0.0;
    }
    std::move(some->sections.begin(), some->sections.end(), std::back_inserter(out));
  }
  return out;
}

Result<SpaceSeries> section_of(const SurfaceInput& input, const RunContext& run) {
  auto all = parsed(input, {}, run);
  OBVID_TRY(all);
  if (all->sections.size() == 1) return std::move(all->sections.front());
  return error(ErrorCode::kBadCount,
               fmt::format("the file holds {} series of points, one curve is needed",
                           all->sections.size()))
      .where(input.name)
      .hint("split the file")
      .value(static_cast<double>(all->sections.size()));
}

Result<PointGrid> grid_of(const std::vector<SurfaceInput>& inputs, const GridReading& reading) {
  const GridOptions options{reading.spacing.value_or(1.0)};
  if (are_files(inputs) && !reading.row) return read_grid(paths_of(inputs), options);
  if (inputs.size() != 1) {
    return error(ErrorCode::kUsage, "a grid is one text or one list of points");
  }
  const SurfaceInput& input = inputs.front();
  if (reading.row && !input.points) {  // rows are as long as was said, whatever the file shows
    const auto text = input.text ? Result<std::string>(*input.text) : read_file(input.name);
    OBVID_TRY(text);
    auto list = parse_cloud(*text, input.name);
    OBVID_TRY(list);
    if (!list->assumed.empty()) {
      return error(ErrorCode::kTooFewColumns, "more than three columns, and none is called x, y, z")
          .where(input.name)
          .hint("rows of a given length are made of lists x y z");
    }
    return grid_of({SurfaceInput::of_points(std::move(list->points))}, reading);
  }
  if (input.text) {
    auto grid = parse_grid(*input.text, input.name, options);
    if (grid) grid->name = std::filesystem::path(input.name).stem().string();
    return grid;
  }
  const std::size_t count = input.points->points.size(), row = reading.row.value_or(0);
  if (row < 2 || count % row != 0 || count / row < 2) {
    return error(ErrorCode::kBadOption, fmt::format("{} points do not fill rows of {}", count, row))
        .where(input.name)
        .hint("say how many points are in a row, two at least, and give two rows at least")
        .value(static_cast<double>(count));
  }
  PointGrid grid;
  grid.name = input.points->name;
  grid.units = input.points->units;
  grid.rounding = input.points->rounding;
  grid.points = input.points->points;
  grid.count_u = row;
  grid.count_v = count / row;
  return grid;
}

}  // namespace pipeline_detail
}  // namespace obvid
