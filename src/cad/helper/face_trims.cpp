// SPDX-License-Identifier: Apache-2.0
#include "face_trims.h"

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace obvid::cad {
namespace {

constexpr double kTrimSamePoint = 1e-9;      // of the size
constexpr double kTrimApproximation = 1e-9;  // of the size
constexpr double kSnapped = 1e-6;            // of the domain
constexpr double kBridged = 1e-3;            // of the domain: gaps that a line closes

/// Where a surface ends in a point, parameters along its border say nothing: they are taken from
/// this far inside, of the range across it.
constexpr double kBesidePoint = 1e-4;
/// Of the size: how far a whole range of a parameter leads there.
constexpr double kNoWay = 1e-6;

Vec3 vec(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

Handle(Geom2d_BSplineCurve)
    spline_of_trim(const Handle(Geom2d_Curve) & line, double first, double last) {
  return Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(line, first, last));
}

class TrimReader {
 public:
  TrimReader(const Handle(Geom_Surface) & surface, const Range& u, const Range& v,
             const NurbsSurface& patch)
      : kernel_(surface),
        u_(u),
        v_(v),
        patch_(patch),
        own_u_(domain_u(patch)),
        own_v_(domain_v(patch)),
        size_(size_of(patch)),
        same_(has_same_parameters()) {}

  std::optional<FaceTrims> loops_of(const TopoDS_Face& given) {
    const TopoDS_Face face = TopoDS::Face(given.Oriented(TopAbs_FORWARD));
    std::vector<TrimLoop> out;
    within_ = 0.0;
    for (TopExp_Explorer w(face, TopAbs_WIRE); w.More(); w.Next()) {
      TrimLoop loop;
      for (BRepTools_WireExplorer e(TopoDS::Wire(w.Current()), face); e.More(); e.Next()) {
        auto curves = curves_of_edge(e.Current(), face);
        if (curves.empty()) return std::nullopt;
        // the explorer's own orientation is that of a vertex: wrong for edges with one vertex
        if (e.Current().Orientation() == TopAbs_REVERSED) {
          std::reverse(curves.begin(), curves.end());
          for (NurbsCurve& curve : curves) curve = reversed(curve);
        }
        std::move(curves.begin(), curves.end(), std::back_inserter(loop.curves));
      }
      if (loop.curves.empty()) continue;
      if (!closed(loop)) return std::nullopt;
      out.push_back(std::move(loop));
    }
    if (out.empty() || !check(SurfacePatch{"", patch_, out})) return std::nullopt;
    return FaceTrims{std::move(out), within_};
  }

 private:
  [[nodiscard]] Vec3 on_kernel(double u, double v) const { return vec(kernel_->Value(u, v).XYZ()); }

  [[nodiscard]] bool has_same_parameters() const {
    constexpr int kPlaces = 8;
    for (int i = 0; i <= kPlaces; ++i) {
      for (int j = 0; j <= kPlaces; ++j) {
        const double u = u_.at(static_cast<double>(i) / kPlaces);
        const double v = v_.at(static_cast<double>(j) / kPlaces);
        if (!(norm(evaluate(patch_, u, v).point - on_kernel(u, v)) <= kTrimSamePoint * size_)) {
          return false;
        }
      }
    }
    return true;
  }

  /// Its curves one after the other: several where it has corners; none where that cannot be.
  std::vector<NurbsCurve> curves_of_edge(const TopoDS_Edge& edge, const TopoDS_Face& face) {
    double first = 0.0, last = 0.0;
    const Handle(Geom2d_Curve) line = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (line.IsNull() || !(first < last)) return {};
    if (same_) {
      if (auto own = copied(spline_of_trim(line, first, last))) return {*std::move(own)};
    }
    Geom2dAdaptor_Curve smooth(line, first, last);
    TColStd_Array1OfReal ends(1, smooth.NbIntervals(GeomAbs_C1) + 1);
    smooth.Intervals(ends, GeomAbs_C1);
    std::vector<NurbsCurve> out;
    for (int k = ends.Lower(); k < ends.Upper(); ++k) {
      const Range part{ends(k), ends(k + 1)};
      if (!(part.length() > 0.0)) continue;
      // a curve of its own, whose derivatives at its ends are those from inside
      const Handle(Geom2d_Curve) own =
          ends.Length() == 2 ? line
                             : Handle(Geom2d_Curve)(spline_of_trim(line, part.from, part.to));
      auto curve = own.IsNull() ? std::nullopt : fitted(own, part);
      if (!curve) return {};
      out.push_back(*std::move(curve));
    }
    return out;
  }

  /// Nothing of a degree that the program has not, and where control points leave the patch.
  [[nodiscard]] std::optional<NurbsCurve> copied(const Handle(Geom2d_BSplineCurve) & spline) const {
    if (spline.IsNull()) return std::nullopt;
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    NurbsCurve out;
    out.degree = spline->Degree();
    for (int i = 1; i <= spline->NbKnots(); ++i) {
      out.knots.insert(out.knots.end(), static_cast<std::size_t>(spline->Multiplicity(i)),
                       spline->Knot(i));
    }
    for (int i = 1; i <= spline->NbPoles(); ++i) {
      out.points.push_back({spline->Pole(i).X(), spline->Pole(i).Y()});
      if (spline->IsRational()) out.weights.push_back(spline->Weight(i));
    }
    if (!check(out)) return std::nullopt;
    for (const Vec2& p : out.points) {
      if (!as_good_as_inside(p)) return std::nullopt;
    }
    return out;
  }

  /// A place of an edge in the parameters of the patch.
  struct Place {
    Vec2 at, d1;
    double off = 0.0;
  };
  std::optional<Place> place(const Handle(Geom2d_Curve) & line, double t) const {
    gp_Pnt2d p;
    gp_Vec2d d;
    line->D1(t, p, d);
    gp_Pnt q;
    gp_Vec by_u, by_v;
    kernel_->D1(p.X(), p.Y(), q, by_u, by_v);
    const bool no_u = by_u.Magnitude() * u_.length() <= kNoWay * size_;
    const bool no_v = by_v.Magnitude() * v_.length() <= kNoWay * size_;
    auto out = foot(p, d);
    if (!out || no_u == no_v) return out;
    // in a pole, or as good as there: along it from beside it, across it from here
    gp_Pnt2d beside = p;
    const auto move_in = [](double at, const Range& range) {
      const double step = kBesidePoint * range.length();
      return at < range.at(0.5) ? at + step : at - step;
    };
    if (no_u) beside.SetY(move_in(p.Y(), v_));
    if (no_v) beside.SetX(move_in(p.X(), u_));
    const auto near = foot(beside, d);
    if (!near) return std::nullopt;
    if (no_u) out->at.x = near->at.x;
    if (no_v) out->at.y = near->at.y;
    out->d1 = near->d1;
    out->off = norm(evaluate(patch_, out->at.x, out->at.y).point - vec(q.XYZ()));
    return out;
  }

  /// The place of the patch that is a point of the kernel's surface, and where `d` leads there.
  [[nodiscard]] std::optional<Place> foot(const gp_Pnt2d& p, const gp_Vec2d& d) const {
    gp_Pnt q;
    gp_Vec by_u, by_v;
    kernel_->D1(p.X(), p.Y(), q, by_u, by_v);
    const Vec3 point = vec(q.XYZ());
    const Vec3 along = d.X() * vec(by_u.XYZ()) + d.Y() * vec(by_v.XYZ());
    Place out;
    out.at = {own_u_.at((p.X() - u_.from) / u_.length()),
              own_v_.at((p.Y() - v_.from) / v_.length())};
    constexpr int kMostSteps = 30;
    constexpr double kOnPatch = 1e-15;  // of the size: nearer than coordinates tell
    for (int k = 0; k <= kMostSteps; ++k) {
      const SurfaceJet jet = evaluate(patch_, out.at.x, out.at.y);
      const Vec3 off = point - jet.point;
      const double e = dot(jet.du, jet.du), f = dot(jet.du, jet.dv), g = dot(jet.dv, jet.dv);
      const double det = e * g - f * f;
      const auto solved = [&](Vec3 right) {
        const double a = dot(right, jet.du), b = dot(right, jet.dv);
        return det > 0.0 ? Vec2{(g * a - f * b) / det, (e * b - f * a) / det} : Vec2{};
      };
      out.off = norm(off);
      if (k == kMostSteps || out.off <= kOnPatch * size_ || !(det > 0.0)) {
        out.d1 = solved(along);
        return out;
      }
      const Vec2 step = solved(off);
      const Vec2 next{std::clamp(out.at.x + step.x, own_u_.from, own_u_.to),
                      std::clamp(out.at.y + step.y, own_v_.from, own_v_.to)};
      if (next == out.at) {
        out.d1 = solved(along);
        return out;
      }
      out.at = next;
    }
    return std::nullopt;
  }

  std::optional<NurbsCurve> fitted(const Handle(Geom2d_Curve) & line, const Range& t) {
    NurbsCurve out;
    out.degree = 3;
    out.knots.assign(4, t.from);
    constexpr int kParts = 4;
    for (int k = 0; k < kParts; ++k) {
      const Range part{t.at(static_cast<double>(k) / kParts),
                       t.at(static_cast<double>(k + 1) / kParts)};
      const auto a = place(line, part.from), b = place(line, part.to);
      if (!a || !b) return std::nullopt;
      if (k == 0) out.points.push_back(a->at);
      if (!add(line, part, *a, *b, 0, out)) return std::nullopt;
    }
    out.knots.push_back(t.to);
    return out;
  }
  bool add(const Handle(Geom2d_Curve) & line, const Range& t, const Place& a, const Place& b,
           int halvings, NurbsCurve& out) {
    constexpr int kMostHalvings = 14, kPlaces = 7;
    const double third = t.length() / 3.0;
    const Vec2 p = clamped(a.at + third * a.d1), q = clamped(b.at - third * b.d1);
    double off = std::max(a.off, b.off);
    for (int k = 1; k <= kPlaces; ++k) {
      const double s = static_cast<double>(k) / (kPlaces + 1), r = 1.0 - s;
      const Vec2 at =
          r * r * r * a.at + 3.0 * r * r * s * p + 3.0 * r * s * s * q + s * s * s * b.at;
      const gp_Pnt2d on = line->Value(t.at(s));
      off = std::max(off, norm(evaluate(patch_, at.x, at.y).point - on_kernel(on.X(), on.Y())));
    }
    if (off <= kTrimApproximation * size_) {
      within_ = std::max(within_, off);
      out.points.insert(out.points.end(), {p, q, b.at});
      out.knots.insert(out.knots.end(), 3, t.to);
      return true;
    }
    if (halvings >= kMostHalvings) return false;
    const double middle = t.at(0.5);
    const auto m = place(line, middle);
    return m && add(line, {t.from, middle}, a, *m, halvings + 1, out) &&
           add(line, {middle, t.to}, *m, b, halvings + 1, out);
  }

  [[nodiscard]] Vec2 clamped(Vec2 p) const {
    return {std::clamp(p.x, own_u_.from, own_u_.to), std::clamp(p.y, own_v_.from, own_v_.to)};
  }

  /// Whether a place leaves the patch by no more than other systems mind.
  [[nodiscard]] bool as_good_as_inside(Vec2 p) const {
    const Vec2 inside = clamped(p);
    return std::abs(inside.x - p.x) <= kSnapped * own_u_.length() &&
           std::abs(inside.y - p.y) <= kSnapped * own_v_.length();
  }

  /// Control points onto the border that they leave by less than other systems mind; ends onto each
  /// other, across wider gaps by lines.
  bool closed(TrimLoop& loop) const {
    const double du = own_u_.length(), dv = own_v_.length();
    for (NurbsCurve& curve : loop.curves) {
      for (Vec2& p : curve.points) {
        if (!as_good_as_inside(p)) return false;
        p = clamped(p);
      }
    }
    std::vector<NurbsCurve> out;
    const std::size_t count = loop.curves.size();
    for (std::size_t i = 0; i < count; ++i) {
      NurbsCurve& curve = loop.curves[i];
      const Vec2 next = loop.curves[(i + 1) % count].points.front();
      const Vec2 end = curve.points.back();
      const double gap = std::max(std::abs(next.x - end.x) / du, std::abs(next.y - end.y) / dv);
      if (!(gap <= kBridged)) return false;
      if (gap <= kSnapped) curve.points.back() = next;
      out.push_back(curve);
      if (gap > kSnapped) out.push_back({1, {0.0, 0.0, 1.0, 1.0}, {end, next}, {}});
    }
    loop.curves = std::move(out);
    return true;
  }

  Handle(Geom_Surface) kernel_;
  Range u_, v_;
  const NurbsSurface& patch_;
  Range own_u_, own_v_;
  double size_;
  bool same_;
  double within_ = 0.0;
};

}  // namespace

std::optional<FaceTrims> trims_of(const TopoDS_Face& face, const Handle(Geom_Surface) & surface,
                                  const Range& u, const Range& v, const NurbsSurface& patch) {
  return TrimReader(surface, u, v, patch).loops_of(face);
}

void make_room_for_trims(const TopoDS_Face& face, Range& u, Range& v) {
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double first = 0.0, last = 0.0;
    const Handle(Geom2d_Curve) line =
        BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, first, last);
    if (line.IsNull() || !(first < last)) continue;
    const Handle(Geom2d_BSplineCurve) spline = spline_of_trim(line, first, last);
    if (spline.IsNull()) continue;
    for (int i = 1; i <= spline->NbPoles(); ++i) {
      const gp_Pnt2d p = spline->Pole(i);
      u = {std::min(u.from, p.X()), std::max(u.to, p.X())};
      v = {std::min(v.from, p.Y()), std::max(v.to, p.Y())};
    }
  }
}

std::vector<TrimLoop> with_u_reversed(const std::vector<TrimLoop>& loops, const Range& u) {
  std::vector<TrimLoop> out;
  for (const TrimLoop& loop : loops) {
    TrimLoop turned;
    for (auto at = loop.curves.rbegin(); at != loop.curves.rend(); ++at) {
      NurbsCurve curve = reversed(*at);
      for (Vec2& p : curve.points) p.x = u.from + (u.to - p.x);
      turned.curves.push_back(std::move(curve));
    }
    out.push_back(std::move(turned));
  }
  return out;
}

}  // namespace obvid::cad
