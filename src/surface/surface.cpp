// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/surface.h"

#include <algorithm>

#include "kinds.h"
#include "obvid/geom/internal/box.h"

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

Range ends_of(const std::vector<double>& nodes) {
  return nodes.empty() ? kUnit : Range{nodes.front(), nodes.back()};
}

/// Places in the spans of knots, thinned where there are very many.
std::vector<double> span_samples(const std::vector<double>& knots) {
  constexpr std::size_t kMost = 120;
  std::vector<double> at;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const Range span{knots[k - 1], knots[k]};
    if (!(span.length() > 0.0)) continue;
    // half way is where cubics with the right ends and slopes err most
    for (const double part : {0.0, 0.2, 0.5, 0.8}) at.push_back(span.at(part));
  }
  at.push_back(knots.back());
  // odd, so that all places within spans have their turn
  const std::size_t step = (1 + at.size() / kMost) | 1U;
  std::vector<double> thinned;
  for (std::size_t i = 0; i < at.size(); i += step) thinned.push_back(at[i]);
  return thinned;
}

/// Largest distance of the NURBS form from the definition on a raster.
double form_error(const Surface& surface, const NurbsSurface& form) {
  const std::vector<double> us = span_samples(form.knots_u), vs = span_samples(form.knots_v);
  double worst = 0.0;
  for (const double v : vs) {
    for (const double u : us) {
      worst = std::max(worst, norm(evaluate(surface, u, v).point - evaluate(form, u, v).point));
    }
  }
  constexpr double kBetween = 1.1;  // what errors rise between samples
  return kBetween * worst;
}

/// Coons and Gordon of rational curves: errors of the curves add, and interpolation across a net
/// makes them larger by some factor that is found by trying.
template <class Kind>
Result<NurbsForm> network_form(const Kind& kind, double tolerance) {
  constexpr int kTries = 5;
  double share = tolerance;
  for (int i = 0; i < kTries; ++i, share /= 4.0) {
    auto form = nurbs_of(kind, share, tolerance);
    if (!form || form->deviation == 0.0) return form;
    form->deviation = std::max(form_error(kind, form->surface), form->deviation / 3.0);
    if (form->deviation <= tolerance) return form;
  }
  return error(ErrorCode::kToleranceNotReached, "rational curves of a net are not followed")
      .hint("allow a larger tolerance")
      .value(tolerance);
}

template <class Kind>
Result<NurbsForm> form_of(const Kind& kind, double tolerance) {
  if constexpr (std::is_same_v<Kind, NurbsSurface>) {
    OBVID_TRY(check(kind));
    return NurbsForm{kind, 0.0};
  } else if constexpr (std::is_same_v<Kind, CoonsPatch> || std::is_same_v<Kind, GordonSurface>) {
    return network_form(kind, tolerance);
  } else if constexpr (std::is_same_v<Kind, OffsetSurface>) {
    OBVID_TRY(check(kind.base));
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
    OBVID_TRY(check(*curve));
  }
  return {};
}

}  // namespace

std::string kind_of(const Surface& surface) { return std::visit(Name{}, surface); }

Range domain_u(const Surface& surface) {
  if (const auto* s = std::get_if<NurbsSurface>(&surface)) return domain_u(*s);
  if (const auto* s = std::get_if<OffsetSurface>(&surface)) return domain_u(s->base);
  if (const auto* s = std::get_if<IdSurface>(&surface)) return ends_of(s->x.x);
  return kUnit;
}

Range domain_v(const Surface& surface) {
  if (const auto* s = std::get_if<NurbsSurface>(&surface)) return domain_v(*s);
  if (const auto* s = std::get_if<OffsetSurface>(&surface)) return domain_v(s->base);
  if (const auto* s = std::get_if<IdSurface>(&surface)) return ends_of(s->x.y);
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
  OBVID_TRY(check_curves(surface));
  return std::visit([&](const auto& s) { return form_of(s, tolerance); }, surface);
}

std::vector<const NurbsSurface*> surfaces_of(const SurfaceModel& model) {
  std::vector<const NurbsSurface*> surfaces;
  for (const SurfacePatch& patch : model.patches) surfaces.push_back(&patch.surface);
  return surfaces;
}

double size_of(const SurfaceModel& model) { return size_of(surfaces_of(model)); }

double size_of(const std::vector<const NurbsSurface*>& surfaces) {
  Box3 box;
  for (const NurbsSurface* surface : surfaces) {
    for (const Vec3& p : surface->points) box.add(p);
  }
  return box.low.x <= box.high.x ? norm(box.size()) : 0.0;
}

}  // namespace obvid
