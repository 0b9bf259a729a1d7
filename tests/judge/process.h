// SPDX-License-Identifier: Apache-2.0
// Runs a program with limits.
#pragma once

#include <string>
#include <vector>

namespace judge {

struct Finished {
  int code = 0;    ///< exit code; -1 when it did not end by itself
  int signal = 0;  ///< that ended it
  bool out_of_time = false;
  double seconds = 0.0;  ///< of processor time
  std::string out, err;
};

/// `limit`: seconds of processor time; a hundred times as long on the clock.
Finished run_program(const std::vector<std::string>& words, const std::string& folder,
                     double limit);
std::string text_of_file(const std::string& path);
void write_file(const std::string& path, const std::string& text);

}  // namespace judge
