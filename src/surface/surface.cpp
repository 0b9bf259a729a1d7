// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/surface.h"

#include <algorithm>

#include "kinds.h"

namespace obvid {
namespace {

struct Name {
  std::string operator()(const NurbsSurface&) const { return "NURBS surface"; }
  std::string operator()(const RuledSurface&) const { return "ruled surface between two curves"; }
  std::string operator()(const DirectedSurface&) const {
    return "ruled surface of a directrix and directions";
  }
  std::string operator()(const RevolutionSurface&) const { return "surface of revolution"; }
  std::string operator()(const CoonsPatch&) const { return "Coons patch"; }
  std::string operator()(const GordonSurface&) const { return "Gordon surface"; }
  std::string operator()(const OffsetSurface&) const { return "offset surface"; }
  std::string operator()(const IdSurface&) const { return "integro-differential spline surface"; }
};

constexpr Range kUnit{0.0, 1.0};

/// Largest distance of the NURBS form from the definition on a raster.
double measured(const Surface& surface, const NurbsSurface& form) {
  constexpr int kSteps = 40;
  double worst = 0.0;
  const Range u = domain_u(form), v = domain_v(form);
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const double a = u.at(static_cast<double>(i) / kSteps),
                   b = v.at(static_cast<double>(j) / kSteps);
      worst = std::max(worst, norm(evaluate(surface, a, b).point - evaluate(form, a, b).point));
    }
  }
  return worst;
}

template <class Kind>
Result<NurbsForm> form_of(const Kind& kind, double tolerance) {
  if constexpr (std::is_same_v<Kind, NurbsSurface>) {
    if (auto good = check(kind); !good) return fail(good.error());
    return NurbsForm{kind, 0.0};
  } else if constexpr (std::is_same_v<Kind, CoonsPatch> || std::is_same_v<Kind, GordonSurface>) {
    auto form = nurbs_of(kind, tolerance);
    if (form && form->deviation > 0.0) {
      form->deviation = std::max(measured(kind, form->surface), form->deviation / 3.0);
    }
    return form;
  } else if constexpr (std::is_same_v<Kind, OffsetSurface>) {
    if (auto good = check(kind.base); !good) return fail(good.error());
    return nurbs_of(kind, tolerance);
  } else {
    return nurbs_of(kind);
  }
}

Result<void> check_curves(const Surface& surface) {
  std::vector<const SpaceCurve*> curves;
  if (const auto* s = std::get_if<RuledSurface>(&surface)) curves = {&s->first, &s->second};
  if (const auto* s = std::get_if<DirectedSurface>(&surface))
    curves = {&s->directrix, &s->direction};
  if (const auto* s = std::get_if<RevolutionSurface>(&surface)) curves = {&s->profile};
  for (const SpaceCurve* curve : curves) {
    if (auto good = check(*curve); !good) return good;
  }
  return {};
}

}  // namespace

std::string kind_of(const Surface& surface) { return std::visit(Name{}, surface); }

Range domain_u(const Surface& surface) {
  if (const auto* s = std::get_if<NurbsSurface>(&surface)) return domain_u(*s);
  if (const auto* s = std::get_if<OffsetSurface>(&surface)) return domain_u(s->base);
  if (const auto* s = std::get_if<IdSurface>(&surface)) return {s->x.x.front(), s->x.x.back()};
  return kUnit;
}

Range domain_v(const Surface& surface) {
  if (const auto* s = std::get_if<NurbsSurface>(&surface)) return domain_v(*s);
  if (const auto* s = std::get_if<OffsetSurface>(&surface)) return domain_v(s->base);
  if (const auto* s = std::get_if<IdSurface>(&surface)) return {s->x.y.front(), s->x.y.back()};
  if (const auto* s = std::get_if<DirectedSurface>(&surface)) return {s->from, s->to};
  return kUnit;
}

SurfaceJet evaluate(const Surface& surface, double u, double v) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (std::is_same_v<std::decay_t<decltype(s)>, NurbsSurface>) {
          return evaluate(s, u, v);
        } else {
          return evaluate_kind(s, u, v);
        }
      },
      surface);
}

Result<NurbsForm> to_nurbs(const Surface& surface, double tolerance) {
  if (auto good = check_curves(surface); !good) return fail(good.error());
  return std::visit([&](const auto& s) { return form_of(s, tolerance); }, surface);
}

}  // namespace obvid
