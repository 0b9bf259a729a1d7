// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/cutting/cutting.h"

namespace obvid::cutting {

/// Error: E203, with the option as the command line names it.
[[nodiscard]] Result<void> check_cut_options(const CutOptions& options);

/// Sentences about options that have no use beside others.
[[nodiscard]] std::vector<std::string> idle_cut_options(const CutOptions& options);

}  // namespace obvid::cutting
