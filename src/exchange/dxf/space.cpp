// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/dxf/space.h"

#include <algorithm>

#include "dxf/file.h"
#include "dxf/units.h"
#include "obvid/geom/internal/box.h"

namespace obvid {
namespace {

using exchange::DxfWriter;

void begin_spatial(DxfWriter& out, const char* kind, const char* layer, const char* subclass) {
  out.pair(0, kind);
  out.pair(5, out.handle());
  out.pair(330, exchange::kModelSpace);
  out.pair(100, "AcDbEntity");
  out.pair(8, layer);
  out.pair(100, subclass);
}

void add_place(DxfWriter& out, Vec3 p) {
  out.pair(10, p.x);
  out.pair(20, p.y);
  out.pair(30, p.z);
}

void add_spline(DxfWriter& out, const SpaceCurve& curve) {
  constexpr int kClosed = 1, kRational = 4;
  const bool rational =
      std::any_of(curve.weights.begin(), curve.weights.end(), [](double w) { return w != 1.0; });
  const bool closed = curve.points.front() == curve.points.back();
  begin_spatial(out, "SPLINE", "CONTOUR", "AcDbSpline");
  out.pair(70, (rational ? kRational : 0) + (closed ? kClosed : 0));
  out.pair(71, curve.degree);
  out.pair(72, static_cast<int>(curve.knots.size()));
  out.pair(73, static_cast<int>(curve.points.size()));
  out.pair(74, 0);
  for (const double knot : curve.knots) out.pair(40, knot);
  for (const double weight : curve.weights) {
    if (rational) out.pair(41, weight);
  }
  for (const Vec3& p : curve.points) add_place(out, p);
}

}  // namespace

std::string space_dxf(const std::vector<SpaceCurve>& curves, const std::vector<Vec3>& points,
                      const Units& units) {
  Box2 box;
  DxfWriter out;
  for (const SpaceCurve& curve : curves) {
    for (const Vec3& p : curve.points) box.add({p.x, p.y});
    add_spline(out, curve);
  }
  for (const Vec3& p : points) {
    box.add({p.x, p.y});
    begin_spatial(out, "POINT", "POINTS", "AcDbPoint");
    add_place(out, p);
  }
  const int code = units.known() ? dxf::insunits_of(units.name) : 0;
  const std::string seed = out.next_handle();
  constexpr int kRed = 1;
  return exchange::r2000_head({{"CONTOUR"}, {"POINTS", kRed}}, code, seed, box.low, box.high) +
         out.take() + exchange::r2000_tail();
}

}  // namespace obvid
