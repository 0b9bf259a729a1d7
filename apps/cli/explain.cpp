// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>

#include "commands.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/internal/summary.h"
#include "terminal.h"

namespace obvid {
namespace {

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

std::string codes_csv(std::span<const ErrorText> texts) {
  DataTable table{heads_of("code,exit_code,title,meaning,remedy")};
  for (const ErrorText& text : texts) {
    table.rows.push_back({code_text(text.code), std::to_string(exit_code(text.code)),
                          std::string(text.title), std::string(text.meaning),
                          std::string(text.remedy)});
  }
  return csv_text(table);
}

std::string list_of_codes(const ExplainOptions& options) {
  if (options.json) return error_texts_json();
  if (options.csv) return codes_csv(error_texts());
  std::string lines;
  for (const ErrorText& text : error_texts()) {
    lines += fmt::format("{}  {}\n", code_text(text.code), text.title);
  }
  return lines;
}

}  // namespace

int run(const ExplainOptions& options) {
  std::string text;
  if (options.code.empty()) {
    text = list_of_codes(options);
  } else {
    const auto found = error_text_of(options.code);
    if (!found) return report(found.error());
    if (options.json) {
      text = error_text_json(*found);
    } else if (options.csv) {
      text = codes_csv(std::span(&*found, 1));
    } else {
      text = fmt::format("{}\n\n{}\n{}\nExit code {}.\n",
                         bold(fmt::format("{}: {}", code_text(found->code), found->title)),
                         wrapped(found->meaning, ""), wrapped(found->remedy, ""),
                         exit_code(found->code));
    }
  }
  if (options.quiet) return 0;
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
