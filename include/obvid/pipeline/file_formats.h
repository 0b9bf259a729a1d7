// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <string_view>

#include "obvid/core/internal/file_ending.h"

namespace obvid {

/// Files that are written: pipeline/formats.inc, docs/formats.md. kContour is the file of a surface
/// and of a curve in space, too.
enum class FileFormat {
#define OBVID_FORMAT(enumerator, ...) enumerator,
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT
};

/// Format of contours that a file's name has by its extension. Nothing where there is none.
[[nodiscard]] std::optional<FileFormat> format_of(std::string_view path);
/// The same of surfaces, of curves in space, and of tool paths.
[[nodiscard]] std::optional<FileFormat> surface_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> space_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> toolpath_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> cut_format_of(std::string_view path);
/// Of alignments what their contours do not have; of analyses and comparisons; of checks and
/// sections of surfaces, of proofs, of splines, and of those of two variables.
[[nodiscard]] std::optional<FileFormat> alignment_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> table_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> check_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> sections_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> proof_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> spline_format_of(std::string_view path);
[[nodiscard]] std::optional<FileFormat> graph_format_of(std::string_view path);

/// ".json (contour), .svg (picture), ...": for help and errors.
[[nodiscard]] std::string known_endings();
[[nodiscard]] std::string known_surface_endings();
[[nodiscard]] std::string known_space_endings();
[[nodiscard]] std::string known_toolpath_endings();
[[nodiscard]] std::string known_cut_endings();

}  // namespace obvid
