// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "obvid/core/result.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/import.h"

namespace obvid {

/// Options of the formats as they were typed.
struct FormatValues {
  std::optional<long> curve;
  std::optional<double> chord_tolerance;
  std::optional<double> tolerance;
  std::optional<double> face_width;
  std::string step = "ap214";
  std::string dxf = "exact";
};

/// Error: E203.
[[nodiscard]] Result<void> set_import(const FormatValues& typed, ImportOptions& options);
[[nodiscard]] Result<void> set_formats(const FormatValues& typed, ExportOptions& options);

}  // namespace obvid
