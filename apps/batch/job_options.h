// SPDX-License-Identifier: Apache-2.0
// Options of jobs, as `obvid fit` and the others have them, turned into what the C interface takes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace obvid::batch {

/// One option of a job as it was typed.
struct TypedOption {
  std::string name;
  bool is_flag = false;
  bool of_points = false;  ///< I=V, by point
  bool flag = false;
  std::vector<std::string> values{};
};

/// What was typed of all options that jobs know; they must not move while `app` lives.
struct JobOptions {
  std::vector<TypedOption> job, files;
};

/// Those of a job; "": of all jobs, for help.
[[nodiscard]] JobOptions known_options(const std::string& job);
/// --job as it was typed, before anything is understood; "" where it was not.
[[nodiscard]] std::string typed_job(int argc, char** argv);
void add_job_options(CLI::App& app, JobOptions& options);

/// {"noise": 0.01, "heading-at": {"5": "90"}}
[[nodiscard]] std::string options_json(const std::vector<TypedOption>& options);

}  // namespace obvid::batch
