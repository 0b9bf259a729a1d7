// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace obvid {

/// UTF-8 in ASCII, for what knows nothing else: "Löcher" is "Loecher", letters with other marks lose
/// them, Cyrillic ones are written as they sound; "_" stands for every other character and for bytes
/// that are none.
[[nodiscard]] std::string plain_letters(std::string_view text);

}  // namespace obvid
