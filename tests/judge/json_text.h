// SPDX-License-Identifier: Apache-2.0
// JSON read strictly (RFC 8259): well-formed, no key twice, every number a finite double.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace judge {

class Json {
 public:
  enum class Kind { kNull, kBool, kNumber, kString, kArray, kObject };

  [[nodiscard]] bool is_null() const { return kind == Kind::kNull; }
  [[nodiscard]] bool is_number() const { return kind == Kind::kNumber; }
  [[nodiscard]] bool is_array() const { return kind == Kind::kArray; }
  [[nodiscard]] bool is_object() const { return kind == Kind::kObject; }
  [[nodiscard]] std::size_t size() const { return items.size(); }
  [[nodiscard]] const Json& operator[](std::size_t i) const { return items[i]; }
  [[nodiscard]] auto begin() const { return items.begin(); }
  [[nodiscard]] auto end() const { return items.end(); }
  [[nodiscard]] bool contains(const std::string& name) const;

  // These throw std::runtime_error where the value is of another kind or absent.
  [[nodiscard]] const Json& at(const std::string& name) const;
  [[nodiscard]] double real() const;
  [[nodiscard]] std::size_t index() const;  ///< a whole number from 0
  [[nodiscard]] bool truth() const;
  [[nodiscard]] const std::string& string() const;
  [[nodiscard]] std::vector<double> reals() const;

  Kind kind = Kind::kNull;
  bool boolean = false;
  double number = 0.0;
  std::string text;                ///< of a string; of a number as written
  std::vector<Json> items;         ///< of an array, values of an object
  std::vector<std::string> names;  ///< of an object
};

/// What is wrong with a text, or its value.
struct ReadJson {
  Json value;
  std::string fault;  ///< empty: none
};
ReadJson read_json(const std::string& text);

/// A figure of an object: absent, null, or a number.
struct Figure {
  bool present = false;
  std::optional<double> value;

  [[nodiscard]] bool null() const { return present && !value; }
  [[nodiscard]] bool known() const { return value.has_value(); }
};
Figure figure(const Json& object, const char* name);
std::optional<bool> flag(const Json& object, const char* name);
std::string text_of(const Json& object, const char* name);
/// The member of this name, or null.
const Json& member(const Json& object, const char* name);

}  // namespace judge
