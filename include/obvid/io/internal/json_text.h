// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "obvid/core/internal/questions.h"
#include "obvid/core/units.h"

namespace obvid {

/// Grows one JSON text; commas and escapes are its business, nesting the caller's.
/// Numbers read back to the same double; NaN and infinity become null. Where a watch says stop,
/// what follows is left out, and the text is worth nothing.
class JsonText {
 public:
  explicit JsonText(Watch* watch = nullptr) : questions_(watch) {}

  JsonText& begin_object();
  JsonText& end_object();
  JsonText& begin_array();
  JsonText& end_array();
  JsonText& key(std::string_view name);
  JsonText& value(double number);
  JsonText& value(std::size_t number);
  JsonText& value(int number);
  JsonText& value(bool flag);
  JsonText& value(std::string_view text);
  JsonText& value(const char* text) { return value(std::string_view(text)); }
  JsonText& null();
  /// Text that is JSON already.
  JsonText& raw(std::string_view json);
  template <class Value>
  JsonText& pair(std::string_view name, const Value& what) {
    return key(name).value(what);
  }
  [[nodiscard]] std::string take();

 private:
  /// False: the text ends here.
  bool before_value();
  std::string text_;
  bool comma_ = false;
  Questions questions_;
};

/// "units", the name as it stands or is assumed, and "units_source", how it is known.
void add_units(JsonText& json, const Units& units);

}  // namespace obvid
