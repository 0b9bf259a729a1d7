// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <utility>
#include <vector>

#include "door.h"
#include "handles.h"
#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/pipeline/internal/space_audit.h"

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

int obvid_space_audit(int degree, size_t count, const double* knots, const double* xyz,
                      const double* weights, const obvid_run* run, char** report,
                      obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    SpaceCurve curve;
    curve.degree = degree;
    if (degree < 1 || degree > kMaxNurbsDegree) {
      return obvid::error(ErrorCode::kBadOption, "a degree that there is not")
          .where("degree")
          .value(degree);
    }
    curve.knots.assign(knots, knots + count + static_cast<size_t>(degree) + 1);
    for (size_t i = 0; i < count; ++i) {
      curve.points.push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
    }
    if (weights != nullptr) curve.weights.assign(weights, weights + count);
    const auto found = audit_in_space(curve, context_of(run));
    OBVID_TRY(found);
    if (report != nullptr) *report = text_of(space_audit_json(*found));
    return {};
  });
}

void obvid_nurbs_free(obvid_nurbs* nurbs) { delete static_cast<OwnedNurbs*>(nurbs); }
}
