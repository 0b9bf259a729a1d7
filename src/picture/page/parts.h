// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace obvid::picture {

// The fixed parts of the page of a surface: the files of web/surface and web/look, put into the
// library by cmake/ObvidTexts.cmake.
[[nodiscard]] std::string_view surface_page_style();
/// Everything in the body but the data, with the marks @TITLE@ and @FACTS@.
[[nodiscard]] std::string_view surface_page_markup();
/// Reading the data, shaders, camera, controls: one program.
[[nodiscard]] std::string_view surface_page_script();

}  // namespace obvid::picture
