// SPDX-License-Identifier: Apache-2.0
#include "splines.h"

#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>

namespace obvid::cad {
namespace {

gp_Pnt point_of(Vec3 p) { return {p.x, p.y, p.z}; }

/// Weights that are all the same say nothing.
bool is_rational(const std::vector<double>& weights) {
  return std::any_of(weights.begin(), weights.end(),
                     [&](double w) { return w != weights.front(); });
}

std::vector<double> all_knots(const TColStd_Array1OfReal& values,
                              const TColStd_Array1OfInteger& multiplicities) {
  std::vector<double> out;
  for (int i = values.Lower(); i <= values.Upper(); ++i) {
    out.insert(out.end(), static_cast<std::size_t>(multiplicities(i)), values(i));
  }
  return out;
}

/// Knots may begin before the domain; cut there, the spline is clamped.
void clamp(const Handle(Geom_BSplineSurface) & spline) {
  if (spline->IsUPeriodic()) spline->SetUNotPeriodic();
  if (spline->IsVPeriodic()) spline->SetVNotPeriodic();
  const bool u = spline->UMultiplicity(1) <= spline->UDegree() ||
                 spline->UMultiplicity(spline->NbUKnots()) <= spline->UDegree();
  const bool v = spline->VMultiplicity(1) <= spline->VDegree() ||
                 spline->VMultiplicity(spline->NbVKnots()) <= spline->VDegree();
  if (!u && !v) return;
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  spline->Bounds(u0, u1, v0, v1);
  spline->Segment(u0, u1, v0, v1);
}

}  // namespace

KnotTable knot_table(const std::vector<double>& knots) {
  std::vector<double> values;
  std::vector<int> counts;
  for (const double knot : knots) {
    if (!values.empty() && values.back() == knot) {
      ++counts.back();
    } else {
      values.push_back(knot);
      counts.push_back(1);
    }
  }
  const int m = static_cast<int>(values.size());
  KnotTable out{TColStd_Array1OfReal(1, m), TColStd_Array1OfInteger(1, m)};
  for (int i = 0; i < m; ++i) {
    out.values(i + 1) = values[static_cast<std::size_t>(i)];
    out.multiplicities(i + 1) = counts[static_cast<std::size_t>(i)];
  }
  return out;
}

Handle(Geom_BSplineCurve) spline_of(const SpaceCurve& curve) {
  const int n = static_cast<int>(curve.points.size());
  const bool rational = is_rational(curve.weights);
  TColgp_Array1OfPnt poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    poles(i + 1) = point_of(curve.points[k]);
    weights(i + 1) = rational ? curve.weights[k] : 1.0;
  }
  const KnotTable knots = knot_table(curve.knots);
  if (!rational) {
    return new Geom_BSplineCurve(poles, knots.values, knots.multiplicities, curve.degree);
  }
  return new Geom_BSplineCurve(poles, weights, knots.values, knots.multiplicities, curve.degree);
}

Handle(Geom_BSplineSurface) spline_of(const NurbsSurface& surface) {
  const int n = static_cast<int>(surface.count_u()), m = static_cast<int>(surface.count_v());
  const bool rational = is_rational(surface.weights);
  TColgp_Array2OfPnt poles(1, n, 1, m);
  TColStd_Array2OfReal weights(1, n, 1, m);
  std::size_t k = 0;
  for (int j = 1; j <= m; ++j) {
    for (int i = 1; i <= n; ++i, ++k) {
      poles(i, j) = point_of(surface.points[k]);
      weights(i, j) = rational ? surface.weights[k] : 1.0;
    }
  }
  const KnotTable u = knot_table(surface.knots_u), v = knot_table(surface.knots_v);
  if (!rational) {
    return new Geom_BSplineSurface(poles, u.values, v.values, u.multiplicities, v.multiplicities,
                                   surface.degree_u, surface.degree_v);
  }
  return new Geom_BSplineSurface(poles, weights, u.values, v.values, u.multiplicities,
                                 v.multiplicities, surface.degree_u, surface.degree_v);
}

Result<NurbsSurface> surface_of(Handle(Geom_BSplineSurface) spline) {
  clamp(spline);
  NurbsSurface out;
  out.degree_u = spline->UDegree();
  out.degree_v = spline->VDegree();
  out.knots_u = all_knots(spline->UKnots(), spline->UMultiplicities());
  out.knots_v = all_knots(spline->VKnots(), spline->VMultiplicities());
  const bool rational = spline->IsURational() || spline->IsVRational();
  for (int j = 1; j <= spline->NbVPoles(); ++j) {
    for (int i = 1; i <= spline->NbUPoles(); ++i) {
      const gp_Pnt& p = spline->Pole(i, j);
      out.points.push_back({p.X(), p.Y(), p.Z()});
      if (rational) out.weights.push_back(spline->Weight(i, j));
    }
  }
  OBVID_TRY(check(out));
  return out;
}

Result<SpaceCurve> curve_of(Handle(Geom_BSplineCurve) spline) {
  if (spline->IsPeriodic()) spline->SetNotPeriodic();
  if (spline->Multiplicity(1) <= spline->Degree() ||
      spline->Multiplicity(spline->NbKnots()) <= spline->Degree()) {
    spline->Segment(spline->FirstParameter(), spline->LastParameter());
  }
  SpaceCurve out;
  out.degree = spline->Degree();
  out.knots = all_knots(spline->Knots(), spline->Multiplicities());
  for (int i = 1; i <= spline->NbPoles(); ++i) {
    const gp_Pnt& p = spline->Pole(i);
    out.points.push_back({p.X(), p.Y(), p.Z()});
    if (spline->IsRational()) out.weights.push_back(spline->Weight(i));
  }
  OBVID_TRY(check(out));
  return out;
}

}  // namespace obvid::cad
