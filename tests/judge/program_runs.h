// SPDX-License-Identifier: Apache-2.0
// Runs of the program within one trial, and what becomes of it when one of them fails.
#pragma once

#include <string>
#include <vector>

#include "texts.h"
#include "trial.h"

namespace judge {

/// Processor time of this thread: what judging costs, programs that it runs left out.
double own_seconds();

class ProgramRuns {
 protected:
  /// Empties the folder.
  ProgramRuns(const TrialOptions& options, std::uint64_t index);

  static constexpr const char* kPoints = "points.csv";

  [[nodiscard]] std::string path(const std::string& name) const {
    return options_.folder + "/" + name;
  }
  /// A crash, exit code 1 and a run that takes too long end the trial.
  Run program(const std::string& command, std::vector<std::string> words);

  const TrialOptions& options_;
  Trial out_;
  bool stopped_ = false;

 private:
  void stop(Trial::Outcome outcome, const std::string& claim, const std::string& line,
            const std::string& found);
};

}  // namespace judge
