// SPDX-License-Identifier: Apache-2.0
// Shared by the units that describe commands to CLI11, which is slow to compile.
#pragma once

#include <CLI/TypeTools.hpp>
#include <cstdlib>
#include <string>

/// The double nearest to what was typed. CLI11 itself reads a long double and rounds that again,
/// which is another number for one value in some thousands. Known before anything of CLI11 uses it.
template <>
inline bool CLI::detail::lexical_cast<double>(const std::string& typed, double& value) {
  char* end = nullptr;
  value = std::strtod(typed.c_str(), &end);
  return !typed.empty() && end == typed.c_str() + typed.size();
}

#include <CLI/CLI.hpp>
#include <vector>

#include "help/help_lines.h"
#include "obvid/core/internal/near_name.h"
#include "obvid/core/result.h"
#include "obvid/pipeline/internal/job_values.h"

namespace obvid {

[[nodiscard]] Error usage(std::string what, std::string hint);

[[nodiscard]] std::vector<std::string> option_names(const CLI::App& app);

/// Refuses what `command` did not understand; `name` is the command as users type it.
[[nodiscard]] Result<void> check_extras(const CLI::App& command,
                                        const std::vector<std::string>& extras,
                                        const std::string& name);

/// An error of CLI11 in the words of this program.
[[nodiscard]] Error from_cli(const CLI::ParseError& error, const std::string& name);

/// Width of the column of names in `--help`.
inline constexpr std::size_t kHelpColumn = 28;

/// Of `--corner-angle`, wherever points become contours.
inline constexpr const char* kCornerAngleHelp =
    "Least turn of a corner, degrees; when it is given, coarse polygons have corners at all points "
    "that turn by it, else where points stand out from smooth neighbours [20]";

}  // namespace obvid
