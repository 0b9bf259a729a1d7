// SPDX-License-Identifier: Apache-2.0
#include "xml_text.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obvid::exchange {
namespace {

using std::string_view;

// More different warnings help nobody, and a hostile file could make millions.
constexpr std::size_t kMostWarnings = 60;

constexpr bool is_xml_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

std::size_t XmlFile::line_at(std::ptrdiff_t byte) const {
  if (byte < 0) return 0;
  const auto end = text_.begin() + std::min(byte, static_cast<std::ptrdiff_t>(text_.size()));
  return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
}

std::size_t XmlFile::line_of(pugi::xml_node node) const {
  return bytes_are_places_ ? line_at(node.offset_debug()) : 0;
}

std::string XmlFile::where(pugi::xml_node node) const {
  const std::size_t line = line_of(node);
  return line == 0 ? name_ : fmt::format("{}:{}", name_, line);
}

Result<void> XmlFile::parse(string_view root) {
  const auto result = document_.load_buffer(text_.data(), text_.size());
  bytes_are_places_ = result.encoding == pugi::encoding_utf8;
  const std::string place =
      bytes_are_places_ ? fmt::format("{}:{}", name_, line_at(result.offset)) : name_;
  if (!result) {
    return fail({ErrorCode::kBadJson,
                 fmt::format("the file is not well-formed XML: {}", result.description()), place,
                 "the file may be cut off; get it again", -1, 0.0});
  }
  if (local_name(document_.document_element()) != root) {
    return fail({ErrorCode::kUnsupported,
                 fmt::format("the outermost element is '{}', not '{}'",
                             shortened(document_.document_element().name()), root),
                 name_, "", -1, 0.0});
  }
  return {};
}

void XmlWarnings::add(const std::string& sentence, pugi::xml_node node) {
  const auto found = entries_.find(sentence);
  if (found != entries_.end()) {
    ++found->second.count;
  } else if (entries_.size() < kMostWarnings) {
    entries_.emplace(sentence, Entry{entries_.size(), 1, file_.line_of(node)});
  } else {
    ++unlisted_;
  }
}

std::vector<std::string> XmlWarnings::take() const {
  std::vector<std::string> out(entries_.size());
  for (const auto& [sentence, entry] : entries_) {
    std::string& text = out[entry.order];
    text = sentence;
    const std::string times = entry.count == 1 ? "" : fmt::format("{} times", entry.count);
    const std::string line = entry.line == 0    ? ""
                             : entry.count == 1 ? fmt::format("line {}", entry.line)
                                                : fmt::format(", first in line {}", entry.line);
    if (!times.empty() || !line.empty()) text += fmt::format(" ({}{})", times, line);
  }
  if (unlisted_ > 0) out.push_back(fmt::format("{} further warnings", unlisted_));
  return out;
}

string_view local_name(string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_of(pugi::xml_node node, string_view name) {
  for (const pugi::xml_node child : node.children()) {
    if (child.type() == pugi::node_element && local_name(child) == name) return child;
  }
  return {};
}

pugi::xml_attribute attribute_of(pugi::xml_node node, string_view name) {
  for (const pugi::xml_attribute attribute : node.attributes()) {
    if (local_name(string_view(attribute.name())) == name) return attribute;
  }
  return {};
}

string_view trimmed(string_view text) {
  while (!text.empty() && is_xml_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_xml_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> number_of(string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, code] = fast_float::from_chars(text.data(), end, value);
  // Out of range is infinity there, or 0 where the number is too small: that one is right.
  if (stop != end || code == std::errc::invalid_argument || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::vector<double>> numbers_of(string_view text, std::size_t most) {
  std::vector<double> out;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const auto end = std::find_if(text.begin(), text.end(), is_xml_blank);
    const auto length = static_cast<std::size_t>(end - text.begin());
    const auto value = number_of(text.substr(0, length));
    if (!value || out.size() == most) return std::nullopt;
    out.push_back(*value);
    text.remove_prefix(length);
  }
  return out;
}

}  // namespace obvid::exchange
