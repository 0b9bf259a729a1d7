// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec2.h"

namespace obvid {

enum class Format { kJson, kSvg, kCsv };

/// Which endings a command knows.
enum class FormatSet {
  kContours,  ///< .json contour, .svg picture
  kTables,    ///< .svg picture, .csv and .json tables
};

/// A file to write.
struct Output {
  std::string path;
  Format format = Format::kJson;
  std::string text;
};

/// Format by ending. Errors: E202 for endings without format, E203 where the input would be
/// replaced.
[[nodiscard]] Result<Output> output_of(const std::string& path, const std::string& input,
                                       FormatSet formats = FormatSet::kContours);
[[nodiscard]] Result<std::vector<Output>> outputs_of(const std::vector<std::string>& paths,
                                                     const std::string& input,
                                                     FormatSet formats = FormatSet::kContours);

/// Writes all texts, each file whole or not at all; names what was written. Error: E102.
[[nodiscard]] Result<std::vector<std::string>> write_files(const std::vector<Output>& outputs);

/// "--noise 0.01", as it was tried: with " --open" where the ends would meet within it.
[[nodiscard]] std::string noise_option(double tolerance, bool closed,
                                       const std::vector<Vec2>& points);

/// "a.svg, b.json"
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace obvid
