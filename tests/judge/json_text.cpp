// SPDX-License-Identifier: Apache-2.0
#include "json_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace judge {
namespace {

constexpr int kMostDepth = 100;

class Parser {
 public:
  explicit Parser(const std::string& text) : at_(text.c_str()), begin_(at_) {}

  Json document() {
    Json out = value(0);
    blank();
    if (*at_ != '\0') wrong("something behind the end");
    return out;
  }

 private:
  [[noreturn]] void wrong(const std::string& what) const {
    const long line = 1 + std::count(begin_, at_, '\n');
    throw std::runtime_error(what + " in line " + std::to_string(line));
  }
  void blank() {
    while (*at_ == ' ' || *at_ == '\n' || *at_ == '\t' || *at_ == '\r') ++at_;
  }
  bool take(char c) {
    blank();
    if (*at_ != c) return false;
    ++at_;
    return true;
  }
  void word(const char* expected) {
    const std::size_t n = std::strlen(expected);
    if (std::strncmp(at_, expected, n) != 0) wrong("no value");
    at_ += n;
  }

  Json value(int depth) {
    if (depth > kMostDepth) wrong("nested too deeply");
    blank();
    Json out;
    if (*at_ == '{') return object(depth);
    if (*at_ == '[') return array(depth);
    if (*at_ == '"') {
      out.kind = Json::Kind::kString;
      out.text = string();
    } else if (*at_ == 't' || *at_ == 'f') {
      out.kind = Json::Kind::kBool;
      out.boolean = *at_ == 't';
      word(out.boolean ? "true" : "false");
    } else if (*at_ == 'n') {
      word("null");
    } else {
      number(out);
    }
    return out;
  }

  Json object(int depth) {
    Json out;
    out.kind = Json::Kind::kObject;
    ++at_;
    if (take('}')) return out;
    do {
      blank();
      if (*at_ != '"') wrong("no key");
      std::string name = string();
      if (std::find(out.names.begin(), out.names.end(), name) != out.names.end()) {
        wrong("key twice: " + name);
      }
      if (!take(':')) wrong("no colon");
      out.names.push_back(std::move(name));
      out.items.push_back(value(depth + 1));
    } while (take(','));
    if (!take('}')) wrong("object not closed");
    return out;
  }

  Json array(int depth) {
    Json out;
    out.kind = Json::Kind::kArray;
    ++at_;
    if (take(']')) return out;
    do out.items.push_back(value(depth + 1));
    while (take(','));
    if (!take(']')) wrong("array not closed");
    return out;
  }

  std::string string() {
    std::string out;
    for (++at_; *at_ != '"'; ++at_) {
      if (static_cast<unsigned char>(*at_) < 0x20) wrong("string not closed");
      if (*at_ == '\\') {
        ++at_;
        if (std::strchr("\"\\/bfnrtu", *at_) == nullptr || *at_ == '\0') wrong("unknown escape");
        // letters behind \u stay as they are: no name or figure needs them
        if (*at_ == 'u') out += '\\';
        const char c = *at_;
        out += c == 'n'   ? '\n'
               : c == 't' ? '\t'
               : c == 'r' ? '\r'
               : c == 'b' ? '\b'
               : c == 'f' ? '\f'
                          : c;
        continue;
      }
      out += *at_;
    }
    ++at_;
    return out;
  }

  static bool digit(char c) { return c >= '0' && c <= '9'; }
  const char* digits(const char* p) const {
    if (!digit(*p)) wrong("no number");
    while (digit(*p)) ++p;
    return p;
  }

  void number(Json& out) {
    const char* p = at_;
    if (*p == '-') ++p;
    p = *p == '0' ? p + 1 : digits(p);
    if (*p == '.') p = digits(p + 1);
    if (*p == 'e' || *p == 'E') {
      ++p;
      if (*p == '+' || *p == '-') ++p;
      p = digits(p);
    }
    out.kind = Json::Kind::kNumber;
    out.text.assign(at_, p);
    out.number = std::strtod(out.text.c_str(), nullptr);
    if (!std::isfinite(out.number)) wrong("a number that is no finite double");
    at_ = p;
  }

  const char* at_;
  const char* begin_;
};

[[noreturn]] void not_a(const char* kind) {
  throw std::runtime_error(std::string("a value is no ") + kind);
}

}  // namespace

bool Json::contains(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const Json& Json::at(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::runtime_error("no member " + name);
  return items[static_cast<std::size_t>(found - names.begin())];
}

double Json::real() const {
  if (kind != Kind::kNumber) not_a("number");
  return number;
}

std::size_t Json::index() const {
  if (kind != Kind::kNumber || number < 0.0 || number != std::floor(number) || number > 1e9) {
    not_a("index");
  }
  return static_cast<std::size_t>(number);
}

bool Json::truth() const {
  if (kind != Kind::kBool) not_a("truth value");
  return boolean;
}

const std::string& Json::string() const {
  if (kind != Kind::kString) not_a("string");
  return text;
}

std::vector<double> Json::reals() const {
  if (kind != Kind::kArray) not_a("list");
  std::vector<double> out;
  for (const Json& one : items) out.push_back(one.real());
  return out;
}

ReadJson read_json(const std::string& text) {
  ReadJson out;
  try {
    out.value = Parser(text).document();
  } catch (const std::runtime_error& error) {
    out.fault = error.what();
  }
  return out;
}

const Json& member(const Json& object, const char* name) {
  static const Json none;
  return object.is_object() && object.contains(name) ? object.at(name) : none;
}

Figure figure(const Json& object, const char* name) {
  Figure out;
  if (!object.is_object() || !object.contains(name)) return out;
  out.present = true;
  const Json& value = object.at(name);
  if (value.is_number()) out.value = value.number;
  return out;
}

std::optional<bool> flag(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (value.kind != Json::Kind::kBool) return std::nullopt;
  return value.boolean;
}

std::string text_of(const Json& object, const char* name) {
  const Json& value = member(object, name);
  return value.kind == Json::Kind::kString ? value.text : std::string();
}

}  // namespace judge
