// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/geo/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geodesic.h"

namespace obvid {
namespace {

/// Arc of the meridian between two latitudes by Simpson's rule: a (1 - e^2) / (1 - e^2
/// sin^2)^(3/2).
double meridian_arc(double from, double to) {
  constexpr double kDegree = std::numbers::pi / 180.0, kF = 1.0 / 298.257223563;
  constexpr double kE2 = kF * (2.0 - kF);
  const auto radius = [&](double latitude) {
    const double s = std::sin(kDegree * latitude);
    return 6378137.0 * (1.0 - kE2) / std::pow(1.0 - kE2 * s * s, 1.5);
  };
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int k = 0; k <= kSteps; ++k) {
    const double weight = k == 0 || k == kSteps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    sum += weight * radius(from + (to - from) * k / kSteps);
  }
  return sum * kDegree * (to - from) / (3.0 * kSteps);
}

TEST(Projection, TheMiddleMeridianHasItsTrueLength) {
  for (const double centre : {-60.0, 0.0, 35.0, 89.0}) {
    const LocalProjection projection({17.0, centre});
    for (const double latitude : {-89.0, -30.0, 10.0, 52.5, 90.0}) {
      const Vec2 p = projection.to_plane({17.0, latitude});
      EXPECT_NEAR(p.y, meridian_arc(centre, latitude), 1e-6) << centre << " " << latitude;
      EXPECT_NEAR(p.x, 0.0, 1e-9);
    }
  }
}

/// The plane is too long by x^2 / (6 R^2) on the way from the meridian to x; its chord is the image
/// of the geodesic to a higher order.
TEST(Projection, DistancesAreThoseOfGeodesicsToTheStatedScale) {
  for (const double latitude : {-70.0, -35.0, 0.0, 46.0, 80.0}) {
    const LocalProjection projection({11.0, latitude});
    for (const double metres : {10.0, 1e3, 1e4, 1e5}) {
      for (const double direction : {0.0, 0.7, 1.6, 3.0, 4.4}) {
        const double degrees = metres / 111e3;
        const GeoPoint place = {
            11.0 + degrees * std::cos(direction) / std::cos(latitude * std::numbers::pi / 180.0),
            latitude + degrees * std::sin(direction)};
        const Vec2 p = projection.to_plane(place);
        const double distance = geodesic_distance({11.0, latitude}, place);
        const double too_long = distance * p.x * p.x / (6.0 * 6.38e6 * 6.38e6);
        // Vincenty's 0.1 mm is stated carefully; the radius of curvature varies by half a percent.
        EXPECT_NEAR(norm(p), distance + too_long, 1e-5 + 0.02 * too_long + 1e-9 * distance);
      }
    }
  }
}

TEST(Projection, AnglesAreKept) {
  const LocalProjection projection({-120.0, 48.0});
  const double step = 1e-4;
  for (const double longitude : {-135.0, -121.0, -100.0}) {
    const GeoPoint p = {longitude, 50.0};
    const Vec2 east = projection.to_plane({p.longitude + step, p.latitude}) -
                      projection.to_plane({p.longitude - step, p.latitude});
    const Vec2 north = projection.to_plane({p.longitude, p.latitude + step}) -
                       projection.to_plane({p.longitude, p.latitude - step});
    EXPECT_NEAR(dot(east, north) / (norm(east) * norm(north)), 0.0, 1e-8);
    const double e =
        geodesic_distance({p.longitude + step, p.latitude}, {p.longitude - step, p.latitude});
    const double n =
        geodesic_distance({p.longitude, p.latitude + step}, {p.longitude, p.latitude - step});
    EXPECT_NEAR(norm(east) / e, norm(north) / n, 3e-5);
  }
}

/// 48.8582 N, 2.2945 E is 448251.9 E, 5411932.7 N in zone 31 of UTM (scale 0.9996 at 3 E, easting
/// 500,000 there).
TEST(Projection, AgreesWithUtm) {
  const Vec2 p = LocalProjection({3.0, 0.0}).to_plane({2.2945, 48.8582});
  EXPECT_NEAR(0.9996 * p.x + 500000.0, 448251.9, 0.5);
  EXPECT_NEAR(0.9996 * p.y, 5411932.7, 0.5);
}

TEST(Projection, TheAntimeridianAndThePolesAreNoEdges) {
  const LocalProjection fiji({180.0, -17.0});
  const Vec2 west = fiji.to_plane({179.99, -17.0}), east = fiji.to_plane({-179.99, -17.0});
  EXPECT_NEAR(east.x, -west.x, 1e-6);
  EXPECT_NEAR(norm(east - west), geodesic_distance({179.99, -17.0}, {-179.99, -17.0}), 1e-4);
  const LocalProjection pole({0.0, 90.0});
  const Vec2 a = pole.to_plane({90.0, 89.9}), b = pole.to_plane({-90.0, 89.9});
  const double arc = meridian_arc(89.9, 90.0), too_long = arc * arc / (6.0 * 6.38e6 * 6.38e6);
  EXPECT_NEAR(norm(a - b), 2.0 * arc * (1.0 + too_long), 1e-3);
  EXPECT_NEAR(pole.to_plane({180.0, 89.9}).y, meridian_arc(89.9, 90.0), 1e-6);
}

}  // namespace
}  // namespace obvid
