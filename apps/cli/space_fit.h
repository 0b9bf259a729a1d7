// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "obvid/pipeline/stored.h"
#include "options.h"

namespace obvid {

/// `obvid fit` of points x, y, z that leave the plane of x and y: the exit code; nothing for all
/// other input.
[[nodiscard]] std::optional<int> run_in_space(const FitOptions& options);

/// `obvid verify` and `obvid convert` of a file of such a curve: the exit code.
[[nodiscard]] int verify_in_space(const StoredSpaceChain& stored, const std::string& name,
                                  const VerifyOptions& options);
[[nodiscard]] int convert_in_space(const StoredSpaceChain& stored, const ConvertOptions& options);

}  // namespace obvid
