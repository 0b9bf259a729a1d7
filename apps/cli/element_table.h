// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/pipeline/element_table.h"

namespace obvid {

/// Elements with stations, lengths, radii, A, azimuths and coordinates, these told to a millionth
/// of `size`; speeds where there is a limit.
[[nodiscard]] std::string elements_text(const std::vector<AlignmentElement>& elements, double size,
                                        const std::optional<SpeedLimit>& limit = {});

/// Grades and vertical curves with stations, lengths, heights, grades, radii and K values.
[[nodiscard]] std::string profile_text(const VerticalProfile& profile, double size);

}  // namespace obvid
