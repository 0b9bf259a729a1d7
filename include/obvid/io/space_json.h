// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <string_view>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/report/stored_space.h"

namespace obvid {

/// Points of part `k` of a chain of `count` points: their indices, in order.
[[nodiscard]] std::vector<std::size_t> points_of_part(const std::vector<SpaceCorner>& corners,
                                                      bool closed, std::size_t count,
                                                      std::size_t k);

/// Whether a text is such a file rather than that of a contour: an object that names the format.
[[nodiscard]] bool is_space_json(std::string_view text);

/// Errors: E308 with the path of the field, E309, E310 as for contours; those of `check` for the
/// NURBS curve.
[[nodiscard]] Result<StoredSpace> space_from_json(std::string_view text, std::string_view name,
                                                  Watch* watch = nullptr);

/// A curve in space, or a chain of them. Errors: those of `space_from_json`; E308 where corners do
/// not ascend or the number of parts does not belong to them.
[[nodiscard]] Result<StoredSpaceChain> space_chain_from_json(std::string_view text,
                                                             std::string_view name,
                                                             Watch* watch = nullptr);

}  // namespace obvid
