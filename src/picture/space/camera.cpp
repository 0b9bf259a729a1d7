// SPDX-License-Identifier: Apache-2.0
#include "space/camera.h"

#include <array>
#include <cmath>
#include <numbers>

#include "obvid/geom/internal/angle.h"

namespace obvid::picture {
namespace {

struct Angles {
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
};
/// In the order of `SurfaceView`; the page has the same.
constexpr std::array<Angles, 6> kAngles = {
    {{35.0, 28.0}, {0.0, 0.0}, {0.0, 90.0}, {90.0, 0.0}, {180.0, 0.0}, {0.0, -90.0}}};

}  // namespace

PictureCamera camera_of(const SurfacePictureOptions& options) {
  const Angles named = kAngles[static_cast<std::size_t>(options.view)];
  const double a = kOneDegree * options.azimuth_deg.value_or(named.azimuth_deg);
  const double e = kOneDegree * options.elevation_deg.value_or(named.elevation_deg);
  PictureCamera camera;
  camera.right = {std::cos(a), std::sin(a), 0.0};
  camera.up = {-std::sin(a) * std::sin(e), std::cos(a) * std::sin(e), std::cos(e)};
  camera.back = cross(camera.right, camera.up);
  return camera;
}

}  // namespace obvid::picture
