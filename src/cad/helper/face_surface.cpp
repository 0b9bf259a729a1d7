// SPDX-License-Identifier: Apache-2.0
#include "face_surface.h"

#include <fmt/format.h>

#include <BRepBndLib.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "face_trims.h"
#include "obvid/surface/surface.h"
#include "splines.h"

namespace obvid::cad {
namespace {

/// Parameters that differ by less than this part of the box are one: other systems' boundaries are
/// only as good as their tolerance.
constexpr double kSameParameter = 1e-6;

/// Of the size of a face: how well offsets are approximated.
constexpr double kApproximation = 1e-6;

struct Box {
  Range u, v;
};

Box box_of(const TopoDS_Face& face) {
  Box out;
  BRepTools::UVBounds(face, out.u.from, out.u.to, out.v.from, out.v.to);
  return out;
}

bool is_endless(const Range& range) {
  return Precision::IsInfinite(range.from) || Precision::IsInfinite(range.to) ||
         !(range.from < range.to);
}

/// Whether the boundary of the face is that of its box: all edges lie on the box's sides.
bool fills(const TopoDS_Face& face, const Box& box) {
  constexpr int kSamples = 8;
  const double du = kSameParameter * box.u.length(), dv = kSameParameter * box.v.length();
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double first = 0.0, last = 0.0;
    const Handle(Geom2d_Curve) line =
        BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, first, last);
    if (line.IsNull()) return false;
    bool left = true, right = true, bottom = true, top = true;
    for (int k = 0; k <= kSamples; ++k) {
      const gp_Pnt2d p = line->Value(first + (last - first) * k / kSamples);
      left = left && std::abs(p.X() - box.u.from) <= du;
      right = right && std::abs(p.X() - box.u.to) <= du;
      bottom = bottom && std::abs(p.Y() - box.v.from) <= dv;
      top = top && std::abs(p.Y() - box.v.to) <= dv;
    }
    if (!left && !right && !bottom && !top) return false;
  }
  return true;
}

/// Onto the surface's own bounds where they are as good as reached.
Range snapped(Range box, const Range& own, bool periodic) {
  if (Precision::IsInfinite(own.from) || Precision::IsInfinite(own.to)) return box;
  const double near = kSameParameter * own.length();
  if (periodic) {  // a whole turn exactly, wherever it starts
    if (std::abs(box.length() - own.length()) <= near) box.to = box.from + own.length();
    if (std::abs(box.from - own.from) <= near && std::abs(box.to - own.to) <= near) return own;
    return box;
  }
  if (box.from < own.from + near) box.from = own.from;
  if (box.to > own.to - near) box.to = own.to;
  return box;
}

double size_of_face(const TopoDS_Face& face) {
  Bnd_Box box;
  BRepBndLib::Add(face, box);
  return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

Handle(Geom_BSplineSurface)
    approximated(const Handle(Geom_Surface) & part, double size, double& deviation) {
  constexpr int kMostDegree = kMaxNurbsDegree, kMostSegments = 1000;
  const GeomConvert_ApproxSurface made(part, kApproximation * size, GeomAbs_C2, GeomAbs_C2,
                                       kMostDegree, kMostDegree, kMostSegments, 1);
  if (!made.IsDone() || !(made.MaxError() <= kApproximation * size)) return {};
  deviation = std::max(made.MaxError(), Precision::Confusion());
  return made.Surface();
}

Handle(Geom_Surface) without_trim(Handle(Geom_Surface) surface) {
  for (;;) {
    const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface);
    if (trimmed.IsNull()) return surface;
    surface = trimmed->BasisSurface();
  }
}

Handle(Geom_BSplineSurface) spline_over(const Handle(Geom_Surface) & surface, const Box& box,
                                        double size, double& deviation) {
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  Range u, v;
  surface->Bounds(u.from, u.to, v.from, v.to);
  const bool whole =
      box.u.from == u.from && box.u.to == u.to && box.v.from == v.from && box.v.to == v.to;
  if (!spline.IsNull() && whole) return Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
  const Handle(Geom_Surface) part =
      new Geom_RectangularTrimmedSurface(surface, box.u.from, box.u.to, box.v.from, box.v.to);
  if (!Handle(Geom_OffsetSurface)::DownCast(surface).IsNull()) {
    return approximated(part, size, deviation);
  }
  return GeomConvert::SurfaceToBSplineSurface(part);
}

/// The kernel would approximate it; its meridian and arcs are splines already.
Result<NurbsSurface> revolution_over(const Handle(Geom_SurfaceOfRevolution) & surface,
                                     const Box& box) {
  const Handle(Geom_Curve) meridian =
      new Geom_TrimmedCurve(surface->BasisCurve(), box.v.from, box.v.to);
  auto profile = curve_of(GeomConvert::CurveToBSplineCurve(meridian, Convert_TgtThetaOver2));
  OBVID_TRY(profile);
  const gp_Ax1 axis = surface->Axis();
  gp_Trsf start;
  start.SetRotation(axis, box.u.from);
  for (Vec3& p : profile->points) {
    const gp_Pnt turned = gp_Pnt(p.x, p.y, p.z).Transformed(start);
    p = {turned.X(), turned.Y(), turned.Z()};
  }
  const gp_Pnt on = axis.Location();
  const gp_Dir along = axis.Direction();
  const auto made = to_nurbs(RevolutionSurface{*std::move(profile),
                                               {on.X(), on.Y(), on.Z()},
                                               {along.X(), along.Y(), along.Z()},
                                               std::min(box.u.length(), 2.0 * std::numbers::pi)},
                             kApproximation);  // not needed: exact
  OBVID_TRY(made);
  return transposed(made->surface);  // the kernel turns along u
}

Result<NurbsSurface> nurbs_over(const Handle(Geom_Surface) & surface, const Box& box, double size,
                                double& deviation) {
  const auto revolution = Handle(Geom_SurfaceOfRevolution)::DownCast(surface);
  if (!revolution.IsNull()) return revolution_over(revolution, box);
  const auto spline = spline_over(surface, box, size, deviation);
  if (!spline.IsNull()) return surface_of(spline);
  return error(ErrorCode::kToleranceNotReached, "it cannot be approximated well enough")
      .value(kApproximation * size);
}

}  // namespace

FaceSurface surface_of(const TopoDS_Face& face) {
  FaceSurface out;
  const Handle(Geom_Surface) surface = without_trim(BRep_Tool::Surface(face));
  if (surface.IsNull()) {
    out.refused = "has no surface";
    return out;
  }
  Box box = box_of(face);
  if (is_endless(box.u) || is_endless(box.v)) {
    out.refused = "has no limits";
    return out;
  }
  Range u, v;
  surface->Bounds(u.from, u.to, v.from, v.to);
  box = {snapped(box.u, u, surface->IsUPeriodic()), snapped(box.v, v, surface->IsVPeriodic())};
  out.trimmed = !fills(face, box);
  if (out.trimmed && !Handle(Geom_Plane)::DownCast(surface).IsNull()) {
    make_room_for_trims(face, box.u, box.v);
  }
  auto made = nurbs_over(surface, box, size_of_face(face), out.deviation);
  if (!made) {
    out.refused = "is no surface of this program: " + made.error().what;
    return out;
  }
  const bool turned = face.Orientation() == TopAbs_REVERSED;
  if (out.trimmed) {
    if (const auto trims = trims_of(face, surface, box.u, box.v, *made)) {
      out.trims = turned ? with_u_reversed(trims->loops, domain_u(*made)) : trims->loops;
      // edges are known within their tolerance, and cubics follow them
      out.trims_within = BRep_Tool::MaxTolerance(face, TopAbs_EDGE) + trims->within;
    }
  }
  out.surface = turned ? reversed_u(*made) : *std::move(made);
  return out;
}

}  // namespace obvid::cad
