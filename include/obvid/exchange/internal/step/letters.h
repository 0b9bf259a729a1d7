// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace obvid {

/// Text with its letters beyond ASCII, which are UTF-8, as ISO 10303-21 has them:
/// `\X2\00E4\X0\`. Bytes that are no UTF-8 are taken as Latin 1; a line may be broken inside a
/// letter, as kernels do.
[[nodiscard]] std::string in_step_letters(const std::string& text);

/// A name for a CAD file: line ends and other signs of control become blanks.
[[nodiscard]] std::string on_one_line(std::string name);

}  // namespace obvid
