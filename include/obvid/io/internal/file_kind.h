// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace obvid {

/// What a file holds, as its first bytes say.
enum class FileKind {
  kPoints,  ///< none of the others: text with points, if anything
  kContour,
  kDxf,
  kStep,
  kIges,
  kBrep,
  kSvg,
  kGpx,
  kGeoJson,
  kLandXml,
  kOpenDrive,
  kOther,  ///< known, but not read by anything here
};

[[nodiscard]] FileKind file_kind(std::string_view text);

/// Bytes at the beginning of a file that are enough for it.
inline constexpr std::size_t kHeadOfKind = 4096;

/// Whether it is a JSON object of any kind.
[[nodiscard]] bool is_json_text(std::string_view text);

}  // namespace obvid
