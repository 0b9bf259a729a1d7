// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/file_formats.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "files/format_writers.h"

namespace obvid {
namespace pipeline_detail {
namespace {

/// What an entry of the table says of its format.
struct FormatRow {
  FileFormat format{};
  const char* endings = "";   ///< ".step .stp"
  const char* contour = "";   ///< what it is of a contour, "STEP"; empty: it holds none
  const char* surface = "";   ///< the same of a surface,
  const char* space = "";     ///< a curve in space,
  const char* toolpath = "";  ///< a tool path,
  const char* cut = "";       ///< and outlines that are cut
};

constexpr std::array kFormats = {
#define OBVID_FORMAT(enumerator, extensions, contours, surfaces, curves, ...) \
  FormatRow{.format = FileFormat::enumerator, .endings = extensions, __VA_ARGS__},
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT
};

using What = const char* FormatRow::*;

/// First extension of a row and those behind it: ".step", " .stp".
std::string_view first_of(const FormatRow& row) {
  const std::string_view all = row.endings;
  return all.substr(0, all.find(' '));
}

std::optional<FileFormat> format_in_table(std::string_view path, What what) {
  for (const FormatRow& row : kFormats) {
    if (*(row.*what) != '\0' && has_ending(path, row.endings)) return row.format;
  }
  return std::nullopt;
}

std::string listed_formats(What what) {
  std::string out;
  for (const FormatRow& row : kFormats) {
    if (*(row.*what) == '\0') continue;
    out += fmt::format("{}{} ({})", out.empty() ? "" : ", ", first_of(row), row.*what);
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

std::string known_endings() { return pipeline_detail::listed_formats(&FormatRow::contour); }
std::string known_surface_endings() { return pipeline_detail::listed_formats(&FormatRow::surface); }
std::string known_space_endings() { return pipeline_detail::listed_formats(&FormatRow::space); }
std::string known_cut_endings() { return pipeline_detail::listed_formats(&FormatRow::cut); }

std::string known_toolpath_endings() {
  return pipeline_detail::listed_formats(&FormatRow::toolpath);
}

}  // namespace obvid
