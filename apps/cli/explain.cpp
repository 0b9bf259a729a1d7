// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "commands.h"
#include "obvid/core/internal/near_name.h"
#include "obvid/pipeline/internal/report_json.h"
#include "terminal.h"

namespace obvid {
namespace {

std::string name_of(ErrorCode code) { return fmt::format("E{}", static_cast<int>(code)); }

/// Whole sentences broken into lines that fit a terminal.
std::string wrapped(std::string_view text, std::string_view indent) {
  constexpr std::size_t kWidth = 78;
  std::string out;
  std::string line(indent);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    if (line.size() + 1 + word.size() > kWidth && line.size() > indent.size()) {
      out += line + "\n";
      line = indent;
    }
    if (line.size() > indent.size()) line += ' ';
    line += word;
    at = end + 1;
  }
  return out + line + "\n";
}

std::string list_of_codes(bool as_json) {
  if (as_json) return error_texts_json();
  std::string lines;
  for (const ErrorText& text : error_texts()) {
    lines += fmt::format("{}  {}\n", name_of(text.code), text.title);
  }
  return lines;
}

Error unknown_code(const std::string& typed) {
  std::vector<std::string> names;
  for (const ErrorText& text : error_texts()) names.push_back(name_of(text.code));
  const std::string near = nearest_name(typed, names);
  return {ErrorCode::kUsage, fmt::format("there is no error code '{}'", typed), "",
          near.empty() ? "`obvid explain` lists all codes" : fmt::format("did you mean {}?", near)};
}

}  // namespace

int run(const ExplainOptions& options) {
  std::string text;
  if (options.code.empty()) {
    text = list_of_codes(options.json);
  } else {
    std::string typed = options.code;
    if (std::isdigit(static_cast<unsigned char>(typed[0])) != 0) typed = fmt::format("E{}", typed);
    typed[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(typed[0])));
    const auto all = error_texts();
    const auto same = [&typed](const ErrorText& t) { return name_of(t.code) == typed; };
    const auto found = std::find_if(all.begin(), all.end(), same);
    if (found == all.end()) return report(unknown_code(typed));
    if (options.json) {
      text = error_text_json(*found);
    } else {
      text = fmt::format(
          "{}\n\n{}\n{}\nExit code {}.\n", bold(fmt::format("{}: {}", typed, found->title)),
          wrapped(found->meaning, ""), wrapped(found->remedy, ""), exit_code(found->code));
    }
  }
  if (options.quiet) return 0;
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
