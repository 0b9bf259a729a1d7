// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "svg/path_builder.h"

namespace obvid::exchange {

/// Walks over numbers and separators as the grammars of SVG write them.
class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] std::size_t place() const { return at_; }
  [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[at_]; }
  void skip() { ++at_; }
  void skip_blanks();
  /// Blanks with at most one comma among them; whether there was a comma.
  bool skip_separator();
  /// A finite number right here, as long as it goes: "1.5.5" holds 1.5 and .5.
  std::optional<double> number();
  /// One character 0 or 1.
  std::optional<bool> flag();
  /// The letters right here.
  std::string_view word();

 private:
  [[nodiscard]] std::size_t number_end() const;

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Draws path data. Where they have an error, the place of the first segment that is not drawn
/// (bytes from 0): what comes before it is drawn.
[[nodiscard]] std::optional<std::size_t> draw_path(std::string_view data, SvgPathBuilder& builder);

}  // namespace obvid::exchange
