// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/cad/internal/cad.h"

namespace obvid::cad {

[[nodiscard]] Result<std::string> write_text(const std::vector<CadCurve>& curves,
                                             const CadWriteOptions& options);
[[nodiscard]] Result<std::string> write_surfaces(const SurfaceModel& model,
                                                 const CadWriteOptions& options);

}  // namespace obvid::cad
