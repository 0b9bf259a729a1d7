// SPDX-License-Identifier: Apache-2.0
#include "contour_json_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

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

// Between two questions whether the work goes on.
constexpr std::size_t kBytesOfStep = 1U << 16U;
constexpr std::size_t kFieldsOfStep = 1U << 12U;

// Refuses brackets nested deeper than any contour file: what walks over the values may recurse.
Result<void> check_depth(string_view text, string_view name, Watch* watch) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i % kBytesOfStep == 0 && is_to_end(watch)) return fail(cancelled_error());
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

struct Cancelled {};

/// The bytes of a text, for a parser that knows of no watch: throws `Cancelled` when it says stop.
class WatchedBytes {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  WatchedBytes(const char* at, Watch* watch) : at_(at), watch_(watch) {}

  reference operator*() const { return *at_; }
  WatchedBytes& operator++() {
    ++at_;
    if (++read_ % kBytesOfStep == 0 && is_to_end(watch_)) throw Cancelled{};
    return *this;
  }
  friend bool operator==(const WatchedBytes& a, const WatchedBytes& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  Watch* watch_;
  std::size_t read_ = 0;
};

/// Name of a field, as its text between the quotes means it.
std::string unescaped(string_view quoted) {
  if (quoted.find('\\') == string_view::npos) return std::string(quoted);
  return json::parse("\"" + std::string(quoted) + "\"").get<std::string>();
}

struct Field {
  std::string name;
  std::size_t at = 0;  ///< byte of its opening quote

  friend bool operator<(const Field& a, const Field& b) {
    return std::tie(a.name, a.at) < std::tie(b.name, b.at);
  }
};

/// A field that its object names twice, at its second place: the parsed document has the last one
/// alone. Of several the first, in the object that ends first. The text is valid JSON. (A callback
/// of the parser would be told of every name too, but then it looks through a whole array again
/// behind each object in it.)
class RepeatedField {
 public:
  RepeatedField(string_view text, Watch* watch) : text_(text), watch_(watch) {}

  /// Nothing, too, where the watch says stop.
  std::optional<Field> find() {
    std::vector<std::size_t> first;  // names of the objects that are open begin there
    std::size_t string_at = 0, string_end = 0;
    for (std::size_t i = 0; i < text_.size(); ++i) {
      switch (text_[i]) {
        case '"':
          string_at = i++;
          while (text_[i] != '"') i += text_[i] == '\\' ? 2 : 1;
          string_end = i;
          break;
        case ':':
          add({string_at, string_end});
          if (++met_ % kFieldsOfStep == 0 && is_to_end(watch_)) return std::nullopt;
          break;
        case '{':
          first.push_back(count_);
          break;
        case '}':
          if (auto twice = among(first.back())) return twice;
          count_ = first.back();
          first.pop_back();
          break;
        default:
          break;
      }
    }
    return std::nullopt;
  }

 private:
  void add(std::pair<std::size_t, std::size_t> quotes) {
    if (count_ == fields_.size()) fields_.emplace_back();
    const auto [from, to] = quotes;
    fields_[count_++] = {unescaped(text_.substr(from + 1, to - from - 1)), from};
  }
  std::optional<Field> among(std::size_t first) {
    const auto begin = fields_.begin() + static_cast<std::ptrdiff_t>(first),
               end = fields_.begin() + static_cast<std::ptrdiff_t>(count_);
    std::sort(begin, end);
    std::optional<Field> out;
    for (auto field = begin; field != end; ++field) {
      const bool again = field != begin && (field - 1)->name == field->name;
      if (again && (!out || field->at < out->at)) out = *field;
    }
    return out;
  }

  string_view text_;
  Watch* watch_;
  std::vector<Field> fields_;  ///< of the objects that are open, the first `count_`
  std::size_t count_ = 0, met_ = 0;
};

}  // namespace

Result<nlohmann::json> parse_json(string_view text, string_view name, Watch* watch) {
  OBVID_TRY(check_depth(text, name, watch));
  if (const std::size_t zero = text.find('\0'); zero != string_view::npos) {
    // the parser would end there
    return fail(bad_json("the file is not valid JSON: a zero byte stands in it",
                         place_of_byte(text, name, zero)));
  }
  try {
    json document = json::parse(WatchedBytes(text.data(), watch),
                                WatchedBytes(text.data() + text.size(), watch));
    const auto twice = RepeatedField(text, watch).find();
    if (has_ended(watch)) return fail(cancelled_error());
    if (!twice) return document;
    return fail(bad_json("the field " + text::shown(twice->name) + " stands twice in its object",
                         place_of_byte(text, name, twice->at)));
  } catch (const Cancelled&) {
    return fail(cancelled_error());
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
  UnreadFields(const std::vector<const json*>& taken, Watch* watch)
      : taken_(taken), watch_(watch) {}

  void visit(const json& value, const std::string& path) {
    if (value.is_array()) {
      for (const json& item : value) {
        if (item.is_structured()) visit(item, path + "/*");
      }
    }
    if (!value.is_object()) return;
    if (++objects_ % kFieldsOfStep == 0 && is_to_end(watch_)) return;
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
  Watch* watch_;
  std::size_t objects_ = 0;
  std::set<std::string> seen_;
  std::vector<std::string> names_;
  std::size_t others_ = 0;
};

}  // namespace

/// Half by half, so that a watch is asked in between.
void JsonValues::sort_taken() {
  const std::size_t n = taken_.size();
  const auto at = [&](std::size_t i) {
    return taken_.begin() + static_cast<std::ptrdiff_t>(std::min(i, n));
  };
  for (std::size_t i = 0; i < n && !is_to_end(watch_); i += kFieldsOfStep) {
    std::sort(at(i), at(i + kFieldsOfStep), std::less<>());
  }
  for (std::size_t length = kFieldsOfStep; length < n; length *= 2) {
    for (std::size_t i = 0; i < n && !is_to_end(watch_); i += 2 * length) {
      std::inplace_merge(at(i), at(i + length), at(i + 2 * length), std::less<>());
    }
  }
}

std::vector<std::string> JsonValues::unread_fields(const json& document) {
  sort_taken();
  if (has_ended(watch_)) return {};
  UnreadFields unread(taken_, watch_);
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
