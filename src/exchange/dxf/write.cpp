// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/dxf/write.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "dxf/file.h"
#include "dxf/parts.h"
#include "dxf/units.h"
#include "exact_conics.h"
#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/core/internal/questions.h"
#include "obvid/curve/internal/smooth_parts.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/box.h"

namespace obvid {
namespace {

using exchange::DxfWriter;
using exchange::kModelSpace;

/// $INSUNITS of a unit that is known; 0: the file states none.
int unit_code(const Units& units) { return units.known() ? dxf::insunits_of(units.name) : 0; }

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

/// Angle from 0 to below `turn`.
double within(double angle, double turn) {
  const double rest = std::fmod(angle, turn);
  return rest < 0.0 ? rest + turn : rest;
}

class DxfDrawer {
 public:
  DxfDrawer(const Contour& contour, const DxfOptions& options, Watch* watch)
      : contour_(contour), options_(options), watch_(watch), layer_(safe_name(options.layer)) {}

  Result<DxfText> run() {
    find_extents();
    if (!std::isfinite(norm(box_.size()))) {
      return error(ErrorCode::kNotFinite, "a coordinate of the contour is not finite")
          .value(norm(box_.size()));
    }
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
    OBVID_TRY(done);
    if (is_to_end(watch_)) return fail(cancelled_error());
    if (options_.profile == DxfProfile::kArcsR12) {
      result_.text = exchange::r12_head(layer_, dxf_unit(contour_.units), box_.low, box_.high) +
                     out_.take() + "  0\nENDSEC\n  0\nEOF\n";
    } else {
      const std::string seed = out_.next_handle();
      result_.text =
          exchange::r2000_head({{layer_}}, unit_code(contour_.units), seed, box_.low, box_.high) +
          out_.take() + exchange::r2000_tail();
    }
    return std::move(result_);
  }

 private:
  void find_extents() {
    for (const Piece& piece : contour_.pieces) {
      for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const Vec2 p = evaluate(piece, t).point;
        if (!std::isfinite(p.x) || !std::isfinite(p.y)) box_.low = p;
        box_.add(p);
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

  /// DXF arcs run counter-clockwise. Where both angles print alike readers see a whole circle.
  void arc(const ArcPiece& one) {
    constexpr double kToldAngle = 1e-12;  ///< rad
    if (std::abs(one.kappa * one.length) < kToldAngle) return line({one.start, one.end});
    constexpr double kWhole = 1.0 - 1e-12;  // of a turn: an arc of equal angles would be nothing
    const Vec2 centre = one.start + left_normal(unit_at(one.theta0)) / one.kappa;
    const double turn = one.kappa * one.length;
    const double from = one.theta0 - std::copysign(0.5 * std::numbers::pi, one.kappa);
    const double low = turn > 0.0 ? from : from + turn, high = turn > 0.0 ? from + turn : from;
    const bool whole = std::abs(turn) >= kWhole * kFullTurn;
    entity(whole ? "CIRCLE" : "ARC", "AcDbCircle");
    out_.point3(10, centre);
    out_.pair(40, 1.0 / std::abs(one.kappa));
    if (whole) return;
    out_.pair(100, "AcDbArc");
    out_.pair(50, within(low / kOneDegree, 360.0));
    out_.pair(51, within(high / kOneDegree, 360.0));
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
    out_.pair(41, within(std::min(one.from, one.to), kFullTurn));
    out_.pair(42, within(std::max(one.from, one.to), kFullTurn));
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
    Questions questions(watch_);
    for (const double knot : curve.knots) {
      if (questions.end()) return;
      out_.pair(40, knot);
    }
    for (const double weight : curve.weights) {
      if (questions.end()) return;
      if (rational) out_.pair(41, weight);
    }
    for (const Vec2 p : curve.points) {
      if (questions.end()) return;
      out_.point3(10, p);
    }
  }

  /// Ellipse arcs of a contour of conics; nothing where one of them is none, or is so near to a
  /// parabola that its centre and axes lose what the spline keeps.
  [[nodiscard]] std::optional<std::vector<Ellipse>> ellipses(const Contour& part) const {
    std::vector<Ellipse> out;
    for (const Piece& piece : part.pieces) {
      const auto* bezier = std::get_if<RationalBezier>(&piece);
      if (bezier == nullptr) return std::nullopt;
      const auto one = exchange::ellipse_within(*bezier, norm(box_.size()));
      if (!one) return std::nullopt;
      out.push_back(*one);
    }
    return out;
  }

  /// LINE and ARC lose digits where the centre lies far away; bulges do not.
  [[nodiscard]] bool centres_are_near(const Contour& part) const {
    return std::all_of(part.pieces.begin(), part.pieces.end(), [&](const Piece& piece) {
      const auto* one = std::get_if<ArcPiece>(&piece);
      return one == nullptr || exchange::centre_is_near(*one, norm(box_.size()));
    });
  }

  Result<void> exact() {
    const std::vector<Contour> parts = smooth_parts(contour_);
    for (const Contour& part : parts) {
      OBVID_TRY(exact(part, contour_.closed && parts.size() == 1));
    }
    return {};
  }

  Result<void> exact(const Contour& part, bool closed) {
    if (std::all_of(part.pieces.begin(), part.pieces.end(), is_circular)) {
      if (centres_are_near(part)) {
        for (const Piece& piece : whole_arcs(part.pieces)) circular(piece);
      } else {
        lwpolyline(part.pieces, closed);
      }
      return {};
    }
    if (const auto conics = ellipses(part)) {
      for (const Ellipse& one : *conics) ellipse(one);
      return {};
    }
    auto made = nurbs_of(part, {true, options_.tolerance}, watch_);
    if (!made && made.error().code == ErrorCode::kNotProved) {
      // the contour may be proved: it is this format that does not hold such a spline
      Error error = made.error();
      error.code = ErrorCode::kToleranceNotReached;
      error.hint = "choose --dxf arcs or cubic, or STEP";
      return fail(std::move(error));
    }
    OBVID_TRY(made);
    result_.deviation = std::max(result_.deviation, made->deviation);
    spline(made->curve, closed);
    return {};
  }

  /// Arcs that are parts of one are that; once around it is a circle.
  [[nodiscard]] static std::vector<Piece> whole_arcs(const std::vector<Piece>& pieces) {
    constexpr double kSame = 1e-12;     // of the curvature
    constexpr double kSmooth = 1e-9;    // rad
    constexpr double kRounding = 1e-9;  // of a turn
    std::vector<Piece> out;
    for (const Piece& piece : pieces) {
      const auto* next = std::get_if<ArcPiece>(&piece);
      auto* last = out.empty() ? nullptr : std::get_if<ArcPiece>(&out.back());
      const bool goes_on =
          next != nullptr && last != nullptr &&
          std::abs(next->kappa - last->kappa) <= kSame * std::abs(last->kappa) &&
          std::abs(std::remainder(last->theta0 + last->kappa * last->length - next->theta0,
                                  kFullTurn)) <= kSmooth &&
          std::abs(last->kappa) * (last->length + next->length) <= (1.0 + kRounding) * kFullTurn;
      if (!goes_on) {
        out.push_back(piece);
        continue;
      }
      last->length += next->length;
      const double turn = std::abs(last->kappa) * last->length;
      if (std::abs(turn - kFullTurn) <= kRounding * kFullTurn) {
        last->length = kFullTurn / std::abs(last->kappa);
      }
    }
    return out;
  }

  void circular(const Piece& piece) {
    if (const auto* one = std::get_if<LinePiece>(&piece)) return line(*one);
    arc(std::get<ArcPiece>(piece));
  }

  Result<void> cubic() {
    const std::vector<Contour> parts = smooth_parts(contour_);
    for (const Contour& part : parts) {
      OBVID_TRY(cubic(part, contour_.closed && parts.size() == 1));
    }
    return {};
  }

  Result<void> cubic(const Contour& part, bool closed) {
    const auto along = cubic_along(part, options_.tolerance, watch_);
    OBVID_TRY(along);
    result_.deviation = std::max(result_.deviation, along->deviation);
    spline(as_nurbs(along->spline), closed);
    return {};
  }

  Result<void> arcs() {
    auto along = arcs_along(contour_, options_.tolerance, watch_);
    OBVID_TRY(along);
    result_.deviation = along->deviation;
    if (options_.profile == DxfProfile::kArcsR12) {
      polyline(along->pieces);
    } else {
      lwpolyline(along->pieces, contour_.closed);
    }
    return {};
  }

  void lwpolyline(const std::vector<Piece>& pieces, bool closed) {
    const auto vertices = exchange::bulge_vertices(pieces, closed);
    entity("LWPOLYLINE", "AcDbPolyline");
    out_.pair(90, static_cast<int>(vertices.size()));
    out_.pair(70, closed ? 1 : 0);
    for (const auto& vertex : vertices) {
      out_.point(10, vertex.at);
      out_.pair(42, vertex.bulge);
    }
  }

  void polyline(const std::vector<Piece>& pieces) {
    out_.pair(0, "POLYLINE");
    out_.pair(8, layer_);
    out_.pair(66, 1);
    out_.point3(10, {0.0, 0.0});
    out_.pair(70, contour_.closed ? 1 : 0);
    for (const auto& vertex : exchange::bulge_vertices(pieces, contour_.closed)) {
      out_.pair(0, "VERTEX");
      out_.pair(8, layer_);
      out_.point3(10, vertex.at);
      out_.pair(42, vertex.bulge);
    }
    out_.pair(0, "SEQEND");
    out_.pair(8, layer_);
    ++result_.entities;
  }

  const Contour& contour_;
  const DxfOptions& options_;
  Watch* watch_;
  std::string layer_;
  DxfWriter out_;
  DxfText result_;
  Box2 box_;
};

}  // namespace

std::string dxf_unit(const Units& units) { return unit_code(units) != 0 ? units.name : ""; }

Result<DxfText> dxf_text(const Contour& contour, const DxfOptions& options, Watch* watch) {
  if (!(options.tolerance > 0.0)) {
    return error(ErrorCode::kBadOption, "the tolerance must be greater than 0")
        .value(options.tolerance);
  }
  if (contour.pieces.empty() || contour.joints.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  return DxfDrawer(contour, options, watch).run();
}

}  // namespace obvid
