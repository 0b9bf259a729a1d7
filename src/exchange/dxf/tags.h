// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "obvid/core/result.h"

namespace obvid::dxf {

/// Group code and value. The text points into the file.
struct Tag {
  int code = 0;
  std::string_view text;       ///< trimmed; empty where `real` holds the value
  std::optional<double> real;  ///< of binary files, which store numbers as such
  std::size_t line = 0;        ///< of the group code, from 1; of binary files its byte, from 0
};

/// The finite number of a tag.
[[nodiscard]] std::optional<double> number(const Tag& tag);
/// The number of a tag as an integer, when it is one and fits.
[[nodiscard]] std::optional<int> integer(const Tag& tag);

/// Walks over the tags of an ASCII or binary DXF file.
class TagReader {
 public:
  TagReader(std::string_view bytes, std::string_view name);

  /// The next tag; nothing at the end of the file, be it between two tags or in the midst of one.
  /// Error: E302 a group code that is none.
  Result<std::optional<Tag>> next();
  [[nodiscard]] bool binary() const { return binary_; }
  /// Whether the file broke off inside a tag.
  [[nodiscard]] bool cut() const { return cut_; }
  /// "file.dxf:123" or "file.dxf: byte 123".
  [[nodiscard]] std::string place(std::size_t line) const;

 private:
  [[nodiscard]] std::optional<std::string_view> line();
  Result<std::optional<Tag>> next_ascii();
  Result<std::optional<Tag>> next_binary();
  [[nodiscard]] std::optional<int> binary_code();
  bool binary_value(Tag& tag);
  bool binary_text(Tag& tag);
  [[nodiscard]] std::optional<unsigned long long> bytes(std::size_t count);
  [[nodiscard]] tl::unexpected<Error> bad_code(std::string_view shown, std::size_t line) const;

  std::string_view name_;
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t lines_ = 0;
  bool binary_ = false;
  bool wide_codes_ = false;  ///< two bytes each, since R13
  bool cut_ = false;
};

}  // namespace obvid::dxf
