// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "batch_build_mark.h"
#include "commands.h"
#include "obvid/core/internal/named_builder.h"
#include "obvid/core/internal/part_program.h"
#include "terminal.h"

namespace obvid {
namespace {

/// Beside this program, or where the install puts it; without a builder what is there serves.
/// Error: E310.
Result<std::filesystem::path> batch_program() {
  if (std::getenv("OBVID_BATCH_BUILDER") == nullptr || run_named_builder("OBVID_BATCH_BUILDER")) {
    const std::filesystem::path own = own_file();
    const PartProgram part{"the program for batches", "obvid-batch",
                           "obvid-batch " OBVID_BATCH_BUILD_MARK};
    const auto found = find_part(part_folders(own), own, part);
    OBVID_TRY(found);
    if (*found) return **found;
  }
  return error(ErrorCode::kUnsupported, "batches were not built with this program")
      .where("batch")
      .hint("build them with tools/build_batch, or install obvid-batch");
}

}  // namespace

int run(const BatchOptions& options) {
  const auto program = batch_program();
  if (!program) return report(program.error());
  std::vector<std::string> words{"obvid batch"};
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program->c_str(), arguments.data());
  return report({ErrorCode::kInternal, "the program for batches could not be started",
                 program->string(), "build it again"});
}

}  // namespace obvid
