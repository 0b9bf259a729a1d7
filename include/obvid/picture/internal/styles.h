// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace obvid::picture {

// Style sheets of pictures and pages: the files of web/look, put into the library by
// cmake/ObvidTexts.cmake.
[[nodiscard]] std::string_view plane_sheet_style();
/// Of moves of points, which stand in front of a sheet.
[[nodiscard]] std::string_view deviations_style();
[[nodiscard]] std::string_view space_sheet_style();
[[nodiscard]] std::string_view report_page_style();

[[nodiscard]] inline std::string style_element(std::string_view sheet) {
  return "<style>\n" + std::string(sheet) + "</style>\n";
}

}  // namespace obvid::picture
