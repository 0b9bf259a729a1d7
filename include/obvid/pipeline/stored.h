// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>
#include <variant>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/report/stored_contour.h"
#include "obvid/report/stored_space.h"

namespace obvid {

/// What a contour file holds: a contour of the plane, or curves in space.
using Stored = std::variant<StoredContour, StoredSpaceChain>;

/// Reads a contour file (docs/formats.md) from its text. `name` stands in errors.
/// Errors: E103, E308, E309, E310 as `contour_from_json` and `space_chain_from_json` say.
[[nodiscard]] Result<Stored> parse_stored(const std::string& text, const std::string& name,
                                          const RunContext& run = {});

}  // namespace obvid
