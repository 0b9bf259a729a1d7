// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/geo/projection.h"

#include <cmath>
#include <numbers>

#include "obvid/geom/internal/angle.h"

namespace obvid {
namespace {

constexpr double kSemiMajor = 6378137.0;                  // m, WGS84
constexpr double kFlattening = 1.0 / 298.257223563;       // WGS84
constexpr double kMeanRadius = 6380e3;                    // m, for the scale only
constexpr double kN = kFlattening / (2.0 - kFlattening);  // third flattening

/// Radius of the sphere whose meridian is as long as that of the ellipsoid.
constexpr double kRectifying =
    kSemiMajor / (1.0 + kN) * (1.0 + kN * kN / 4.0 * (1.0 + kN * kN / 16.0));

/// Coefficients of Krueger's series, Karney (2011) eq. 35, to n^4.
constexpr std::array<double, 4> kAlpha = {
    kN * (1.0 / 2.0 + kN * (-2.0 / 3.0 + kN * (5.0 / 16.0 + kN * 41.0 / 180.0))),
    kN* kN*(13.0 / 48.0 + kN * (-3.0 / 5.0 + kN * 557.0 / 1440.0)),
    kN* kN* kN*(61.0 / 240.0 - kN * 103.0 / 140.0),
    kN* kN* kN* kN * 49561.0 / 161280.0,
};

/// tan of the conformal latitude (Karney eq. 7 to 9).
double conformal_tan(double latitude) {
  const double eccentricity = std::sqrt(kFlattening * (2.0 - kFlattening));
  const double tau = std::tan(latitude), secant = std::sqrt(1.0 + tau * tau);
  const double sigma = std::sinh(eccentricity * std::atanh(eccentricity * std::sin(latitude)));
  return tau * std::sqrt(1.0 + sigma * sigma) - sigma * secant;
}

/// Easting and northing from the equator, `longitude` from the meridian; radians.
Vec2 kruegers_series(double longitude, double latitude) {
  const double tau = conformal_tan(latitude), c = std::cos(longitude);
  const double xi = std::atan2(tau, c);
  const double eta = std::asinh(std::sin(longitude) / std::sqrt(tau * tau + c * c));
  double x = eta, y = xi;
  for (std::size_t j = 0; j < kAlpha.size(); ++j) {
    const double k = 2.0 * static_cast<double>(j + 1);
    x += kAlpha[j] * std::cos(k * xi) * std::sinh(k * eta);
    y += kAlpha[j] * std::sin(k * xi) * std::cosh(k * eta);
  }
  return {kRectifying * x, kRectifying * y};
}

}  // namespace

LocalProjection::LocalProjection(GeoPoint centre)
    : centre_(centre), northing_(kruegers_series(0.0, kOneDegree * centre.latitude).y) {}

Vec2 LocalProjection::to_plane(GeoPoint place) const {
  const double longitude = longitude_from(centre_.longitude, place.longitude);
  const Vec2 p = kruegers_series(kOneDegree * longitude, kOneDegree * place.latitude);
  return {p.x, p.y - northing_};
}

double projection_scale(double x) { return std::cosh(x / kMeanRadius); }

double longitude_from(double reference, double longitude) {
  return std::remainder(longitude - reference, 360.0);
}

}  // namespace obvid
