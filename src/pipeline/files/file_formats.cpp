// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/file_formats.h"

#include <fmt/format.h>

#include "files/format_writers.h"
#include "obvid/pipeline/internal/format_table.h"

namespace obvid {
namespace pipeline_detail {
namespace {

std::string listed_formats(FilesOf what) {
  std::string out;
  for (const FormatRow& row : kFormats) {
    if (*(row.*what) == '\0') continue;
    out += fmt::format("{}{} ({})", out.empty() ? "" : ", ", row.ending(), row.*what);
  }
  return out;
}

}  // namespace

Error not_held_by_format() {
  return {ErrorCode::kUnknownFormat, "this format does not hold it", "", ""};
}

}  // namespace pipeline_detail

using pipeline_detail::FormatRow;

std::optional<FileFormat> format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::contour);
}
std::optional<FileFormat> surface_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::surface);
}
std::optional<FileFormat> space_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::space);
}
std::optional<FileFormat> toolpath_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::toolpath);
}

std::optional<FileFormat> cut_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::cut);
}

std::optional<FileFormat> alignment_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::alignment);
}
std::optional<FileFormat> table_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::tables);
}
std::optional<FileFormat> check_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::check);
}
std::optional<FileFormat> sections_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::sections);
}
std::optional<FileFormat> proof_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::proof);
}
std::optional<FileFormat> spline_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::spline);
}
std::optional<FileFormat> graph_format_of(std::string_view path) {
  return pipeline_detail::format_in_table(path, &FormatRow::graph);
}

std::string known_endings() { return pipeline_detail::listed_formats(&FormatRow::contour); }
std::string known_surface_endings() { return pipeline_detail::listed_formats(&FormatRow::surface); }
std::string known_space_endings() { return pipeline_detail::listed_formats(&FormatRow::space); }
std::string known_cut_endings() { return pipeline_detail::listed_formats(&FormatRow::cut); }

std::string known_toolpath_endings() {
  return pipeline_detail::listed_formats(&FormatRow::toolpath);
}

}  // namespace obvid
