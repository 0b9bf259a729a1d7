// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/cad/internal/cad.h"

namespace obvid::cad {

[[nodiscard]] Result<CadSurfaces> read_faces(const std::string& path);

}  // namespace obvid::cad
