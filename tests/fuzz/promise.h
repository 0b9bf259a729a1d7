// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>

namespace obvid {

/// Stops the target when a promise is broken, and says which one: file and line of the call.
/// The builtins, since the standard library beside clang 14 has no source_location for it.
inline void require(bool promise, const char* file = __builtin_FILE(),
                    int line = __builtin_LINE()) {
  if (promise) return;
  std::fprintf(stderr, "a promise is broken: %s:%d\n", file, line);
  std::abort();
}

}  // namespace obvid
