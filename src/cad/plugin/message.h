// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"

namespace obvid::cad {

/// A drawing or an error as bytes for a pipe between two processes of the same program.
[[nodiscard]] std::string packed(const Result<Drawing>& drawing);

/// Back again; an error that says so when the bytes are not whole.
[[nodiscard]] Result<Drawing> unpacked(const std::string& bytes, const std::string& path);

}  // namespace obvid::cad
