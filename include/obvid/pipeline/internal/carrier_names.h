// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace obvid::pipeline_detail {

/// Names of the carriers that a fit forms, in the order of the table and of comparisons.
inline constexpr std::array kFormedCarriers = {
#define OBVID_CARRIER(enumerator, word, ...) std::string_view(#word),
#define OBVID_CARRIER_AS_DRAWN(...)
#include "obvid/curve/carriers.inc"
#undef OBVID_CARRIER
#undef OBVID_CARRIER_AS_DRAWN
};

}  // namespace obvid::pipeline_detail
