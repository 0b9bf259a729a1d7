// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/dxf_write.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "dxf_file.h"
#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/contour/conics.h"
#include "obvid/curve/joined_nurbs.h"

namespace obvid {
namespace {

using exchange::DxfWriter;
using exchange::kModelSpace;

constexpr double kDegree = std::numbers::pi / 180.0;

/// $INSUNITS of a unit; 0: none.
int unit_code(const std::string& units) {
  static constexpr std::array<std::pair<const char*, int>, 7> kCodes = {
      {{"in", 1}, {"ft", 2}, {"mm", 4}, {"cm", 5}, {"m", 6}, {"km", 7}, {"um", 13}}};
  for (const auto& [name, code] : kCodes) {
    if (units == name) return code;
  }
  return 0;
}

std::string safe_name(std::string layer) {
  for (char& c : layer) {
    const bool good = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                      c == '-' || c == '_';
    if (!good) c = '_';
  }
  return layer.empty() ? "0" : layer;
}

bool is_circular(const Piece& piece) {
  return std::holds_alternative<LinePiece>(piece) || std::holds_alternative<ArcPiece>(piece);
}

/// Parts of a contour between its corners, each as a contour of its own.
std::vector<Contour> smooth_parts(const Contour& contour) {
  std::vector<Contour> parts;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const bool corner = i < contour.joints.size() && contour.joints[i].leaving.has_value();
    if (i == 0 || corner) {
      parts.emplace_back();
      parts.back().units = contour.units;
      Joint first = contour.joints[i];
      if (first.leaving) first.element = *first.leaving;
      first.leaving.reset();
      parts.back().joints.push_back(first);
    }
    Contour& part = parts.back();
    part.pieces.push_back(contour.pieces[i]);
    Joint end = contour.joints[(i + 1) % contour.joints.size()];
    end.leaving.reset();
    part.joints.push_back(end);
  }
  const bool seamless = contour.closed && parts.size() == 1 && !contour.joints.front().leaving;
  for (Contour& part : parts) {
    part.points = {start_point(part.pieces.front()), end_point(part.pieces.back())};
    part.closed = false;
  }
  if (seamless) {
    parts.front().closed = true;
    parts.front().joints.pop_back();
  }
  return parts;
}

double bulge(const Piece& piece) {
  const auto* arc = std::get_if<ArcPiece>(&piece);
  return arc == nullptr ? 0.0 : std::tan(0.25 * arc->kappa * arc->length);
}

class Drawer {
 public:
  Drawer(const Contour& contour, const DxfOptions& options)
      : contour_(contour), options_(options), layer_(safe_name(options.layer)) {}

  Result<DxfText> run() {
    Result<void> done;
    switch (options_.profile) {
      case DxfProfile::kExact:
        done = exact();
        break;
      case DxfProfile::kArcs:
      case DxfProfile::kArcsR12:
        done = arcs();
        break;
      case DxfProfile::kCubic:
        done = cubic();
        break;
    }
    if (!done) return fail(done.error());
    find_extents();
    if (options_.profile == DxfProfile::kArcsR12) {
      result_.text =
          exchange::r12_head(layer_, low_, high_) + out_.take() + "  0\nENDSEC\n  0\nEOF\n";
    } else {
      const std::string seed = out_.next_handle();
      result_.text = exchange::r2000_head(layer_, unit_code(contour_.units), seed, low_, high_) +
                     out_.take() + exchange::r2000_tail();
    }
    return std::move(result_);
  }

 private:
  void find_extents() {
    low_ = high_ = start_point(contour_.pieces.front());
    for (const Piece& piece : contour_.pieces) {
      for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const Vec2 p = evaluate(piece, t).point;
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
      }
    }
  }

  void entity(const char* kind, const char* subclass) {
    out_.pair(0, kind);
    out_.pair(5, out_.handle());
    out_.pair(330, kModelSpace);
    out_.pair(100, "AcDbEntity");
    out_.pair(8, layer_);
    out_.pair(100, subclass);
    ++result_.entities;
  }

  void line(const LinePiece& one) {
    entity("LINE", "AcDbLine");
    out_.point3(10, one.start);
    out_.point3(11, one.end);
  }

  /// DXF arcs run counter-clockwise.
  void arc(const ArcPiece& one) {
    const Vec2 centre = one.start + left_normal(unit_at(one.theta0)) / one.kappa;
    const double turn = one.kappa * one.length;
    const double from = one.theta0 - std::copysign(0.5 * std::numbers::pi, one.kappa);
    const double low = turn > 0.0 ? from : from + turn, high = turn > 0.0 ? from + turn : from;
    entity("ARC", "AcDbCircle");
    out_.point3(10, centre);
    out_.pair(40, 1.0 / std::abs(one.kappa));
    out_.pair(100, "AcDbArc");
    out_.pair(50, low / kDegree);
    out_.pair(51, high / kDegree);
  }

  /// DXF ellipses run counter-clockwise from `start` to `end` of their parameter.
  void ellipse(const Ellipse& one) {
    const Vec2 axis = unit_at(one.rotation);
    entity("ELLIPSE", "AcDbEllipse");
    out_.point3(10, one.centre);
    out_.point3(11, one.semi_major * axis);
    out_.pair(210, 0.0);
    out_.pair(220, 0.0);
    out_.pair(230, 1.0);
    out_.pair(40, one.semi_minor / one.semi_major);
    out_.pair(41, std::min(one.from, one.to));
    out_.pair(42, std::max(one.from, one.to));
  }

  void spline(const NurbsCurve& curve, bool closed) {
    constexpr int kClosed = 1, kRational = 4, kPlanar = 8;
    const bool rational =
        std::any_of(curve.weights.begin(), curve.weights.end(), [](double w) { return w != 1.0; });
    entity("SPLINE", "AcDbSpline");
    out_.pair(210, 0.0);
    out_.pair(220, 0.0);
    out_.pair(230, 1.0);
    out_.pair(70, kPlanar + (rational ? kRational : 0) + (closed ? kClosed : 0));
    out_.pair(71, curve.degree);
    out_.pair(72, static_cast<int>(curve.knots.size()));
    out_.pair(73, static_cast<int>(curve.points.size()));
    out_.pair(74, 0);
    for (const double knot : curve.knots) out_.pair(40, knot);
    for (const double weight : curve.weights) {
      if (rational) out_.pair(41, weight);
    }
    for (const Vec2 p : curve.points) out_.point3(10, p);
  }

  /// Ellipse arcs of a contour of conics; nothing where one of them is none.
  [[nodiscard]] std::optional<std::vector<Ellipse>> ellipses(const Contour& part) const {
    std::vector<Ellipse> out;
    for (const Piece& piece : part.pieces) {
      const auto* bezier = std::get_if<RationalBezier>(&piece);
      if (bezier == nullptr || bezier->degree != 2) return std::nullopt;
      const auto one = ellipse_of(*bezier);
      if (!one) return std::nullopt;
      out.push_back(*one);
    }
    return out;
  }

  Result<void> exact() {
    for (const Contour& part : smooth_parts(contour_)) {
      if (std::all_of(part.pieces.begin(), part.pieces.end(), is_circular)) {
        for (const Piece& piece : part.pieces) circular(piece);
        continue;
      }
      if (const auto conics = ellipses(part)) {
        for (const Ellipse& one : *conics) ellipse(one);
        continue;
      }
      const bool clothoid = std::any_of(
          part.pieces.begin(), part.pieces.end(),
          [](const Piece& piece) { return std::holds_alternative<ClothoidPiece>(piece); });
      if (clothoid) {
        if (auto done = cubic(part); !done) return done;
        continue;
      }
      const auto curve = joined_nurbs(part);
      if (!curve) return fail(curve.error());
      spline(*curve, part.closed);
    }
    return {};
  }

  void circular(const Piece& piece) {
    if (const auto* one = std::get_if<LinePiece>(&piece)) return line(*one);
    arc(std::get<ArcPiece>(piece));
  }

  Result<void> cubic() {
    for (const Contour& part : smooth_parts(contour_)) {
      if (auto done = cubic(part); !done) return done;
    }
    return {};
  }

  Result<void> cubic(const Contour& part) {
    const auto along = cubic_along(part, options_.tolerance);
    if (!along) return fail(along.error());
    result_.deviation = std::max(result_.deviation, along->deviation);
    spline(as_nurbs(along->spline), part.closed);
    return {};
  }

  Result<void> arcs() {
    auto along = arcs_along(contour_, options_.tolerance);
    if (!along) return fail(along.error());
    result_.deviation = along->deviation;
    if (options_.profile == DxfProfile::kArcsR12) {
      polyline(along->pieces);
    } else {
      lwpolyline(along->pieces);
    }
    return {};
  }

  void lwpolyline(const std::vector<Piece>& pieces) {
    const std::size_t count = pieces.size() + (contour_.closed ? 0 : 1);
    entity("LWPOLYLINE", "AcDbPolyline");
    out_.pair(90, static_cast<int>(count));
    out_.pair(70, contour_.closed ? 1 : 0);
    for (std::size_t i = 0; i < count; ++i) {
      out_.point(10, i < pieces.size() ? start_point(pieces[i]) : end_point(pieces.back()));
      if (i < pieces.size()) out_.pair(42, bulge(pieces[i]));
    }
  }

  void polyline(const std::vector<Piece>& pieces) {
    const std::size_t count = pieces.size() + (contour_.closed ? 0 : 1);
    out_.pair(0, "POLYLINE");
    out_.pair(8, layer_);
    out_.pair(66, 1);
    out_.point3(10, {0.0, 0.0});
    out_.pair(70, contour_.closed ? 1 : 0);
    for (std::size_t i = 0; i < count; ++i) {
      out_.pair(0, "VERTEX");
      out_.pair(8, layer_);
      out_.point3(10, i < pieces.size() ? start_point(pieces[i]) : end_point(pieces.back()));
      if (i < pieces.size()) out_.pair(42, bulge(pieces[i]));
    }
    out_.pair(0, "SEQEND");
    out_.pair(8, layer_);
    ++result_.entities;
  }

  const Contour& contour_;
  const DxfOptions& options_;
  std::string layer_;
  DxfWriter out_;
  DxfText result_;
  Vec2 low_, high_;
};

}  // namespace

Result<DxfText> dxf_text(const Contour& contour, const DxfOptions& options) {
  if (!(options.tolerance > 0.0)) {
    return fail({ErrorCode::kBadOption, "the tolerance must be greater than 0", "", "", -1,
                 options.tolerance});
  }
  if (contour.pieces.empty() || contour.joints.empty()) {
    return fail({ErrorCode::kTooFewPoints, "the contour has no pieces", "", "", -1, 0.0});
  }
  return Drawer(contour, options).run();
}

}  // namespace obvid
