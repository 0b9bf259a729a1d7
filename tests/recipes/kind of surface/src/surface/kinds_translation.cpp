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
  for (const SpaceCurve* curve : {&s.one, &s.other}) OBVID_TRY(check(*curve));
  const auto weight = [](const SpaceCurve& curve, std::size_t i) {
    return curve.weights.empty() ? 1.0 : curve.weights[i];
  };
  const bool rational = !s.one.weights.empty() || !s.other.weights.empty();
  NurbsForm form{{s.one.degree, s.other.degree, s.one.knots, s.other.knots, {}, {}}, 0.0};
  for (std::size_t j = 0; j < s.other.points.size(); ++j) {
    for (std::size_t i = 0; i < s.one.points.size(); ++i) {
      form.surface.points.push_back(s.one.points[i] + s.other.points[j]);
      if (rational) form.surface.weights.push_back(weight(s.one, i) * weight(s.other, j));
    }
  }
  return form;
}

}  // namespace obvid
