// SPDX-License-Identifier: Apache-2.0
#include "cli_app.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace obvid {

Error usage(std::string what, std::string hint) {
  return {ErrorCode::kUsage, std::move(what), {}, std::move(hint)};
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

Result<void> check_extras(const CLI::App& command, const std::vector<std::string>& extras,
                          const std::string& name) {
  if (extras.empty()) return {};
  const std::string see = "see obvid " + name + " --help";
  for (const std::string& extra : extras) {
    if (!extra.starts_with("-")) continue;
    const std::string option = extra.substr(0, extra.find('='));
    return fail(usage("unknown option '" + option + "' of " + name,
                      did_you_mean(option, option_names(command), see)));
  }
  return fail(usage("one argument too many: '" + extras.front() + "'", see));
}

namespace {

/// `--option = value`, as the parser ends its sentence about a value that it cannot read.
std::optional<Error> unreadable_value(const std::string& what, const std::string& help) {
  const auto colon = what.find(": "), equals = what.find(" = ");
  if (colon == std::string::npos || equals == std::string::npos || equals < colon) {
    return std::nullopt;
  }
  const std::string option = what.substr(colon + 2, equals - colon - 2);
  std::string value = what.substr(equals + 3);
  std::string hint = help;
  if (value.find_first_not_of("0123456789,+-eE") == std::string::npos &&
      std::count(value.begin(), value.end(), ',') == 1) {
    std::string point = value;
    std::replace(point.begin(), point.end(), ',', '.');
    hint = "write it with a decimal point: " + point + "; " + help;
  }
  return bad_option("'" + value + "' is no value of " + option, "", hint);
}

}  // namespace

Error from_cli(const CLI::ParseError& error, const std::string& name) {
  std::string what = error.what();
  while (!what.empty() && (what.back() == '\n' || what.back() == '.')) what.pop_back();
  const std::string help = "`obvid " + name + " --help` shows units and defaults";
  const bool unread = dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
  if (auto told = unread ? unreadable_value(what, help) : std::nullopt) return *told;
  if (unread || dynamic_cast<const CLI::ValidationError*>(&error) != nullptr) {
    return bad_option(what, "", help);
  }
  return usage(what, "see obvid --help");
}

}  // namespace obvid
