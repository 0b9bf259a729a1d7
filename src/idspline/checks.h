// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "obvid/core/error.h"

namespace obvid::idspline {

/// E304, E303, E402 or E309: why these cannot be nodes, or nothing. `name`: "node", "row", ...
[[nodiscard]] std::optional<Error> refuse_nodes(std::span<const double> nodes,
                                                std::string_view name = "node");

/// E201 when there are not `expected` numbers, E303 when one is not finite.
[[nodiscard]] std::optional<Error> refuse_data(std::span<const double> data, std::size_t expected,
                                               std::string_view name);

/// E309 when a result of finite data is not finite.
[[nodiscard]] std::optional<Error> refuse_overflow(std::span<const double> result,
                                                   std::string_view name);

}  // namespace obvid::idspline
