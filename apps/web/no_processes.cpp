// SPDX-License-Identifier: Apache-2.0
// In a browser there are no other programs to start.
#include <cerrno>

#include "helper_file.h"
#include "helper_process.h"
#include "obvid/core/internal/named_builder.h"

namespace obvid {

bool run_named_builder(const char* /*variable*/) { return false; }

namespace cad {

Result<std::filesystem::path> helper_file() {
  return fail({ErrorCode::kUnsupported,
               "STEP, IGES and BREP are read by another program, which no page can start", "",
               "use the program obvid on your machine", -1, 0.0});
}

Answer ask_helper(const std::string& /*program*/, std::string_view /*request*/,
                  const CadRun& /*run*/) {
  return {Answer::End::kNotStarted, ENOSYS, {}};
}

}  // namespace cad
}  // namespace obvid
