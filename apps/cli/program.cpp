// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <new>

#include "commands.h"
#include "terminal.h"

namespace obvid {

int run(const ShowText& shown) {
  if (auto done = put(shown.text); !done) return report(done.error());
  return 0;
}

namespace {

int run_program(int argc, const char* const* argv) {
  const Result<Command> command = parse_command_line(argc, argv);
  if (!command) return report(command.error());
  return (*command)();
}

}  // namespace

int run_guarded(int argc, const char* const* argv) {
  // The library does not throw; what still arrives here is a lack of memory or a fault of ours.
  try {
    return run_program(argc, argv);
  } catch (const std::bad_alloc&) {
    return report({ErrorCode::kInternal, "out of memory", "",
                   "try with fewer points or on a larger machine"});
  } catch (const std::exception& error) {
    return report({ErrorCode::kInternal, error.what(), "", "please report this"});
  }
}

}  // namespace obvid
