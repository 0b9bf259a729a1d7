// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "obvid/core/internal/named_builder.h"
#include "obvid/core/internal/part_program.h"
#include "studio_build_mark.h"
#include "terminal.h"

namespace obvid {
namespace {

/// Without a builder, what was installed serves.
bool built() {
  return std::getenv("OBVID_STUDIO_BUILDER") == nullptr ||
         run_named_builder("OBVID_STUDIO_BUILDER");
}

/// Beside this program, or where the install puts it. Error: E310.
Result<std::filesystem::path> studio_program() {
  if (built()) {
    const std::filesystem::path own = own_file();
    const PartProgram part{"the studio", "obvid-studio", "obvid-studio " OBVID_STUDIO_BUILD_MARK};
    const auto found = find_part(part_folders(own), own, part);
    if (!found) return fail(found.error());
    if (*found) return **found;
  }
  return fail({ErrorCode::kUnsupported, "the studio was not built with this program", "studio",
               "build it with tools/build_studio, or install it", -1, 0.0});
}

}  // namespace

int run(const StudioOptions& options) {
  const auto program = studio_program();
  if (!program) return report(program.error());
  std::vector<std::string> words{"obvid studio"};
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program->c_str(), arguments.data());
  return report({ErrorCode::kInternal, "the studio could not be started", program->string(),
                 "build it again"});
}

}  // namespace obvid
