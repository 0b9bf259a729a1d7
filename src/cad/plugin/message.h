// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/cad/cad.h"

namespace obvid::cad {

/// A drawing, surfaces or an error as bytes for a pipe between two processes of the same program.
[[nodiscard]] std::string packed(const Result<Drawing>& drawing);
[[nodiscard]] std::string packed(const Result<CadSurfaces>& surfaces);

/// Back again; an error that says so when the bytes are not whole.
[[nodiscard]] Result<Drawing> unpacked(const std::string& bytes, const std::string& path);
[[nodiscard]] Result<CadSurfaces> unpacked_surfaces(const std::string& bytes,
                                                    const std::string& path);

}  // namespace obvid::cad
