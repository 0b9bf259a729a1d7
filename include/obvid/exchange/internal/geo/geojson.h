// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// LineString, MultiLineString, Polygon, MultiPolygon (each line and ring a series), MultiPoint,
/// and all Points together as one series; as geometries, features, collections of both (RFC 7946).
/// Longitude and latitude are projected to metres around their middle (`LocalProjection`), across
/// the antimeridian too. Where a `crs` of the older standard names another system, or a position
/// lies outside longitudes of -360..360 and latitudes of -90..90, the coordinates are taken as
/// plane ones in metres, with a warning.
///
/// Linear time. Errors: E308 text that is no JSON (line and column), brackets nested more than 64
/// deep, values of the wrong type (path of the value); E310 other kinds of JSON or geometry; E304
/// no line of two different places; E309 places more than 3,000 km from their middle meridian.
/// Never throws on any input. `name` stands in errors.
[[nodiscard]] Result<Drawing> parse_geojson(std::string_view text, std::string_view name);

}  // namespace obvid
