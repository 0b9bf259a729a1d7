// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// Whether it is a JSON object of any kind.
[[nodiscard]] bool is_json_text(std::string_view text);

}  // namespace obvid
