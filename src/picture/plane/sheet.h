// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace obvid {

/// The whole SVG file around what was drawn: size, styles for light and dark viewers, background.
[[nodiscard]] std::string picture_sheet(const std::string& title, const std::string& description,
                                        const std::string& body, double height);

}  // namespace obvid
