// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace obvid::exchange {

// The fixed parts of the page of a surface. The four scripts are one program in this order.
[[nodiscard]] std::string_view surface_page_style();
/// Everything in the body but the data, with the marks @TITLE@ and @FACTS@.
[[nodiscard]] std::string_view surface_page_markup();
[[nodiscard]] std::string_view surface_page_model_script();  ///< data, buffers, reading off
[[nodiscard]] std::string_view surface_page_shaders();
[[nodiscard]] std::string_view surface_page_drawing_script();  ///< camera and graphics card
[[nodiscard]] std::string_view surface_page_controls_script();

}  // namespace obvid::exchange
