// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>
#include <string_view>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// Stored surface, `obvid-surface` version 1, with trims 2 (docs/formats.md): patches as NURBS,
/// numbers that read back to the same double.
[[nodiscard]] std::string surface_json(const SurfaceModel& model);

/// Reads a stored surface. Fields of other programs are passed over. `name` stands in errors.
/// Errors: E308 with the way to the value for everything that the format does not allow.
[[nodiscard]] Result<SurfaceModel> surface_from_json(std::string_view text, std::string_view name,
                                                     Watch* watch = nullptr);

}  // namespace obvid
