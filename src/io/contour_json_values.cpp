// SPDX-License-Identifier: Apache-2.0
#include "contour_json_values.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
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

/// The text, told how far it was read.
class Followed {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Followed(const char* at, const char** reached) : at_(at), reached_(reached) {}
  reference operator*() const { return *at_; }
  Followed& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  Followed operator++(int) {
    Followed before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const Followed& a, const Followed& b) { return a.at_ == b.at_; }
  friend bool operator!=(const Followed& a, const Followed& b) { return a.at_ != b.at_; }

 private:
  const char* at_;
  const char** reached_;
};

/// Notes the first field that its object names twice: the document has the last one alone. (A
/// callback while the document is made would be told too, but then the parser looks through a whole
/// array again behind each object in it.)
class RepeatedField final : public nlohmann::json_sax<json> {
 public:
  explicit RepeatedField(const char* const* reached) : reached_(reached) {}

  [[nodiscard]] bool found() const { return at_ != nullptr; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Behind its closing quote.
  [[nodiscard]] const char* at() const { return at_; }

  bool start_object(std::size_t) override {
    if (++depth_ > open_.size()) open_.emplace_back();
    return true;
  }
  bool end_object() override {
    open_[--depth_].clear();
    return true;
  }
  /// Goes on until there is one.
  bool key(string_t& name) override {
    if (open_[depth_ - 1].insert(name).second) return true;
    name_ = name;
    at_ = *reached_;
    return false;
  }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override {
    return false;
  }

 private:
  const char* const* reached_;
  std::vector<std::set<std::string>> open_;  ///< names in the objects that are not complete
  std::size_t depth_ = 0;
  std::string name_;
  const char* at_ = nullptr;
};

}  // namespace

Result<nlohmann::json> parse_json(string_view text, string_view name) {
  OBVID_TRY(check_depth(text, name));
  try {
    json document = json::parse(text.begin(), text.end());
    const char* reached = text.data();
    RepeatedField repeated(&reached);
    json::sax_parse(Followed(text.data(), &reached), Followed(text.data() + text.size(), &reached),
                    &repeated);
    if (!repeated.found()) return document;
    const auto end = static_cast<std::size_t>(repeated.at() - text.data());
    const std::size_t quoted = repeated.name().size() + 2;
    return fail(
        bad_json("the field " + text::shown(repeated.name()) + " stands twice in its object",
                 place_of_byte(text, name, end > quoted ? end - quoted : 0)));
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
  taken_.push_back(&*found);
  return Node{&*found, &object, key};
}

namespace {

/// Different fields that a list of unknown ones names; the others are counted.
constexpr std::size_t kMostUnread = 50;

class UnreadFields {
 public:
  explicit UnreadFields(const std::vector<const json*>& taken) : taken_(taken) {}

  void visit(const json& value, const std::string& path) {
    if (value.is_array()) {
      for (const json& item : value) {
        if (item.is_structured()) visit(item, path + "/*");
      }
    }
    if (!value.is_object()) return;
    for (auto item = value.begin(); item != value.end(); ++item) {
      const bool known = std::binary_search(taken_.begin(), taken_.end(), &*item, std::less<>());
      if (!known) {
        note(path + "/" + text::to_utf8(item.key()));
      } else if (item->is_structured()) {
        visit(*item, path + "/" + item.key());
      }
    }
  }

  std::vector<std::string> take() {
    if (others_ > 0) names_.push_back(std::to_string(others_) + " other unknown fields");
    return std::move(names_);
  }

 private:
  void note(std::string path) {
    if (seen_.count(path) > 0) return;
    if (names_.size() >= kMostUnread) {
      ++others_;
      return;
    }
    names_.push_back(path);
    seen_.insert(std::move(path));
  }

  const std::vector<const json*>& taken_;  ///< sorted
  std::set<std::string> seen_;
  std::vector<std::string> names_;
  std::size_t others_ = 0;
};

}  // namespace

std::vector<std::string> JsonValues::unread_fields(const json& document) {
  std::sort(taken_.begin(), taken_.end(), std::less<>());
  UnreadFields unread(taken_);
  unread.visit(document, "");
  return unread.take();
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

void JsonValues::unit_source(const Node& object, Units& units) {
  const auto node = optional_field(object, "units_source");
  if (!node) return;
  const std::string name = word(*node);
  if (const auto source = unit_source_of(name)) {
    units.source = *source;
  } else {
    refuse(*node, text::shown(name) + " is no source of a unit: file, given or assumed");
  }
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
