// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace obvid::text {

/// Walks over the lines of a text; LF, CRLF and a lone CR end a line.
class LineCursor {
 public:
  explicit LineCursor(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return position_ >= text_.size(); }
  /// Number of the line at the cursor, from 1.
  [[nodiscard]] std::size_t line_number() const { return number_; }
  [[nodiscard]] std::string_view rest() const { return text_.substr(position_); }
  /// The line at the cursor without its end.
  [[nodiscard]] std::string_view peek() const;
  /// Moves behind `line`, which must be what `peek` gave.
  void skip(std::string_view line);
  /// Moves on by `bytes` that hold one whole line without its end.
  void skip_line_of(std::size_t bytes);

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t number_ = 1;
};

/// How the fields of a line are separated.
enum class Separator { kWhite, kTab, kComma, kSemicolon };

/// Most columns that are looked at; what stands behind them is passed over.
inline constexpr std::size_t kMaxColumns = 64;

struct Fields {
  std::array<std::string_view, kMaxColumns> cell;
  std::size_t count = 0;
};

[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }
[[nodiscard]] std::string_view trim(std::string_view line);
/// Whether the whole line is a comment (`#`, `;`, `!`, `//`).
[[nodiscard]] bool is_comment(std::string_view line);
/// The line up to a comment that begins inside it (`#`, `!`, `//`).
[[nodiscard]] std::string_view without_comment(std::string_view line);
/// Separator that the line uses. A comma counts as decimal comma only when blanks separate fields
/// that read as numbers with it ("1,5 2,5").
[[nodiscard]] Separator detect_separator(std::string_view line);
void split(std::string_view line, Separator separator, Fields& fields);
/// Column (from 1, in characters) of `place`, which lies inside `line`.
[[nodiscard]] std::size_t column_of(std::string_view line, const char* place);
/// "name:line:column"
[[nodiscard]] std::string position(std::string_view name, std::size_t line, std::size_t column);
/// The text as valid UTF-8: bytes that are not are taken as Latin-1; control characters go.
[[nodiscard]] std::string to_utf8(std::string_view text);
/// The beginning of a field, in quotes, for an error on one line.
[[nodiscard]] std::string shown(std::string_view cell);

}  // namespace obvid::text
