// SPDX-License-Identifier: Apache-2.0
// Only for tests/recipes: sums of two curves.
#include "kinds.h"

namespace obvid {

std::array<Range, 2> ranges_of(const TranslationSurface& s) {
  return {domain(s.one), domain(s.other)};
}

SurfaceJet evaluate_kind(const TranslationSurface& s, double u, double v) {
  const SpaceJet a = evaluate(s.one, u), b = evaluate(s.other, v);
  return {a.point + b.point, a.d1, b.d1, a.d2, {}, b.d2};
}

Result<NurbsForm> nurbs_of(const TranslationSurface& s, double /*tolerance*/) {
  for (const SpaceCurve* curve : {&s.one, &s.other}) {
    OBVID_TRY(check(*curve));
    if (!curve->weights.empty()) {
      return fail(error(ErrorCode::kUnsupported, "sums of rational curves are not made"));
    }
  }
  NurbsForm form{{s.one.degree, s.other.degree, s.one.knots, s.other.knots, {}, {}}, 0.0};
  for (const Vec3& b : s.other.points) {
    for (const Vec3& a : s.one.points) form.surface.points.push_back(a + b);
  }
  return form;
}

}  // namespace obvid
