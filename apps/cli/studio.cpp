// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "obvid/core/named_builder.h"
#include "terminal.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

/// Without a builder, what was installed serves.
bool built() {
  return std::getenv("OBVID_STUDIO_BUILDER") == nullptr ||
         run_named_builder("OBVID_STUDIO_BUILDER");
}

/// Beside this program, or where the install puts it.
std::string studio_program() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& place :
       {folder / "obvid-studio", folder / "../libexec/obvid/obvid-studio"}) {
    if (::access(place.c_str(), X_OK) == 0) return place.string();
  }
  return {};
}

}  // namespace

int run(const StudioOptions& options) {
  const std::string program = built() ? studio_program() : std::string();
  if (program.empty()) {
    return report({ErrorCode::kUnsupported, "the studio was not built with this program", "studio",
                   "build it with tools/build_studio, or install it"});
  }
  std::vector<std::string> words{"obvid studio"};
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  return report(
      {ErrorCode::kInternal, "the studio could not be started", program, "build it again"});
}

}  // namespace obvid
