// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace obvid::cad {

/// The text of a STEP file with its letters beyond ASCII, which are UTF-8 when the kernel wrote it,
/// as ISO 10303-21 has them: `\X2\00E4\X0\`. Bytes that are no UTF-8 are taken as Latin 1.
[[nodiscard]] std::string in_step_letters(const std::string& text);

}  // namespace obvid::cad
