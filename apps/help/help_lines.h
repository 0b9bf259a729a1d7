// SPDX-License-Identifier: Apache-2.0
// What CLI11 knows of a command, for programs: man pages and completions are made of it
// (tools/make_manuals), so that no list of options is kept anywhere but where they are understood.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

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

[[nodiscard]] inline bool help_as_lines() {
  const char* wanted = std::getenv("OBVID_HELP");
  return wanted != nullptr && std::string_view(wanted) == "lines";
}

/// How `--help` of `app` and of its commands looks: names in a column of that width; HelpLines
/// where OBVID_HELP is `lines`. Called before commands are added.
inline void shape_help(CLI::App& app, std::size_t column_width) {
  if (help_as_lines()) {
    app.formatter(std::make_shared<HelpLines>());
  } else {
    app.get_formatter()->column_width(column_width);
  }
}

}  // namespace obvid
