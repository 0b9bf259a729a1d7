// SPDX-License-Identifier: Apache-2.0
#include "json_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

#include "obvid/core/format_into.h"

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

/// Position behind the string that starts at `at`.
std::size_t skip_string(std::string_view json, std::size_t at) {
  for (++at; at < json.size() && json[at] != '"'; ++at) {
    if (json[at] == '\\') ++at;
  }
  return at + 1;
}

std::size_t skip_blank(std::string_view json, std::size_t at) {
  while (at < json.size() && std::string_view(" \t\r\n").find(json[at]) != std::string_view::npos) {
    ++at;
  }
  return at;
}

/// Position of the comma or bracket that ends the value which starts at `at`.
std::size_t skip_value(std::string_view json, std::size_t at) {
  int depth = 0;
  while (at < json.size()) {
    const char c = json[at];
    if (c == '"') {
      at = skip_string(json, at);
      continue;
    }
    if (c == '{' || c == '[') ++depth;
    if (depth == 0 && (c == ',' || c == '}' || c == ']')) break;
    if (c == '}' || c == ']') --depth;
    ++at;
  }
  return at;
}

}  // namespace

void JsonText::before_value() {
  if (comma_) text_ += ", ";
  comma_ = true;
}

JsonText& JsonText::begin_object() {
  before_value();
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
  before_value();
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
  before_value();
  append_quoted(text_, name);
  text_ += ": ";
  comma_ = false;
  return *this;
}

JsonText& JsonText::value(double number) {
  if (!std::isfinite(number)) return null();
  before_value();
  format_into(text_, "{}", number);
  return *this;
}

JsonText& JsonText::value(std::size_t number) {
  before_value();
  text_ += std::to_string(number);
  return *this;
}

JsonText& JsonText::value(int number) {
  before_value();
  text_ += std::to_string(number);
  return *this;
}

JsonText& JsonText::value(bool flag) { return raw(flag ? "true" : "false"); }

JsonText& JsonText::value(std::string_view text) {
  before_value();
  append_quoted(text_, text);
  return *this;
}

JsonText& JsonText::null() { return raw("null"); }

JsonText& JsonText::raw(std::string_view json) {
  before_value();
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

std::string_view top_level_value(std::string_view json, std::string_view name) {
  std::size_t at = skip_blank(json, 0);
  while (at < json.size() && (json[at] == '{' || json[at] == ',')) {
    const std::size_t key_start = skip_blank(json, at + 1);
    if (key_start >= json.size() || json[key_start] != '"') break;
    const std::size_t key_end = skip_string(json, key_start);
    const std::size_t colon = skip_blank(json, key_end);
    const std::size_t start = skip_blank(json, colon + 1);
    const std::size_t end = skip_value(json, start);
    if (json.substr(key_start + 1, key_end - key_start - 2) == name) {
      return json.substr(start, end - start);
    }
    at = end;
  }
  return {};
}

}  // namespace obvid
