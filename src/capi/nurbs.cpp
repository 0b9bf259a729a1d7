// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <utility>
#include <vector>

#include "door.h"
#include "handles.h"
#include "obvid/contour/bsplines/nurbs_of.h"

namespace obvid::capi {
namespace {

/// What the caller sees, and the numbers that it points to.
struct OwnedNurbs : obvid_nurbs {
  NurbsCurve curve;
  std::vector<double> coordinates;

  explicit OwnedNurbs(NurbsCurve made) : obvid_nurbs{}, curve(std::move(made)) {
    coordinates.reserve(2 * curve.points.size());
    for (const Vec2 p : curve.points) {
      coordinates.push_back(p.x);
      coordinates.push_back(p.y);
    }
    degree = curve.degree;
    count = curve.points.size();
    knots = curve.knots.data();
    xy = coordinates.data();
    weights = curve.weights.data();
  }
};

}  // namespace
}  // namespace obvid::capi

using namespace obvid;
using namespace obvid::capi;

extern "C" {

int obvid_contour_nurbs(const obvid_contour* contour, obvid_nurbs** nurbs, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    auto made = nurbs_of(contour->stored.contour);
    OBVID_TRY(made);
    *nurbs = std::make_unique<OwnedNurbs>(std::move(made->curve)).release();
    return {};
  });
}

void obvid_nurbs_free(obvid_nurbs* nurbs) { delete static_cast<OwnedNurbs*>(nurbs); }
}
