// SPDX-License-Identifier: Apache-2.0
#include "flatten.h"

#include <fmt/format.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <GProp_PEquation.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "obvid/curve/internal/drawn_spans.h"
#include "obvid/curve/nurbs.h"
#include "obvid/geom/internal/box.h"

namespace obvid::cad {
namespace {

/// Out of a plane by less than this part of the size: rounding of the file's digits.
constexpr double kFlat = 1e-6;

/// An edge in space, from its start to its end.
struct EdgeCurve {
  Handle(Geom_BSplineCurve) spline;  ///< always there
  bool line = false;
  std::optional<gp_Circ> circle;
  double turn = 0.0;  ///< of the circle, rad, positive about its axis
};

/// The part of a curve between two parameters. Open CASCADE takes knots nearer to the ends than
/// Precision::PConfusion for them and leaves out the span between: splines keep all of theirs, and
/// get knots about one apart where they are cut.
Handle(Geom_BSplineCurve) part_of(const Handle(Geom_Curve) & curve, double first, double last) {
  Handle(Geom_Curve) basis = curve;
  if (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve); !trimmed.IsNull()) {
    basis = trimmed->BasisCurve();
  }
  auto spline = Handle(Geom_BSplineCurve)::DownCast(basis);
  if (!spline.IsNull() && !spline->IsPeriodic()) {
    spline = Handle(Geom_BSplineCurve)::DownCast(spline->Copy());
    const double start = spline->FirstParameter();
    if (first <= start && last >= spline->LastParameter()) return spline;
    TColStd_Array1OfReal knots(1, spline->NbKnots());
    spline->Knots(knots);
    const double scale = (spline->NbKnots() - 1) / (spline->LastParameter() - start);
    for (double& knot : knots) knot = scale * (knot - start);
    spline->SetKnots(knots);
    basis = spline;
    first = scale * (first - start);
    last = scale * (last - start);
  }
  return GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(basis, first, last),
                                          Convert_TgtThetaOver2);  // conics stay quadratic
}

std::optional<EdgeCurve> curve_of(const TopoDS_Edge& edge, std::string& why) {
  const BRepAdaptor_Curve adaptor(edge);
  double first = 0.0, last = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull() || !(first < last)) {
    why = "has no curve in space";
    return std::nullopt;
  }
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last)) {
    why = "has no end";
    return std::nullopt;
  }
  EdgeCurve out;
  out.spline = part_of(curve, first, last);
  if (out.spline.IsNull()) {
    why = "is no spline";
    return std::nullopt;
  }
  if (out.spline->IsPeriodic()) out.spline->SetNotPeriodic();
  out.line = adaptor.GetType() == GeomAbs_Line;
  if (adaptor.GetType() == GeomAbs_Circle) {
    out.circle = adaptor.Circle();
    out.turn = last - first;
  }
  if (edge.Orientation() == TopAbs_REVERSED) {
    out.spline->Reverse();
    out.turn = -out.turn;
  }
  if (out.spline->Degree() > kMaxBezierDegree) {
    why = fmt::format("has degree {}, more than {}", out.spline->Degree(), kMaxBezierDegree);
    return std::nullopt;
  }
  return out;
}

/// Plane with its axes; points lie at x and y in it.
struct Plane {
  gp_Pnt origin;
  gp_Dir x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0};

  [[nodiscard]] Vec2 place(const gp_Pnt& p) const {
    const gp_Vec v(origin, p);
    return {v.Dot(gp_Vec(x)), v.Dot(gp_Vec(y))};
  }
  [[nodiscard]] gp_Dir normal() const { return x.Crossed(y); }
};

std::vector<gp_Pnt> poles_of(const std::vector<EdgeCurve>& curves) {
  std::vector<gp_Pnt> out;
  for (const EdgeCurve& curve : curves) {
    for (int i = 1; i <= curve.spline->NbPoles(); ++i) out.push_back(curve.spline->Pole(i));
  }
  return out;
}

bool all_finite(const std::vector<gp_Pnt>& points) {
  return std::all_of(points.begin(), points.end(), [](const gp_Pnt& p) {
    return std::isfinite(p.X()) && std::isfinite(p.Y()) && std::isfinite(p.Z());
  });
}

/// Seen from the side of the axis that its normal is nearest to, so that drawings are not mirrored.
Plane turned_up(const gp_Pnt& origin, gp_Dir normal) {
  const double c[] = {normal.X(), normal.Y(), normal.Z()};
  int main = 2;
  for (int i = 1; i >= 0; --i) {
    if (std::abs(c[i]) > std::abs(c[main])) main = i;
  }
  if (c[main] < 0.0) normal.Reverse();
  const gp_Dir candidates[] = {gp_Dir(0, 1, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)};
  Plane plane;
  plane.origin = origin;
  gp_Dir along = candidates[main];
  constexpr double kNearlyParallel = 1e-3;  // rad
  if (along.IsParallel(normal, kNearlyParallel)) along = candidates[(main + 1) % 3];
  plane.y = normal.Crossed(along).Crossed(normal);
  plane.x = plane.y.Crossed(normal);
  return plane;
}

/// The plane of the points; nothing when they have none, `away` says how far they are from it.
std::optional<Plane> plane_of(const std::vector<gp_Pnt>& points, double size, double& away) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const gp_Pnt& a, const gp_Pnt& b) { return a.Z() < b.Z(); });
  if (high->Z() - low->Z() <= kFlat * size) return Plane{gp_Pnt(0.0, 0.0, 0.0)};
  TColgp_Array1OfPnt array(1, static_cast<int>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) array(static_cast<int>(i) + 1) = points[i];
  const GProp_PEquation equation(array, kFlat * size);
  if (equation.IsPlanar()) {
    const gp_Pln plane = equation.Plane();
    return turned_up(points.front(), plane.Axis().Direction());
  }
  if (equation.IsLinear()) {
    const gp_Dir along = equation.Line().Direction();
    const gp_Dir other = std::abs(along.Z()) < 0.9 ? gp_Dir(0, 0, 1) : gp_Dir(1, 0, 0);
    return turned_up(points.front(), along.Crossed(other));
  }
  gp_Vec v1, v2, v3;
  gp_Pnt corner;
  if (equation.IsSpace()) {
    equation.Box(corner, v1, v2, v3);
    away = std::min({v1.Magnitude(), v2.Magnitude(), v3.Magnitude()});
  }
  return std::nullopt;
}

/// Arcs of less than half a turn each.
void add_arcs(const EdgeCurve& curve, const Plane& plane, std::vector<Piece>& pieces) {
  constexpr double kMostTurn = 3.0;
  const gp_Circ& circle = *curve.circle;
  const double sign = circle.Axis().Direction().Dot(plane.normal()) > 0.0 ? 1.0 : -1.0;
  const double turn = sign * curve.turn, radius = circle.Radius();
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kMostTurn)));
  const Vec2 centre = plane.place(circle.Location());
  Vec2 from = plane.place(curve.spline->StartPoint()) - centre;
  const double part = turn / count;
  for (int k = 0; k < count; ++k) {
    const Vec2 turned = {from.x * std::cos(part) - from.y * std::sin(part),
                         from.x * std::sin(part) + from.y * std::cos(part)};
    const double angle = std::atan2(from.y, from.x);
    const double theta = angle + std::copysign(0.5 * std::numbers::pi, part);
    pieces.emplace_back(ArcPiece{centre + from, centre + turned, theta,
                                 std::copysign(1.0 / radius, part), std::abs(part) * radius});
    from = turned;
  }
}

void add_pieces(const EdgeCurve& curve, const Plane& plane, std::vector<Piece>& pieces) {
  const Handle(Geom_BSplineCurve)& spline = curve.spline;
  if (curve.line) {
    pieces.emplace_back(
        LinePiece{plane.place(spline->StartPoint()), plane.place(spline->EndPoint())});
    return;
  }
  if (curve.circle) return add_arcs(curve, plane, pieces);
  NurbsCurve flat;
  flat.degree = spline->Degree();
  for (int i = 1; i <= spline->NbPoles(); ++i) {
    flat.points.push_back(plane.place(spline->Pole(i)));
    flat.weights.push_back(spline->Weight(i));
  }
  for (int i = 1; i <= spline->NbKnots(); ++i) {
    flat.knots.insert(flat.knots.end(), static_cast<std::size_t>(spline->Multiplicity(i)),
                      spline->Knot(i));
  }
  for (const Piece& piece : drawn_spans(flat)) pieces.push_back(piece);
}

std::string plane_text(const Plane& plane) {
  const gp_Dir n = plane.normal();
  return fmt::format("point ({:.6g}, {:.6g}, {:.6g}), normal ({:.6g}, {:.6g}, {:.6g})",
                     plane.origin.X(), plane.origin.Y(), plane.origin.Z(), n.X() + 0.0, n.Y() + 0.0,
                     n.Z() + 0.0);  // no -0
}

void leave_out(const EdgeChain& chain, const std::string& why, Drawing& drawing) {
  drawing.warnings.push_back(chain.label + " was left out: " + why);
  ++drawing.left_out;
}

/// What the whole is not, its edges may be.
void add_one_by_one(const EdgeChain& chain, Drawing& drawing) {
  for (std::size_t i = 0; i < chain.edges.size(); ++i) {
    add_flat({fmt::format("{}, edge {}", chain.label, i + 1), {chain.edges[i]}, false}, drawing);
  }
}

void add_chain(const EdgeChain& chain, Drawing& drawing) {
  std::vector<EdgeCurve> curves;
  for (const TopoDS_Edge& edge : chain.edges) {
    std::string why;
    auto curve = curve_of(edge, why);
    if (!curve && chain.edges.size() > 1) return add_one_by_one(chain, drawing);
    if (!curve) {
      return leave_out(chain, "it " + why, drawing);
    }
    curves.push_back(std::move(*curve));
  }
  const std::vector<gp_Pnt> points = poles_of(curves);
  if (points.empty()) return;
  if (!all_finite(points)) {
    return leave_out(chain, "it has numbers that are not finite", drawing);
  }
  const double size = farthest_from_first(
      points, [](const gp_Pnt& p, const gp_Pnt& first) { return p.Distance(first); });
  double away = 0.0;
  const auto plane = plane_of(points, size, away);
  if (!plane && chain.edges.size() > 1) return add_one_by_one(chain, drawing);
  if (!plane) {
    return leave_out(chain, fmt::format("it is not plane, by {:.3g} mm", away), drawing);
  }
  const bool own = plane->normal().Z() < 0.5 || plane->origin.Distance(gp_Pnt()) > 0.0;
  if (own)
    drawing.warnings.push_back(chain.label + " lies in its own plane: " + plane_text(*plane));
  DrawnCurve out{chain.label, {}, chain.closed};
  const double height = points.front().Z();
  if (!own && std::abs(height) > kFlat * size) out.label += fmt::format(" at z = {:.6g}", height);
  for (const EdgeCurve& curve : curves) add_pieces(curve, *plane, out.pieces);
  if (!out.pieces.empty()) drawing.curves.push_back(std::move(out));
}

}  // namespace

void add_flat(const EdgeChain& chain, Drawing& drawing) {
  try {
    add_chain(chain, drawing);
  } catch (const Standard_Failure& failure) {
    leave_out(chain, std::string("the CAD kernel says ") + failure.GetMessageString(), drawing);
  }
}

}  // namespace obvid::cad
