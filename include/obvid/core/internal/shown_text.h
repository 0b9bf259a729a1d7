// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace obvid {

/// At most 60 bytes of a text, control characters as blanks, for one line of a message.
[[nodiscard]] std::string shortened(std::string_view text);
/// The text with &, <, > and quotes as entities of XML and HTML, control characters as blanks.
[[nodiscard]] std::string escaped_xml(std::string_view text);

}  // namespace obvid
