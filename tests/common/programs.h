// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace obvid {

/// Whether a program is there to be run.
inline bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// What a command prints, and how it ends: 0 where all went well, -1 where it could not be run.
struct RanCommand {
  std::string printed;
  int status = -1;
};
inline RanCommand ran(const std::string& command) {
  RanCommand out;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    out.printed.append(buffer.data(), n);
  }
  out.status = ::pclose(pipe);
  return out;
}

/// Its standard output.
inline std::string output_of(const std::string& command) { return ran(command).printed; }

/// What a judge prints, what it says on its standard error included, and that it failed.
inline std::string judged_by(const std::string& command) {
  RanCommand done = ran(command + " 2>&1");
  if (done.status != 0) done.printed += "\nfailed";
  return done.printed;
}

}  // namespace obvid

#define SKIP_WITHOUT_PROGRAM(program) \
  if (!obvid::is_installed(program)) GTEST_SKIP() << (program) << " is not installed"
