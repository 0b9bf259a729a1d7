// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/error.h"

namespace obvid {

std::string to_line(const Error& error) {
  std::string line = "obvid: error E" + std::to_string(static_cast<int>(error.code)) + ": ";
  line += error.what;
  if (!error.where.empty()) {
    line += " (" + error.where + ")";
  }
  if (!error.hint.empty()) {
    line += "; " + error.hint;
  }
  // The contract is one line, whatever a file name or a quoted word of the input contains.
  for (char& c : line) {
    if (c == '\n' || c == '\r') {
      c = ' ';
    }
  }
  return line;
}

}  // namespace obvid
