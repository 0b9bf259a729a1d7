// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid {

/// Runs the program that an environment variable names, which builds a part that is not built with
/// the rest; its standard output goes to standard error. True when it ended with 0; false when the
/// variable is not set, is not to be trusted (a program with more rights than its caller), or the
/// builder failed. Blocks until it has ended.
[[nodiscard]] bool run_named_builder(const char* variable);

}  // namespace obvid
