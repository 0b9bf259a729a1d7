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
  bool flag = false;
  std::vector<std::string> values{};
};

/// What was typed of all options that jobs know; they must not move while `app` lives.
struct JobOptions {
  std::vector<TypedOption> job, files;
};

[[nodiscard]] JobOptions known_options();
void add_job_options(CLI::App& app, JobOptions& options);

/// {"noise": 0.01, "heading-at": {"5": "90"}}
[[nodiscard]] std::string options_json(const std::vector<TypedOption>& options);

}  // namespace obvid::batch
