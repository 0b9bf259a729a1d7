// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/report/trade_off.h"

namespace obvid {

/// Chart of the vertices found and of their lower bound over the tolerance, as one self-contained
/// SVG file in the viewer's light or dark scheme.
[[nodiscard]] std::string trade_off_svg(const TradeOff& trade_off);

}  // namespace obvid
