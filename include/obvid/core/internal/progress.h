// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace obvid {

/// Called now and then on long work with the stage's name and the part done in [0, 1].
/// An empty function means that nobody listens.
using Progress = std::function<void(std::string_view stage, double fraction)>;

}  // namespace obvid
