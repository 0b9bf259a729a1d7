// SPDX-License-Identifier: Apache-2.0
#include "trimmed_faces.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>

#include "obvid/geom/internal/polygon.h"
#include "splines.h"

namespace obvid::cad {
namespace {

Handle(Geom2d_BSplineCurve) plane_spline_of(const NurbsCurve& curve) {
  const int n = static_cast<int>(curve.points.size());
  TColgp_Array1OfPnt2d poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    poles(i + 1) = {curve.points[k].x, curve.points[k].y};
    weights(i + 1) = curve.weights.empty() ? 1.0 : curve.weights[k];
  }
  const KnotTable knots = knot_table(curve.knots);
  if (curve.weights.empty()) {
    return new Geom2d_BSplineCurve(poles, knots.values, knots.multiplicities, curve.degree);
  }
  return new Geom2d_BSplineCurve(poles, weights, knots.values, knots.multiplicities, curve.degree);
}

/// A loop as points, for what lies inside of what.
std::vector<Vec2> outline_of_loop(const TrimLoop& loop) {
  constexpr int kPlaces = 8;
  std::vector<Vec2> out;
  for (const NurbsCurve& curve : loop.curves) {
    for (std::size_t i = 1; i < curve.knots.size(); ++i) {
      if (!(curve.knots[i - 1] < curve.knots[i])) continue;
      for (int k = 0; k < kPlaces; ++k) {
        const Range span{curve.knots[i - 1], curve.knots[i]};
        out.push_back(evaluate(curve, span.at(static_cast<double>(k) / kPlaces)).point);
      }
    }
  }
  return out;
}

TrimLoop turned_round(const TrimLoop& loop) {
  TrimLoop out;
  for (auto at = loop.curves.rbegin(); at != loop.curves.rend(); ++at) {
    out.curves.push_back(reversed(*at));
  }
  return out;
}

class FaceMaker {
 public:
  FaceMaker(const SurfacePatch& patch, double tolerance, std::size_t edges)
      : patch_(patch), spline_(spline_of(patch.surface)), tolerance_(tolerance), edges_(edges) {}

  std::vector<TopoDS_Face> made() {
    std::vector<std::vector<Vec2>> outlines;
    for (const TrimLoop& loop : patch_.trims) outlines.push_back(outline_of_loop(loop));
    const std::size_t count = outlines.size();
    // how many others a loop lies in, and the smallest of them
    std::vector<std::size_t> depth(count, 0), around(count, count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < count; ++k) {
        if (i == k || !is_in_polygon(outlines[k], outlines[i].front())) continue;
        ++depth[i];
        const bool smaller =
            around[i] == count ||
            std::abs(area_of_polygon(outlines[k])) < std::abs(area_of_polygon(outlines[around[i]]));
        if (smaller) around[i] = k;
      }
    }
    std::vector<TopoDS_Face> out;
    for (std::size_t i = 0; i < count; ++i) {
      if (depth[i] % 2 == 1) continue;
      TopoDS_Face face;
      builder_.MakeFace(face, spline_, Precision::Confusion());
      builder_.Add(face, wire_of(patch_.trims[i], area_of_polygon(outlines[i]) > 0.0));
      for (std::size_t k = 0; k < count; ++k) {
        if (depth[k] != depth[i] + 1 || around[k] != i) continue;
        builder_.Add(face, wire_of(patch_.trims[k], area_of_polygon(outlines[k]) < 0.0));
      }
      out.push_back(face);
    }
    return out;
  }

 private:
  /// A loop of one curve into as many edges as it shall have.
  void divide(TrimLoop& loop) const {
    const Range all = domain(loop.curves.front());
    for (std::size_t k = 1; k < edges_; ++k) {
      const double t = all.at(static_cast<double>(k) / static_cast<double>(edges_));
      const auto parts = split(loop.curves.back(), t);
      loop.curves.back() = parts[0];
      loop.curves.push_back(parts[1]);
    }
  }

  TopoDS_Wire wire_of(const TrimLoop& given, bool runs_right) {
    TrimLoop loop = runs_right ? given : turned_round(given);
    if (loop.curves.size() == 1) divide(loop);
    const std::size_t count = loop.curves.size();
    std::vector<bool> point(count);
    for (std::size_t i = 0; i < count; ++i) point[i] = is_point(loop.curves[i]);
    // one vertex where curves meet; both ends of a side that is a point have the same
    std::vector<TopoDS_Vertex> begin(count);
    for (std::size_t i = 0; i < count; ++i) begin[i] = vertex_at(loop.curves[i].points.front());
    for (std::size_t i = 0; i < count; ++i) {
      if (point[i]) begin[(i + 1) % count] = begin[i];
    }
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (std::size_t i = 0; i < count; ++i) {
      builder_.Add(wire, edge_of(loop.curves[i], point[i], begin[i], begin[(i + 1) % count]));
    }
    wire.Closed(true);
    return wire;
  }

  [[nodiscard]] Vec3 place(Vec2 at) const { return evaluate(patch_.surface, at.x, at.y).point; }
  [[nodiscard]] bool is_point(const NurbsCurve& curve) const {
    const Vec3 begin = place(curve.points.front());
    const Range all = domain(curve);
    constexpr int kPlaces = 8;
    for (int k = 1; k <= kPlaces; ++k) {
      const Vec2 at = evaluate(curve, all.at(static_cast<double>(k) / kPlaces)).point;
      if (norm(place(at) - begin) > Precision::Confusion()) return false;
    }
    return true;
  }

  TopoDS_Vertex vertex_at(Vec2 at) {
    const Vec3 p = place(at);
    TopoDS_Vertex vertex;
    builder_.MakeVertex(vertex, gp_Pnt(p.x, p.y, p.z), Precision::Confusion());
    return vertex;
  }

  TopoDS_Edge edge_of(const NurbsCurve& curve, bool point, const TopoDS_Vertex& begin,
                      const TopoDS_Vertex& end) {
    TopoDS_Edge edge;
    builder_.MakeEdge(edge);
    builder_.UpdateEdge(edge, plane_spline_of(curve), spline_, TopLoc_Location(),
                        Precision::Confusion());
    const Range range = domain(curve);
    builder_.Range(edge, range.from, range.to);
    builder_.Add(edge, begin.Oriented(TopAbs_FORWARD));
    builder_.Add(edge, end.Oriented(TopAbs_REVERSED));
    if (point) {
      builder_.Degenerated(edge, true);
      return edge;
    }
    BRepLib::BuildCurve3d(edge, tolerance_);
    BRepLib::SameParameter(edge, tolerance_);
    return edge;
  }

  const SurfacePatch& patch_;
  Handle(Geom_BSplineSurface) spline_;
  double tolerance_;
  std::size_t edges_;
  BRep_Builder builder_;
};

}  // namespace

std::vector<TopoDS_Face> trimmed_faces(const SurfacePatch& patch, double tolerance,
                                       std::size_t edges) {
  return FaceMaker(patch, tolerance, edges).made();
}

TopoDS_Shape sewn(std::vector<TopoDS_Face>& faces, double tolerance) {
  if (faces.size() == 1) return faces.front();
  BRepBuilderAPI_Sewing sewing(tolerance);
  for (const TopoDS_Face& face : faces) sewing.Add(face);
  sewing.Perform();
  for (TopoDS_Face& face : faces) {
    if (!sewing.IsModified(face)) continue;
    const TopoDS_Shape now = sewing.Modified(face);
    if (now.ShapeType() == TopAbs_FACE) face = TopoDS::Face(now);
  }
  return sewing.SewedShape();
}

}  // namespace obvid::cad
