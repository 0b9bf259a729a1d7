// SPDX-License-Identifier: Apache-2.0
#include "contour_json_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "text_lines.h"

namespace obvid {
namespace {

using nlohmann::json;
using std::string_view;

// Deepest nesting of a contour file is 6; the rest is room for fields of other programs.
constexpr int kMaxDepth = 64;

// Longest message taken over from the JSON parser, in bytes (it quotes whole tokens).
constexpr std::size_t kMaxDetail = 160;

Error bad_json(std::string what, std::string where) {
  Error error;
  error.code = ErrorCode::kBadJson;
  error.what = std::move(what);
  error.where = std::move(where);
  return error;
}

std::string place_of_byte(string_view text, string_view name, std::size_t byte) {
  const string_view before = text.substr(0, byte);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.find_last_of('\n') + 1;
  const string_view last = before.substr(start);
  return text::position(name, static_cast<std::size_t>(line),
                        text::column_of(last, last.data() + last.size()));
}

// Refuses brackets nested deeper than any contour file: what walks over the values may recurse.
Result<void> check_depth(string_view text, string_view name) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxDepth) {
        return fail(bad_json("brackets are nested more than " + std::to_string(kMaxDepth) + " deep",
                             place_of_byte(text, name, i)));
      }
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return {};
}

// The parser's message without the position, which stands in `where`.
std::string detail_of(string_view message) {
  const std::size_t column = message.find("column ");
  const std::size_t colon = column == string_view::npos ? column : message.find(": ", column);
  if (colon != string_view::npos) message.remove_prefix(colon + 2);
  return text::to_utf8(message.substr(0, kMaxDetail));
}

}  // namespace

Result<nlohmann::json> parse_json(string_view text, string_view name) {
  if (auto depth = check_depth(text, name); !depth) return fail(std::move(depth.error()));
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::parse_error& error) {
    // The parser counts from 1 and names the last byte that it read.
    const std::size_t byte = error.byte > 0 ? error.byte - 1 : 0;
    return fail(bad_json("the file is not valid JSON: " + detail_of(error.what()),
                         place_of_byte(text, name, std::min(byte, text.size()))));
  } catch (const json::exception& error) {
    return fail(
        bad_json("the file is not valid JSON: " + detail_of(error.what()), std::string(name)));
  }
}

std::string JsonNode::path() const {
  if (parent == nullptr) return {};
  return parent->path() + "/" + (key.empty() ? std::to_string(index) : std::string(key));
}

void JsonValues::refuse(const Node& node, ErrorCode code, std::string what) {
  if (error_) return;
  error_ = bad_json(std::move(what),
                    std::string(name_) + ": " + (node.parent == nullptr ? "/" : node.path()));
  error_->code = code;
}

JsonNode JsonValues::field(const Node& object, string_view key) {
  // Stands for a missing value: every reader refuses it after the first error.
  static const json kNothing;
  if (const auto found = optional_field(object, key)) return *found;
  const Node missing{&kNothing, &object, key};
  refuse(missing, "the field is missing");
  return missing;
}

std::optional<JsonNode> JsonValues::optional_field(const Node& object, string_view key) {
  if (failed()) return std::nullopt;
  if (!object.value->is_object()) {
    refuse(object, "an object is expected");
    return std::nullopt;
  }
  const auto found = object.value->find(key);
  if (found == object.value->end()) return std::nullopt;
  return Node{&*found, &object, key};
}

double JsonValues::number(const Node& node) {
  if (failed()) return 0.0;
  const double value = node.value->is_number() ? node.value->get<double>() : 0.0;
  if (!node.value->is_number()) {
    refuse(node, "a number is expected");
  } else if (!std::isfinite(value)) {
    refuse(node, "the number is out of range");
  }
  return value;
}

double JsonValues::number_or_nan(const Node& node) {
  if (!failed() && node.value->is_null()) return std::numeric_limits<double>::quiet_NaN();
  return number(node);
}

long long JsonValues::integer(const Node& node, long long least, long long most) {
  const double value = number(node);
  const bool whole = value == std::floor(value) && value >= static_cast<double>(least) &&
                     value <= static_cast<double>(most);
  if (!whole) refuse(node, "a whole number from " + std::to_string(least) + " on is expected");
  return failed() ? least : static_cast<long long>(value);
}

std::size_t JsonValues::index(const Node& node, std::size_t size, string_view what) {
  const auto value = static_cast<std::size_t>(integer(node, 0, kMaxInteger));
  if (!failed() && value >= size) {
    refuse(node, "there are only " + std::to_string(size) + " " + std::string(what));
  }
  return value;
}

bool JsonValues::flag(const Node& node) {
  if (failed()) return false;
  if (!node.value->is_boolean()) refuse(node, "true or false is expected");
  return !failed() && node.value->get<bool>();
}

std::string JsonValues::word(const Node& node) {
  if (failed()) return {};
  if (!node.value->is_string()) refuse(node, "a string is expected");
  return failed() ? std::string() : node.value->get<std::string>();
}

Vec2 JsonValues::point(const Node& node) {
  if (failed()) return {};
  if (!node.value->is_array() || node.value->size() != 2) {
    refuse(node, "a point [x, y] is expected");
    return {};
  }
  return {number({&(*node.value)[0], &node, {}, 0}), number({&(*node.value)[1], &node, {}, 1})};
}

double JsonValues::figure(const Node& object, string_view key) {
  return number_or_nan(field(object, key));
}

double JsonValues::optional_figure(const Node& object, string_view key, double otherwise) {
  const auto found = optional_field(object, key);
  return found ? number_or_nan(*found) : otherwise;
}

int JsonValues::small_count(const Node& object, string_view key) {
  return static_cast<int>(integer(field(object, key), 0, kMaxInt));
}

std::size_t JsonValues::optional_count(const Node& object, string_view key) {
  const auto found = optional_field(object, key);
  return found ? static_cast<std::size_t>(integer(*found, 0, kMaxInteger)) : 0;
}

bool JsonValues::optional_flag(const Node& object, string_view key, bool otherwise) {
  const auto found = optional_field(object, key);
  return found ? flag(*found) : otherwise;
}

}  // namespace obvid
