// SPDX-License-Identifier: Apache-2.0
// Files with one sentence changed.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "checks.h"
#include "process.h"
#include "sheet.h"
#include "texts.h"
#include "trial.h"

namespace judge {

inline std::string data(const std::string& name) {
  const std::string text = text_of_file(std::string(OBVID_TEST_DATA) + "/" + name);
  EXPECT_FALSE(text.empty()) << name;
  return text;
}

/// The text with the n-th occurrence (from 0) of something replaced; it must be there.
inline std::string changed(std::string text, const std::string& what, const std::string& by,
                           int n = 0) {
  std::size_t at = text.find(what);
  for (; n > 0 && at != std::string::npos; --n) at = text.find(what, at + what.size());
  EXPECT_NE(at, std::string::npos) << what;
  if (at != std::string::npos) text.replace(at, what.size(), by);
  return text;
}

/// The value behind the n-th occurrence of a key replaced.
inline std::string with(std::string text, const std::string& key, const std::string& value,
                        int n = 0) {
  const std::string name = "\"" + key + "\": ";
  std::size_t at = text.find(name);
  for (; n > 0 && at != std::string::npos; --n) at = text.find(name, at + name.size());
  EXPECT_NE(at, std::string::npos) << key;
  if (at == std::string::npos) return text;
  const std::size_t from = at + name.size();
  std::size_t to = from;
  int depth = 0;
  for (; to < text.size(); ++to) {
    const char c = text[to];
    if (depth == 0 && (c == ',' || c == '}' || c == ']' || c == '\n')) break;
    depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
  }
  return text.replace(from, to - from, value);
}

inline Sheet judged(const std::string& text) {
  Sheet sheet;
  judge_contour(text, sheet);
  return sheet;
}

inline std::string all_false(const Sheet& sheet) {
  std::string out;
  for (const Finding& f : sheet.findings()) {
    if (f.kind == Finding::Kind::kFalse) {
      out += f.claim + ": " + f.stated + ", found " + f.found + " (" + f.where + ")\n";
    }
  }
  return out;
}

/// A claim that holds in one text and is found false in the other.
inline void expect_found(const std::string& sound, const std::string& doctored,
                         const std::string& claim) {
  EXPECT_FALSE(judged(sound).has(claim)) << claim << "\n" << all_false(judged(sound));
  EXPECT_TRUE(judged(doctored).has(claim)) << claim << "\n" << all_false(judged(doctored));
}

}  // namespace judge
