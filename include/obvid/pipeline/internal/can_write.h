// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/core/result.h"
#include "obvid/pipeline/file_formats.h"

namespace obvid {

/// Whether contours and curves in space can be written in a format here, to be asked before the
/// work begins; nothing is said of none. Error: E310 where the kernel's helper is needed (IGES,
/// BREP; STEP of curves is written without it) and missing.
[[nodiscard]] Result<void> can_write_curves(std::optional<FileFormat> format);

}  // namespace obvid
