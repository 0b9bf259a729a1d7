// SPDX-License-Identifier: Apache-2.0
#include "program_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

#include "process.h"

namespace judge {

double own_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

ProgramRuns::ProgramRuns(const TrialOptions& options, std::uint64_t index) : options_(options) {
  out_.index = index;
  std::filesystem::remove_all(options.folder);
  std::filesystem::create_directories(options.folder);
}

Run ProgramRuns::program(const std::string& command, std::vector<std::string> words) {
  words.insert(words.begin(), options_.obvid);
  const Finished done = run_program(words, options_.folder, options_.limit);
  out_.program_seconds += done.seconds;
  out_.slowest = std::max(out_.slowest, done.seconds);
  if (out_.command.empty()) {
    for (std::size_t i = 1; i < words.size(); ++i) out_.command += (i > 1 ? " " : "") + words[i];
  }
  std::string line;
  for (std::size_t i = 1; i < words.size(); ++i) line += words[i] + " ";
  if (done.out_of_time) {
    stop(Trial::Outcome::kTimeout, "time limit", line, fmt::format("{:.1f} s", done.seconds));
  } else if (done.signal != 0 || done.code < 0 || done.code > 5) {
    stop(Trial::Outcome::kCrash, "crash", line,
         fmt::format("exit {}, signal {}: {}", done.code, done.signal, done.err.substr(0, 200)));
  } else if (done.code == 1) {
    stop(Trial::Outcome::kFalse, "exit 1", line, done.err.substr(0, 200));
  }
  Run run;
  run.command = command;
  run.code = done.code;
  run.out = done.out;
  run.err = done.err;
  run.input_name = kPoints;
  return run;
}

void ProgramRuns::stop(Trial::Outcome outcome, const std::string& claim, const std::string& line,
                       const std::string& found) {
  if (!stopped_) out_.outcome = outcome;
  stopped_ = true;
  out_.sheet.fails(claim, line, found, "");
}

}  // namespace judge
