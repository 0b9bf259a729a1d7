// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"

namespace obvid::capi {

// Options are a JSON object; each name has a setter for its value.

using Json = nlohmann::json;
using Setter = std::function<bool(const Json&)>;  // false: another type of value is meant

inline Setter flag(bool& to) {
  return [&to](const Json& value) {
    if (value.is_boolean()) to = value.get<bool>();
    return value.is_boolean();
  };
}

template <class To>
Setter number(To& to) {
  return [&to](const Json& value) {
    if (value.is_number()) to = value.get<double>();
    return value.is_number();
  };
}

inline Setter count(std::optional<long>& to) {
  return [&to](const Json& value) {
    if (value.is_number_integer()) to = static_cast<long>(value.get<std::int64_t>());
    return value.is_number_integer();
  };
}

/// A text, or a number in its place; dumped numbers read back to the same double.
inline std::string typed(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

inline bool is_typed(const Json& value) { return value.is_string() || value.is_number(); }

template <class To>
Setter text(To& to) {
  return [&to](const Json& value) {
    if (is_typed(value)) to = typed(value);
    return is_typed(value);
  };
}

/// A text, or a list of them.
inline Setter texts(std::vector<std::string>& to) {
  return [&to](const Json& value) {
    if (value.is_string()) {
      to = {value.get<std::string>()};
      return true;
    }
    if (!value.is_array()) return false;
    for (const Json& one : value) {
      if (!one.is_string()) return false;
      to.push_back(one.get<std::string>());
    }
    return true;
  };
}

/// {"5": 90}: a value for each of some points.
inline Setter at_points(std::vector<std::string>& to) {
  return [&to](const Json& value) {
    if (!value.is_object()) return false;
    for (const auto& [point, one] : value.items()) {
      if (!is_typed(one)) return false;
      to.push_back(point + "=" + typed(one));
    }
    return true;
  };
}

/// [3, 7]
inline Setter points(std::vector<std::string>& to) {
  return [&to](const Json& value) {
    if (!value.is_array()) return false;
    for (const Json& one : value) {
      if (!is_typed(one)) return false;
      to.push_back(typed(one));
    }
    return true;
  };
}

/// [9, 9]
inline Setter counts(std::vector<long>& to) {
  return [&to](const Json& value) {
    if (!value.is_array()) return false;
    for (const Json& one : value) {
      if (!one.is_number_integer()) return false;
      to.push_back(static_cast<long>(one.get<std::int64_t>()));
    }
    return true;
  };
}

/// NULL and "" are no options. Error: E308 no JSON object.
[[nodiscard]] Result<Json> options_in(const char* options);

/// Errors: E201 a name that is not known; E203 another type of value.
[[nodiscard]] Result<void> take(const Json& object, const std::map<std::string, Setter>& known);

}  // namespace obvid::capi
