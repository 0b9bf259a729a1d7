// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <optional>

#include "obvid/contour/conics.h"
#include "splines.h"

namespace obvid::cad {
namespace {

gp_Pnt at(Vec2 p, double scale) { return {scale * p.x, scale * p.y, 0.0}; }

Error refused(const char* what) {
  return {ErrorCode::kInternal,
          std::string("the CAD kernel refuses ") + what,
          "",
          "look at the contour with `obvid verify`",
          -1,
          0.0};
}

Handle(Geom_BSplineCurve) spline_of(const NurbsCurve& curve, double scale) {
  const int n = static_cast<int>(curve.points.size());
  TColgp_Array1OfPnt poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    poles(i + 1) = at(curve.points[k], scale);
    weights(i + 1) = curve.weights[k];
  }
  const KnotTable knots = knot_table(curve.knots);
  const bool rational = std::any_of(curve.weights.begin(), curve.weights.end(),
                                    [&](double w) { return w != curve.weights.front(); });
  if (!rational) {
    return new Geom_BSplineCurve(poles, knots.values, knots.multiplicities, curve.degree);
  }
  return new Geom_BSplineCurve(poles, weights, knots.values, knots.multiplicities, curve.degree);
}

NurbsCurve nurbs_of(const RationalBezier& piece) {
  NurbsCurve out;
  out.degree = piece.degree;
  const auto n = static_cast<std::size_t>(piece.degree) + 1;
  for (std::size_t j = 0; j < n; ++j) {
    out.points.push_back(piece.origin + piece.offset[j]);
    out.weights.push_back(piece.weight[j]);
  }
  out.knots.assign(n, 0.0);
  out.knots.insert(out.knots.end(), n, 1.0);
  return out;
}

TopoDS_Edge edge_of(const ArcPiece& arc, double scale) {
  const Vec2 centre = arc.start + left_normal(unit_at(arc.theta0)) / arc.kappa;
  const double sign = arc.kappa > 0.0 ? 1.0 : -1.0;
  const Vec2 from = arc.start - centre;
  const gp_Ax2 axes(at(centre, scale), gp_Dir(0.0, 0.0, sign), gp_Dir(from.x, from.y, 0.0));
  const Handle(Geom_Circle) circle = new Geom_Circle(axes, scale / std::abs(arc.kappa));
  return BRepBuilderAPI_MakeEdge(circle, 0.0, std::abs(arc.kappa * arc.length));
}

/// Part of an ellipse; nothing for other pieces, and where centre and axes say less than the
/// control points do (nearly parabolas).
std::optional<TopoDS_Edge> ellipse_edge(const RationalBezier& piece, double scale) {
  constexpr double kExact = 1e-12;  // of the larger axis: what rounding leaves of a good ellipse
  const auto ellipse = ellipse_of(piece);
  if (!ellipse) return std::nullopt;
  const Vec2 u = unit_at(ellipse->rotation), v = left_normal(u);
  const auto point = [&](double e) {
    return ellipse->centre + ellipse->semi_major * std::cos(e) * u +
           ellipse->semi_minor * std::sin(e) * v;
  };
  const double away = std::max(norm(point(ellipse->from) - start_point(piece)),
                               norm(point(ellipse->to) - end_point(piece)));
  if (!(away <= kExact * ellipse->semi_major)) return std::nullopt;
  const double sign = ellipse->from < ellipse->to ? 1.0 : -1.0;
  const gp_Ax2 axes(at(ellipse->centre, scale), gp_Dir(0.0, 0.0, sign), gp_Dir(u.x, u.y, 0.0));
  const Handle(Geom_Ellipse) curve =
      new Geom_Ellipse(axes, scale * ellipse->semi_major, scale * ellipse->semi_minor);
  return TopoDS_Edge(BRepBuilderAPI_MakeEdge(curve, sign * ellipse->from, sign * ellipse->to));
}

Result<TopoDS_Edge> edge_of(const Piece& piece, double scale) {
  if (const auto* line = std::get_if<LinePiece>(&piece)) {
    return TopoDS_Edge(BRepBuilderAPI_MakeEdge(at(line->start, scale), at(line->end, scale)));
  }
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return edge_of(*arc, scale);
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    if (const auto ellipse = ellipse_edge(*bezier, scale)) return *ellipse;
    return TopoDS_Edge(BRepBuilderAPI_MakeEdge(spline_of(nurbs_of(*bezier), scale)));
  }
  return fail({ErrorCode::kUnsupported, "CAD files know no clothoids", "",
               "form the contour with --carrier spiral or bspline", -1, 0.0});
}

Result<TopoDS_Wire> wire_of(const CadCurve& curve, double scale) {
  BRepBuilderAPI_MakeWire wire;
  if (const auto* nurbs = std::get_if<NurbsCurve>(&curve.geometry)) {
    wire.Add(BRepBuilderAPI_MakeEdge(spline_of(*nurbs, scale)));
  } else {
    for (const Piece& piece : std::get<std::vector<Piece>>(curve.geometry)) {
      const auto edge = edge_of(piece, scale);
      if (!edge) return fail(edge.error());
      wire.Add(*edge);
    }
  }
  if (!wire.IsDone()) return fail(refused("the curve: its pieces do not meet"));
  return wire.Wire();
}

}  // namespace

Result<TopoDS_Shape> shape_of(const std::vector<CadCurve>& curves, double scale,
                              double face_width) {
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  TopoDS_Shape only;
  int shapes = 0;
  const auto add = [&](const TopoDS_Shape& shape) {
    builder.Add(all, shape);
    only = shape;
    ++shapes;
  };
  for (const CadCurve& curve : curves) {
    const auto wire = wire_of(curve, scale);
    if (!wire) return fail(wire.error());
    add(*wire);
    if (face_width > 0.0) {
      add(BRepPrimAPI_MakePrism(*wire, gp_Vec(0.0, 0.0, scale * face_width)).Shape());
    }
  }
  if (shapes == 0) return fail(refused("an empty list of curves"));
  return shapes == 1 ? only : TopoDS_Shape(all);
}

}  // namespace obvid::cad
