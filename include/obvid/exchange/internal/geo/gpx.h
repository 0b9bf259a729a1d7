// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// Tracks (each segment a series), routes, and all waypoints together as one series, projected to
/// metres around their middle (`LocalProjection`), units "m". Across the antimeridian and the poles
/// too. Points without a latitude in [-90, 90] and a longitude in [-180, 360) are left out with a
/// warning that names the first line. Heights and times are not used.
///
/// Linear time. Errors: E308 XML that is not well-formed (truncated files), E310 another kind of
/// XML, E304 no line of two different places, E309 places more than 3,000 km from their middle
/// meridian. Never throws on any input. `name` stands in errors.
[[nodiscard]] Result<Drawing> parse_gpx(std::string_view text, std::string_view name);

}  // namespace obvid
