// SPDX-License-Identifier: Apache-2.0
#include "cli_app.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <optional>
#include <string>
#include <utility>

#include "commands.h"
#include "obvid/core/units.h"

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

namespace {

/// Why a command takes one input alone, or where many of them go; docs/decisions/0011.
std::string why_one(const std::string& name, const std::string& see) {
  if (name == "spline" || name == "nurbs") {
    return "many tables at once: obvid batch FILES -o out.h5 --job " + name;
  }
  if (name == "toolpath") return "a program mills one part: one surface at a time; " + see;
  if (name == "surface cut") {
    return "one surface at a time: {id} in names of files stands for its branches; " + see;
  }
  return see;
}

/// Where a unit comes from that cannot be told to a command.
std::string instead_of(const std::string& option, const std::string& name,
                       const std::string& hint) {
  if (option != "--units") return hint;
  if (name == "verify") return "the unit is that of the file; obvid convert --units names another";
  if (name == "toolpath" || name == "surface check" || name == "surface cut") {
    return "the unit is that of the surface; obvid surface convert --units names another";
  }
  return hint;
}

}  // namespace

Result<void> check_extras(const CLI::App& command, const std::vector<std::string>& extras,
                          const std::string& name) {
  if (extras.empty()) return {};
  const std::string see = "see obvid " + name + " --help";
  for (const std::string& extra : extras) {
    if (!extra.starts_with("-")) continue;
    const std::string option = extra.substr(0, extra.find('='));
    return fail(usage("unknown option '" + option + "' of " + name,
                      instead_of(option, name, did_you_mean(option, option_names(command), see))));
  }
  return fail(usage("one argument too many: '" + extras.front() + "'", why_one(name, see)));
}

std::string with_exit_codes(const std::string& text) {
  return text + (text.empty() ? "" : "\n\n") +
         "Exit codes: 0 done and proved, 2 wrong usage, 3 input unreadable or malformed, 4 no "
         "such\n"
         "contour exists, 5 formed but not proved or tolerance not reached, 1 anything else.";
}

void add_output(CLI::App& command, std::vector<std::string>& outputs, std::string& format,
                const std::string& help, const char* fallback) {
  command.add_option("-o,--output", outputs, help + "; - is standard output; may be repeated")
      ->type_name("OUT")
      ->allow_extra_args(false);
  command
      .add_option("--format", format,
                  std::string("Of -o -, a file extension: json, svg, ... [") + fallback + "]")
      ->type_name("NAME");
}

namespace {

template <class Value>
void add_reading_option(CLI::App& command, const char* name, Value& value, const char* type,
                        const char* help) {
  command.add_option(name, value, help)->type_name(type)->group(kReadingGroup);
}

}  // namespace

void add_placement(CLI::App& command, FormatValues& values) {
  add_reading_option(
      command, "--mirror", values.mirror, "AXIS",
      "Across the axis x (y changes its sign) or y; given headings and curvatures of the file go "
      "along, in options they are those of the result; then:");
  add_reading_option(command, "--scale", values.scale, "F",
                     "All lengths times F; the unit keeps its name; then:");
  add_reading_option(command, "--rotate", values.rotate_deg, "DEG",
                     "About the origin, degrees counter-clockwise; then:");
  add_reading_option(command, "--move", values.move, "DX,DY",
                     "By these lengths along x and y (and z: DX,DY,DZ)");
}

void add_reading(CLI::App& command, FormatValues& values) {
  add_reading_option(
      command, "--columns", values.columns, "X,Y",
      "Columns of x and y in a list of points, counted from 1, whatever their names [as the names "
      "say; else 1,2]");
  add_reading_option(command, "--skip", values.skip, "N",
                     "Lines at the beginning that are not looked at [0]");
  add_placement(command, values);
}

void add_import(CLI::App& command, FormatValues& values) {
  add_reading(command, values);
  command
      .add_flag("--unordered", values.unordered,
                "The points are a cloud: put them in the order of their curve, the shortest row "
                "through them; numbers of points in options are those of the row")
      ->group(kReadingGroup);
  command
      .add_flag("--drop-outliers", values.drop_outliers,
                "Leave out measured points that lie off the curve of their neighbours, far beyond "
                "the scatter of the others; they are named. Numbers of points in options are those "
                "of what is left")
      ->group(kReadingGroup);
  const char* group = "Drawings as input";
  command
      .add_option("--curve", values.curve,
                  "Which curve of a drawing (STEP, IGES, BREP, DXF, ...): its number from 1, its "
                  "name, or a word of the name that no other has (a handle, a layer); all: each "
                  "of them, where a command takes several [the longest]")
      ->type_name("N|NAME|all")
      ->group(group);
  command
      .add_option("--chord-tolerance", values.chord_tolerance,
                  "Largest distance of a chord from the curve that is sampled, input units [1e-4 "
                  "of its size]")
      ->type_name("T")
      ->group(group);
  command
      .add_option("--drawing", values.drawing,
                  "Which pieces stay as they are drawn: auto (lines, arcs, ellipses, clothoids; "
                  "chords of curves and splines become points), exact (every line), points (none) "
                  "[auto]")
      ->type_name("NAME")
      ->group(group);
  add_planes(command, values, group);
}

void add_planes(CLI::App& command, FormatValues& values, const char* group) {
  command
      .add_option("--cut", values.cut,
                  "Planes that cut a mesh (STL, PLY, OBJ), input units: z=12, or "
                  "z=FROM:STEP:TO; x and y likewise; may be repeated. Every section is a curve for "
                  "--curve [none]")
      ->allow_extra_args(false)
      ->type_name("PLANES")
      ->group(group);
}

Result<bool> take_standard_output(std::vector<std::string>& outputs, const std::string& format,
                                  const char* taken, const char* fallback) {
  bool any = false;
  for (std::string& output : outputs) {
    if (output != "-") continue;
    any = true;
    const std::string ending = format.empty() ? fallback : format;
    output = (ending.starts_with(".") ? "-" : "-.") + ending;
  }
  if (!any && !format.empty()) {
    return fail(bad_option("the format of a file is its extension", "--format",
                           "it is for standard output: -o -"));
  }
  if (any && taken != nullptr) {
    return fail(bad_option("standard output cannot hold two things", taken,
                           "leave it out, or name a file for -o"));
  }
  return any;
}

namespace {

/// Waits for the first byte or the end of a pipe.
bool pipe_has_bytes(int file) {
  pollfd pipe{file, POLLIN, 0};
  int bytes = 0;
  while (::poll(&pipe, 1, -1) < 0) {
    if (errno != EINTR) return false;
  }
  return ::ioctl(file, FIONREAD, &bytes) == 0 && bytes > 0;
}

}  // namespace

std::string input_or_pipe(const std::string& input) {
  struct stat in {};
  if (!input.empty() || ::fstat(STDIN_FILENO, &in) != 0) return input;
  if (S_ISREG(in.st_mode)) {
    if (::lseek(STDIN_FILENO, 0, SEEK_CUR) >= in.st_size) return input;
  } else if (!S_ISFIFO(in.st_mode) || !pipe_has_bytes(STDIN_FILENO)) {
    return input;
  }
  keep_standard_input();
  return "-";
}

std::vector<std::string> inputs_or_pipe(std::vector<std::string> inputs) {
  if (!inputs.empty()) return inputs;
  std::string piped = input_or_pipe("");
  if (!piped.empty()) inputs.push_back(std::move(piped));
  return inputs;
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
  const std::size_t digits = value.find_first_not_of("0123456789.+-");
  if (digits != std::string::npos && digits > 0 && std::isalpha(value[digits]) != 0 &&
      canonical_unit(value.substr(digits))) {
    hint = "write the number alone, " + value.substr(0, digits) + ": lengths are in the unit of " +
           "the input; " + help;
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

namespace {

/// A word as a shell takes it.
std::string shell_word(const std::string& word) {
  const bool plain =
      !word.empty() && word.find_first_of(" \t\n'\"\\$`*?[]{}()<>|&;#~!") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string asked_for(const CLI::App& command, const std::string& program) {
  constexpr std::array kLeftOut = {"--output", "--format", "--json",
                                   "--csv",    "--quiet",  "--no-progress"};
  std::string out = program;
  for (const CLI::Option* option : command.get_options()) {
    const bool left_out =
        std::find(kLeftOut.begin(), kLeftOut.end(), option->get_name()) != kLeftOut.end();
    if (option->count() == 0 || !option->nonpositional() || left_out) continue;
    out += " " + option->get_name();
    if (option->get_items_expected_max() == 0) continue;
    for (const std::string& value : option->results()) out += " " + shell_word(value);
  }
  return out;
}

}  // namespace obvid
