// SPDX-License-Identifier: Apache-2.0
// What CLI11 knows of a command, for programs: man pages and completions are made of it
// (tools/make_manuals), so that no list of options is kept anywhere but where they are understood.
#pragma once

#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace obvid {

/// `--help` as lines of fields with tabs between them:
///   program NAME DESCRIPTION
///   command NAME DESCRIPTION
///   argument NAME one|many DESCRIPTION
///   option NAME[,NAME...] VALUE|- once|often GROUP DESCRIPTION
///   footer LINE
/// Options without a group are for nobody's eyes.
class HelpLines : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
    std::string out = line({"program", name, app->get_description()});
    for (const CLI::App* command : app->get_subcommands({})) {
      out += line({"command", command->get_name(), command->get_description()});
    }
    for (const CLI::Option* option : app->get_options()) {
      if (!option->get_group().empty()) out += line_of(*option);
    }
    const std::string footer = app->get_footer();
    for (std::size_t from = 0; from < footer.size();) {
      const std::size_t to = std::min(footer.find('\n', from), footer.size());
      out += line({"footer", footer.substr(from, to - from)});
      from = to + 1;
    }
    return out;
  }

 private:
  /// Line ends and tabs inside a field become blanks.
  static std::string line(std::initializer_list<std::string_view> fields) {
    std::string out;
    for (const std::string_view field : fields) {
      if (!out.empty()) out += '\t';
      for (const char c : field) out += c == '\n' || c == '\t' ? ' ' : c;
    }
    return out + '\n';
  }

  static std::string value_of(const CLI::Option& option) {
    std::string text = option.get_option_text();
    if (text.empty()) text = option.get_type_name();
    return text.empty() ? "-" : text;  // flags have neither
  }

  static std::string line_of(const CLI::Option& option) {
    const bool often = option.get_items_expected_max() >= CLI::detail::expected_max_vector_size;
    if (option.nonpositional()) {
      return line({"option", option.get_name(false, true), value_of(option),
                   often ? "often" : "once", option.get_group(), option.get_description()});
    }
    return line(
        {"argument", option.get_name(true), often ? "many" : "one", option.get_description()});
  }
};

/// Lines that are too long go on below themselves: what is said of an option in its column, where
/// the terminal has room for that.
[[nodiscard]] inline std::string wrapped_help_line(std::string line, std::size_t column,
                                                   std::size_t width) {
  constexpr std::size_t kFewest = 24;  // characters of a line behind its indent
  constexpr std::size_t kIndent = 2;
  const std::size_t lead = std::min(line.find_first_not_of(' '), line.size());
  const bool below = lead >= column;  // goes on in the column
  const bool row =
      line.size() > column && line[column] != ' ' && line[column - 1] == ' ' && lead == kIndent;
  std::size_t indent = below || row ? std::max(lead, column) : lead;
  std::string out;
  if (indent + kFewest >= width) {  // no room in the column: what is said stands below
    indent = std::min(lead + kIndent, 2 * kIndent);
    if (below) {
      line = std::string(indent, ' ') + line.substr(lead);
    } else if (row && line.size() > width) {
      const std::string name = line.substr(0, line.find_last_not_of(' ', column - 1) + 1);
      out = wrapped_help_line(name, column, width) + "\n";
      line = std::string(indent, ' ') + line.substr(column);
    }
  }
  while (line.size() > width) {
    std::size_t at = line.rfind(' ', width);
    if (at == std::string::npos || at <= indent) at = line.find(' ', width);  // a long word
    if (at == std::string::npos || line.find_last_not_of(' ', at) == std::string::npos) break;
    const std::size_t next = line.find_first_not_of(' ', at);
    if (next == std::string::npos) break;
    out += line.substr(0, line.find_last_not_of(' ', at) + 1) + "\n";
    line = std::string(indent, ' ') + line.substr(next);
  }
  return out + line;
}

[[nodiscard]] inline std::string wrapped_help(const std::string& text, std::size_t column,
                                              std::size_t width) {
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    out += wrapped_help_line(text.substr(from, to - from), column, width) + "\n";
    from = to + 1;
  }
  return out;
}

/// Help for the eye: lines as wide as the terminal. `-h` is one page of it: options without a group
/// with the beginning of what is said of them, and the names of the others.
class HelpPage : public CLI::Formatter {
 public:
  HelpPage(bool brief, std::size_t width) : brief_(brief), width_(width) {}

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    return wrapped_help(brief_ ? page(app, name) : CLI::Formatter::make_help(app, name, mode),
                        get_column_width(), width_);
  }

 private:
  [[nodiscard]] std::string page(const CLI::App* app, const std::string& name) const {
    std::string out = make_description(app) + make_usage(app, name) + "\n";
    std::vector<std::string> groups;
    for (const CLI::Option* option : app->get_options()) {
      const std::string& group = option->get_group();
      if (group.empty()) continue;
      if (group == "Options") {
        out += row(*option);
      } else if (std::find(groups.begin(), groups.end(), group) == groups.end()) {
        groups.push_back(group);
      }
    }
    for (const std::string& group : groups) {
      std::string names;
      for (const CLI::Option* option : app->get_options()) {
        if (option->get_group() != group) continue;
        names += (names.empty() ? "" : ", ") + option->get_name(false, false);
      }
      out += "\n" + group + ":\n  " + names + "\n";
    }
    for (const CLI::App* command : app->get_subcommands({})) {
      out += field(command->get_name()) + command->get_description() + "\n";
    }
    return out + "\n--help says all of it: every option with units and default, examples\n";
  }

  [[nodiscard]] std::string row(const CLI::Option& option) const {
    const bool positional = !option.nonpositional();
    return field(option.get_name(positional, true) + (option.get_type_name().empty() || positional
                                                          ? ""
                                                          : " " + option.get_type_name())) +
           beginning(option.get_description()) + "\n";
  }

  [[nodiscard]] std::string field(const std::string& name) const {
    const std::size_t column = get_column_width();
    std::string out = "  " + name;
    if (out.size() + 1 > column) return out + "\n" + std::string(column, ' ');
    return out + std::string(column - out.size(), ' ');
  }

  /// Up to the first colon, semicolon or bracket.
  static std::string beginning(const std::string& text) {
    std::size_t end = text.size();
    for (const char* stop : {": ", "; ", " ["}) end = std::min(end, text.find(stop));
    return text.substr(0, end);
  }

  bool brief_;
  std::size_t width_;
};

/// Characters in a line: of the terminal, else as COLUMNS says, else 100.
[[nodiscard]] inline std::size_t help_width() {
  constexpr long kFewest = 40, kMost = 120, kElse = 100;
  winsize size{};
  long width = kElse;
  if (const char* columns = std::getenv("COLUMNS"); columns != nullptr && std::atol(columns) > 0) {
    width = std::atol(columns);
  }
  if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 &&
      size.ws_col > 0) {
    width = size.ws_col;
  }
  return static_cast<std::size_t>(std::clamp(width, kFewest, kMost));
}

/// Whether one page of help is asked for.
[[nodiscard]] inline bool asks_briefly(int argc, const char* const* argv) {
  return std::any_of(argv, argv + argc,
                     [](const char* one) { return std::string_view(one) == "-h"; });
}

[[nodiscard]] inline bool help_as_lines() {
  const char* wanted = std::getenv("OBVID_HELP");
  return wanted != nullptr && std::string_view(wanted) == "lines";
}

/// How `--help` and `-h` of `app` and of its commands look: names in a column of that width;
/// HelpLines where OBVID_HELP is `lines`. Called before commands are added.
inline void shape_help(CLI::App& app, std::size_t column_width, int argc, const char* const* argv) {
  if (help_as_lines()) {
    app.formatter(std::make_shared<HelpLines>());
  } else {
    const auto page = std::make_shared<HelpPage>(asks_briefly(argc, argv), help_width());
    page->column_width(column_width);
    app.formatter(page);
    app.set_help_flag("-h,--help", "One page of help (-h), or all of it (--help)");
  }
}

}  // namespace obvid
