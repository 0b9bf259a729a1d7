// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "obvid/geom/vec2.h"

namespace obvid {

/// A place on the ellipsoid WGS84, degrees.
struct GeoPoint {
  double longitude = 0.0;  ///< east positive; turns of 360 do not matter
  double latitude = 0.0;   ///< north positive, -90 to 90
};

/// Transverse Mercator projection of WGS84 on the meridian of its centre, scale 1 there: metres
/// east and north of the centre. Conformal: angles, and so headings and the signs of curvature, are
/// those on the ground. The scale at x metres from that meridian is 1 + x^2 / (2 R^2), R = 6380
/// km: 1.2e-6 too long at 10 km, 1.2e-4 at 100 km.
///
/// The series of Krueger (1912) to the fourth order, as in Karney, J. Geodesy 85 (2011) eq. 7-11
/// and 35: rounding of 1e-9 m and a truncation below 1e-6 m within 3,000 km of the meridian.
/// Constant time. docs/methods/road_formats.md, section 1.
class LocalProjection {
 public:
  explicit LocalProjection(GeoPoint centre);

  [[nodiscard]] GeoPoint centre() const { return centre_; }
  /// Finite for every finite longitude and a latitude in [-90, 90]; beyond a quarter of the globe
  /// from the meridian it has no meaning.
  [[nodiscard]] Vec2 to_plane(GeoPoint place) const;

 private:
  GeoPoint centre_;
  double northing_ = 0.0;
};

/// Scale of `LocalProjection` at `x` metres from its meridian, on the sphere.
[[nodiscard]] double projection_scale(double x);

/// Longitude moved by whole turns into [-180, 180) around `reference`, relative to it.
[[nodiscard]] double longitude_from(double reference, double longitude);

}  // namespace obvid
