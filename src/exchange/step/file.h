// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "obvid/core/internal/questions.h"

namespace obvid::exchange {

/// Number of an instance: #12.
struct StepId {
  int number = 0;
};

/// Values as ISO 10303-21 writes them: a REAL has a point, and the fewest digits that give the
/// double back.
[[nodiscard]] std::string step_value(double value);
[[nodiscard]] std::string step_value(int value);
[[nodiscard]] std::string step_value(StepId id);

/// (1.,2.,3.)
template <class Value>
[[nodiscard]] std::string step_list(std::span<const Value> values) {
  std::string out = "(";
  for (const Value& value : values) {
    if (out.size() > 1) out += ',';
    out += step_value(value);
  }
  return out + ')';
}

/// A text in quotation marks; its own marks and backslashes doubled, letters beyond ASCII in hex,
/// signs of control as blanks.
[[nodiscard]] std::string step_string(std::string_view text);

/// Collects the instances of the data section, numbered as they come.
/// Cancelled, it leaves out what comes then.
class StepFile {
 public:
  explicit StepFile(Watch* watch) : questions_(watch) {}

  /// Of one of many: whether what comes is left out.
  [[nodiscard]] bool has_ended() { return questions_.end(); }
  /// `record`: POINT(1.,2.). Long ones are broken into lines behind commas.
  StepId add(std::string_view record);

  /// The whole file. `name` of the product, not yet in marks; `schema` as FILE_SCHEMA has it.
  [[nodiscard]] std::string text(std::string_view name, std::string_view schema) const;

 private:
  std::string data_;
  int count_ = 0;
  Questions questions_;
};

}  // namespace obvid::exchange
