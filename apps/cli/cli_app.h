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
#include "obvid/pipeline/internal/format_values.h"
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

/// `-o OUT`, and `--format` of what goes to standard output.
void add_output(CLI::App& command, std::vector<std::string>& outputs, std::string& format,
                const std::string& help, const char* fallback = "json");

/// "obvid fit --noise 0.01": what was typed behind `program`, but for files and what merely
/// concerns the terminal.
[[nodiscard]] std::string asked_for(const CLI::App& command, const std::string& program);

/// What stands below the options of a command: `text`, which may be empty, and the exit codes.
[[nodiscard]] std::string with_exit_codes(const std::string& text);

/// Group of the options of what is read.
inline constexpr const char* kReadingGroup = "Reading the input";
/// --mirror, --scale, --rotate, --move.
void add_placement(CLI::App& command, FormatValues& values);
/// What is looked at before anything else: columns, lines, places.
void add_reading(CLI::App& command, FormatValues& values);
/// That, and how curves of drawings are taken.
void add_import(CLI::App& command, FormatValues& values);
/// `--cut`, of commands that read drawings.
void add_planes(CLI::App& command, FormatValues& values, const char* group);

/// Gives `-o -` its ending, `fallback` where --format says none. True: something goes to standard
/// output, and nothing else may. Error: E203 where `taken`, an option, sends something else there,
/// or --format has no `-o -` beside it.
[[nodiscard]] Result<bool> take_standard_output(std::vector<std::string>& outputs,
                                                const std::string& format, const char* taken,
                                                const char* fallback = "json");

/// Where the results of a command go: one thing at most to standard output, which is then all that
/// stands there. Error: E203.
template <class Options>
[[nodiscard]] Result<void> settle_streams(Options& options, const std::string& format,
                                          bool csv = false, const char* fallback = "json") {
  if (options.json && csv) {
    return fail(
        bad_option("standard output cannot hold two things", "--csv", "leave it or --json out"));
  }
  const char* taken = options.json ? "--json" : csv ? "--csv" : nullptr;
  const auto streamed = take_standard_output(options.outputs, format, taken, fallback);
  OBVID_TRY(streamed);
  if (*streamed) options.quiet = true;
  return {};
}

/// What a command takes in place of a missing input: "-" where something comes through a pipe or
/// from a file, else nothing. Waits for it; reads nothing.
[[nodiscard]] std::string input_or_pipe(const std::string& input);
/// The same for a list.
[[nodiscard]] std::vector<std::string> inputs_or_pipe(std::vector<std::string> inputs);

/// Width of the column of names in `--help`.
inline constexpr std::size_t kHelpColumn = 28;

/// Of `--corner-angle`, wherever points become contours.
inline constexpr const char* kCornerAngleHelp =
    "Least turn of a corner, degrees; when it is given, coarse polygons have corners at all points "
    "that turn by it, else where points stand out from smooth neighbours [20]";

}  // namespace obvid
