// SPDX-License-Identifier: Apache-2.0
// Shared by the units that describe commands to CLI11, which is slow to compile.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "obvid/core/result.h"

namespace obvid {

[[nodiscard]] Error usage(std::string what, std::string hint);

/// "did you mean NAME?", or `otherwise` when no name is near.
[[nodiscard]] std::string did_you_mean(const std::string& typed,
                                       const std::vector<std::string>& names,
                                       const std::string& otherwise);

[[nodiscard]] std::vector<std::string> option_names(const CLI::App& app);

/// Refuses what `command` did not understand; `name` is the command as users type it.
[[nodiscard]] Result<void> check_extras(const CLI::App& command,
                                        const std::vector<std::string>& extras,
                                        const std::string& name);

/// An error of CLI11 in the words of this program.
[[nodiscard]] Error from_cli(const CLI::ParseError& error, const std::string& name);

/// E203: `typed` is none of the names that an option knows.
[[nodiscard]] Error unknown_name(const std::string& typed, const std::vector<std::string>& names,
                                 const char* option);

/// What a name stands for. Error: E203 with the nearest name.
template <class Value>
[[nodiscard]] Result<Value> value_named(const std::map<std::string, Value>& values,
                                        const std::string& typed, const char* option) {
  const auto at = values.find(typed);
  if (at != values.end()) return at->second;
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return fail(unknown_name(typed, names, option));
}

}  // namespace obvid
