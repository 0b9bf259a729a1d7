// SPDX-License-Identifier: Apache-2.0
#include "wires.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/contour/conics.h"
#include "splines.h"

namespace obvid::cad {
namespace {

gp_Pnt at(Vec2 p, double scale) { return {scale * p.x, scale * p.y, 0.0}; }

Error refused(const char* what) {
  return error(ErrorCode::kInternal, std::string("the CAD kernel refuses ") + what)
      .hint("look at the contour with `obvid verify`");
}

Handle(Geom_BSplineCurve) flat_spline(const NurbsCurve& curve, double scale) {
  SpaceCurve flat{curve.degree, curve.knots, {}, curve.weights};
  for (const Vec2 p : curve.points) flat.points.push_back({scale * p.x, scale * p.y, 0.0});
  return spline_of(flat);
}

/// A curve and the parameters at which an edge begins and ends.
struct Drawn {
  Handle(Geom_Curve) curve;
  double from = 0.0, to = 1.0;
};

/// Below this angle the kernel takes both ends of an arc for one place, and draws the whole turn
/// (Precision::PConfusion, 1e-9); some more, so that angles keep digits.
constexpr double kLeastAngle = 1e-7;
/// What centre and radius may miss of the ends, of the length of the arc: a hundredth of what files
/// promise (1e-9 of the size, docs/formats.md).
constexpr double kCircleMiss = 1e-11;

Drawn spline_piece(const NurbsCurve& curve, double scale) {
  return {flat_spline(curve, scale), curve.knots.front(), curve.knots.back()};
}

/// The arc as a circle; nothing where the centre lies so far away that the ends lose digits.
std::optional<Drawn> circle_of(const ArcPiece& arc, double scale) {
  const double turn = std::abs(arc.kappa * arc.length), radius = 1.0 / std::abs(arc.kappa);
  const Vec2 centre = arc.start + left_normal(unit_at(arc.theta0)) / arc.kappa;
  const double sign = arc.kappa > 0.0 ? 1.0 : -1.0;
  const Vec2 from = arc.start - centre, x = from / norm(from), y = sign * left_normal(x);
  const Vec2 end = centre + (radius * std::cos(turn)) * x + (radius * std::sin(turn)) * y;
  const double miss = std::max(std::abs(norm(from) - radius), norm(end - arc.end));
  if (turn < kLeastAngle || !(miss <= kCircleMiss * arc.length)) return std::nullopt;
  const gp_Ax2 axes(at(centre, scale), gp_Dir(0.0, 0.0, sign), gp_Dir(from.x, from.y, 0.0));
  return Drawn{new Geom_Circle(axes, scale * radius), 0.0, turn};
}

/// Part of an ellipse; nothing for other pieces, and where centre and axes say less than the
/// control points do (nearly parabolas).
std::optional<Drawn> ellipse_piece(const RationalBezier& piece, double scale) {
  constexpr double kExact = 1e-12;  // of the larger axis: what rounding leaves of a good ellipse
  const auto ellipse = ellipse_of(piece);
  if (!ellipse || std::abs(ellipse->to - ellipse->from) < kLeastAngle) return std::nullopt;
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
  return Drawn{new Geom_Ellipse(axes, scale * ellipse->semi_major, scale * ellipse->semi_minor),
               sign * ellipse->from, sign * ellipse->to};
}

/// One piece as a NURBS curve: what needs no centre.
Result<Drawn> drawn_by_points(const Piece& piece, double scale) {
  Contour only;
  only.pieces.push_back(piece);
  only.joints.resize(2);
  const auto made = nurbs_of(only);
  OBVID_TRY(made);
  return spline_piece(made->curve, scale);
}

Result<Drawn> drawn(const Piece& piece, double scale) {
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
    if (const auto circle = circle_of(*arc, scale)) return *circle;
    return drawn_by_points(piece, scale);
  }
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    if (const auto ellipse = ellipse_piece(*bezier, scale)) return *ellipse;
    return spline_piece(nurbs_of(*bezier), scale);
  }
  return error(ErrorCode::kUnsupported, "CAD files know no clothoids")
      .hint("form the contour with --carrier spiral or bspline");
}

/// A wire of pieces that share their vertices: whether neighbours meet is known here, and is not
/// left to the kernel's precision, which is a length in mm whatever the size of the contour.
class PieceWire {
 public:
  PieceWire(const std::vector<Piece>& pieces, double scale) : pieces_(pieces), scale_(scale) {}

  Result<TopoDS_Wire> run() {
    OBVID_TRY(draw_all());
    place_vertices();
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const TopoDS_Vertex &from = vertices_[i], &to = vertices_[(i + 1) % vertices_.size()];
      BRepBuilderAPI_MakeEdge edge;
      if (drawn_[i]) {
        edge.Init(drawn_[i]->curve, from, to, drawn_[i]->from, drawn_[i]->to);
      } else {
        edge = BRepBuilderAPI_MakeEdge(from, to);
      }
      if (!edge.IsDone()) return fail(refused("a piece of the curve"));
      builder_.Add(wire, edge.Edge());
    }
    wire.Closed(is_closed());
    return wire;
  }

 private:
  /// Lines are left to their vertices.
  Result<void> draw_all() {
    for (const Piece& piece : pieces_) {
      if (std::holds_alternative<LinePiece>(piece)) {
        drawn_.emplace_back();
        continue;
      }
      auto one = drawn(piece, scale_);
      OBVID_TRY(one);
      drawn_.emplace_back(std::move(*one));
    }
    return {};
  }

  /// One place for the kernel, or for doubles.
  [[nodiscard]] bool is_closed() const {
    constexpr double kRoundings = 4.0;
    const gp_Pnt first = at(start_point(pieces_.front()), scale_);
    const gp_Pnt last = at(end_point(pieces_.back()), scale_);
    const double coordinate = std::max(std::abs(first.X()), std::abs(first.Y()));
    const double rounding = kRoundings * std::numeric_limits<double>::epsilon() * coordinate;
    return first.Distance(last) <= std::max(Precision::Confusion(), rounding);
  }

  /// As large as the ends of the two curves at the vertex need it.
  void place_vertices() {
    const std::size_t count = pieces_.size() + (is_closed() ? 0 : 1);
    std::vector<double> size(count, Precision::Confusion());
    std::vector<gp_Pnt> place;
    for (std::size_t k = 0; k < count; ++k) {
      place.push_back(
          at(k < pieces_.size() ? start_point(pieces_[k]) : end_point(pieces_.back()), scale_));
    }
    constexpr double kSome = 1.0 + 1e-6;  // the kernel compares squares
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!drawn_[i]) continue;
      const std::size_t next = (i + 1) % count;
      const auto miss = [&](std::size_t k, double t) {
        size[k] = std::max(size[k], kSome * place[k].Distance(drawn_[i]->curve->Value(t)));
      };
      miss(i, drawn_[i]->from);
      miss(next, drawn_[i]->to);
    }
    vertices_.resize(count);
    for (std::size_t k = 0; k < count; ++k) builder_.MakeVertex(vertices_[k], place[k], size[k]);
  }

  const std::vector<Piece>& pieces_;
  double scale_;
  BRep_Builder builder_;
  std::vector<std::optional<Drawn>> drawn_;
  std::vector<TopoDS_Vertex> vertices_;
};

Result<TopoDS_Wire> wire_of(const CadCurve& curve, double scale) {
  if (const auto* pieces = std::get_if<std::vector<Piece>>(&curve.geometry)) {
    if (pieces->empty()) return fail(refused("a curve without pieces"));
    return PieceWire(*pieces, scale).run();
  }
  const auto spline = [&]() -> Handle(Geom_BSplineCurve) {
    if (const auto* plane = std::get_if<NurbsCurve>(&curve.geometry)) {
      return flat_spline(*plane, scale);
    }
    SpaceCurve spatial = std::get<SpaceCurve>(curve.geometry);
    for (Vec3& point : spatial.points) point = scale * point;
    return cad::spline_of(spatial);
  }();
  BRepBuilderAPI_MakeEdge edge(spline);
  if (!edge.IsDone()) return fail(refused("the curve"));
  TopoDS_Wire wire;
  BRep_Builder builder;
  builder.MakeWire(wire);
  builder.Add(wire, edge.Edge());
  return wire;
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
    OBVID_TRY(wire);
    add(*wire);
    if (face_width > 0.0) {
      add(BRepPrimAPI_MakePrism(*wire, gp_Vec(0.0, 0.0, scale * face_width)).Shape());
    }
  }
  if (shapes == 0) return fail(refused("an empty list of curves"));
  return shapes == 1 ? only : TopoDS_Shape(all);
}

}  // namespace obvid::cad
