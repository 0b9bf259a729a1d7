// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "obvid/core/internal/file_ending.h"
#include "obvid/pipeline/file_formats.h"

// The table of files, for those who ask it themselves.

namespace obvid::pipeline_detail {

/// What a kind of file does with a unit (docs/formats.md, "Units").
enum class UnitRule {
  kNone,    ///< it states the one that we have, assumed or not
  kLost,    ///< it has no place for one, and readers take millimetres
  kStated,  ///< it states a unit that is known, and none otherwise
  kLength,  ///< it has true lengths: a unit that is merely assumed is worth a warning
  kRoad,    ///< it is in metres or feet of the ground: an assumed unit is refused
};

/// What an entry of the table says of its format: what it is of each thing, "STEP"; empty where it
/// holds none.
struct FormatRow {
  FileFormat format{};
  const char* endings = "";    ///< ".step .stp"
  bool several = false;        ///< whether one file holds several contours
  const char* contour = "";    ///< of a contour,
  const char* surface = "";    ///< a surface,
  const char* space = "";      ///< a curve in space,
  const char* toolpath = "";   ///< a tool path,
  const char* cut = "";        ///< outlines that are cut,
  const char* alignment = "";  ///< of an alignment what its contour does not have,
  const char* tables = "";     ///< of analyses and comparisons,
  const char* check = "";      ///< of what a surface is checked for,
  const char* sections = "";   ///< of its sections,
  const char* proof = "";      ///< of what was proved again,
  const char* spline = "";     ///< of a spline,
  const char* graph = "";      ///< and of one of two variables
  UnitRule rule = UnitRule::kNone;
  const char* files = "";  ///< what such files are called where their units are spoken of

  /// First of the file extensions: ".step".
  [[nodiscard]] constexpr std::string_view ending() const {
    const std::string_view all = endings;
    return all.substr(0, all.find(' '));
  }
};

using FilesOf = const char* FormatRow::*;

inline constexpr std::array kFormats = {
#define OBVID_FORMAT(enumerator, extensions, contours, surfaces, curves, together, ...) \
  FormatRow{.format = FileFormat::enumerator,                                           \
            .endings = extensions,                                                      \
            .several = std::string_view(#together) != "none",                           \
            __VA_ARGS__},
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT
};

/// Format of a thing by its file's name. Nothing where there is no such file of it.
[[nodiscard]] inline std::optional<FileFormat> format_in_table(std::string_view path,
                                                               FilesOf what) {
  for (const FormatRow& row : kFormats) {
    if (*(row.*what) != '\0' && has_ending(path, row.endings)) return row.format;
  }
  return std::nullopt;
}

}  // namespace obvid::pipeline_detail
