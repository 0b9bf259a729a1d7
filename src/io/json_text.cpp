// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/internal/json_text.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "obvid/core/internal/format_into.h"

namespace obvid {
namespace {

void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      format_into(out, "\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  out += '"';
}

}  // namespace

bool JsonText::before_value() {
  if (questions_.end()) return false;
  if (comma_) text_ += ", ";
  comma_ = true;
  return true;
}

JsonText& JsonText::begin_object() {
  if (!before_value()) return *this;
  text_ += '{';
  comma_ = false;
  return *this;
}

JsonText& JsonText::end_object() {
  text_ += '}';
  comma_ = true;
  return *this;
}

JsonText& JsonText::begin_array() {
  if (!before_value()) return *this;
  text_ += '[';
  comma_ = false;
  return *this;
}

JsonText& JsonText::end_array() {
  text_ += ']';
  comma_ = true;
  return *this;
}

JsonText& JsonText::key(std::string_view name) {
  if (!before_value()) return *this;
  append_quoted(text_, name);
  text_ += ": ";
  comma_ = false;
  return *this;
}

JsonText& JsonText::value(double number) {
  if (!std::isfinite(number)) return null();
  if (!before_value()) return *this;
  format_into(text_, "{}", number);
  return *this;
}

JsonText& JsonText::value(std::size_t number) {
  if (!before_value()) return *this;
  text_ += std::to_string(number);
  return *this;
}

JsonText& JsonText::value(int number) {
  if (!before_value()) return *this;
  text_ += std::to_string(number);
  return *this;
}

JsonText& JsonText::value(bool flag) { return raw(flag ? "true" : "false"); }

JsonText& JsonText::value(std::string_view text) {
  if (!before_value()) return *this;
  append_quoted(text_, text);
  return *this;
}

JsonText& JsonText::null() { return raw("null"); }

JsonText& JsonText::raw(std::string_view json) {
  if (!before_value()) return *this;
  text_ += json;
  return *this;
}

std::string JsonText::take() {
  text_ += '\n';
  comma_ = false;
  return std::exchange(text_, {});
}

void add_units(JsonText& json, const Units& units) {
  json.pair("units", units.name).pair("units_source", to_string(units.source));
}

}  // namespace obvid
