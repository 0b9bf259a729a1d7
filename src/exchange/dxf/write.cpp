// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/dxf/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "dxf/file.h"
#include "dxf/parts.h"
#include "dxf/text.h"
#include "dxf/units.h"
#include "exact_conics.h"
#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/core/internal/questions.h"
#include "obvid/curve/internal/smooth_parts.h"
#include "obvid/exchange/internal/whole_arcs.h"
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
/// Names of layers in the file: no two names of ours become one there. Case does not tell layers
/// apart.
class LayerNames {
 public:
  explicit LayerNames(bool r12) : r12_(r12) {}

  /// The name in the file of a layer that we call `name`.
  const std::string& of(const std::string& name) {
    if (const auto known = names_.find(name); known != names_.end()) return known->second;
    const std::string wanted = r12_ ? safe_name(name) : dxf::layer_name(name);
    std::string given = wanted;
    for (int k = 2; !taken_.insert(upper(given)).second; ++k)
      given = wanted + fmt::format("_{}", k);
    layers_.push_back(given);
    return names_[name] = given;
  }
  [[nodiscard]] const std::vector<std::string>& all() const { return layers_; }
  /// How many are not called as they were.
  [[nodiscard]] std::size_t changed() const {
    return static_cast<std::size_t>(
        std::count_if(names_.begin(), names_.end(), [this](const auto& one) {
          return r12_ ? one.first != one.second
                      : dxf::to_label(one.second, one.first.size()) != one.first;
        }));
  }

 private:
  static std::string upper(std::string name) {
    for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return name;
  }
  bool r12_;
  std::map<std::string, std::string> names_;
  std::set<std::string> taken_;
  std::vector<std::string> layers_;
};

class DxfDrawer {
 public:
  DxfDrawer(const std::vector<DxfCurve>& curves, DxfProfile profile, Watch* watch)
      : curves_(curves),
        profile_(profile),
        watch_(watch),
        layers_(profile == DxfProfile::kArcsR12) {}

  /// One curve in a file of its own, each piece an entity where it can be one.
  Result<DxfText> run(const std::string& layer) {
    layer_ = safe_name(layer);
    in_pieces_ = true;
    return run();
  }

  Result<DxfText> run() {
    Box2 box;
    for (const DxfCurve& curve : curves_) {
      find_extents(curve.contour);
      box.add(box_.low);
      box.add(box_.high);
      OBVID_TRY(add(curve));
      if (is_to_end(watch_)) return fail(cancelled_error());
    }
    const Units& units = curves_.front().contour.units;
    std::vector<std::string> names = in_pieces_ ? std::vector{layer_} : layers_.all();
    result_.layers = names.size();
    result_.renamed = layers_.changed();
    if (profile_ == DxfProfile::kArcsR12) {
      result_.text = exchange::r12_head(names, dxf_unit(units), box.low, box.high) + out_.take() +
                     "  0\nENDSEC\n  0\nEOF\n";
    } else {
      std::vector<exchange::DxfLayer> layers;
      for (std::string& name : names) layers.push_back({std::move(name)});
      exchange::give_handles(layers, out_);
      const std::string seed = out_.next_handle();
      result_.text = exchange::r2000_head(layers, unit_code(units), seed, box.low, box.high) +
                     out_.take() + exchange::r2000_tail();
    }
    return std::move(result_);
  }

 private:
  Result<void> add(const DxfCurve& curve) {
    if (!std::isfinite(norm(box_.size()))) {
      return error(ErrorCode::kNotFinite, "a coordinate of the contour is not finite")
          .value(norm(box_.size()));
    }
    contour_ = &curve.contour;
    tolerance_ = curve.tolerance;
    if (!in_pieces_) layer_ = layers_.of(curve.layer);
    switch (profile_) {
      case DxfProfile::kExact:
        return exact();
      case DxfProfile::kArcs:
      case DxfProfile::kArcsR12:
        return arcs();
      case DxfProfile::kCubic:
        return cubic();
    }
    return {};
  }

  void find_extents(const Contour& contour) {
    box_ = {};
    for (const Piece& piece : contour.pieces) {
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
    constexpr double kWhole = 1.0 - 1e-9;  // of a turn: what parts of a circle may miss
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
    out_.pair(50, positive_angle(low / kOneDegree, 360.0));
    out_.pair(51, positive_angle(high / kOneDegree, 360.0));
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
    if (std::abs(one.to - one.from) >= kFullTurn) {
      out_.pair(41, 0.0);
      return out_.pair(42, kFullTurn);
    }
    out_.pair(41, positive_angle(std::min(one.from, one.to), kFullTurn));
    out_.pair(42, positive_angle(std::max(one.from, one.to), kFullTurn));
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

  /// Arcs of one ellipse that follow each other are one.
  [[nodiscard]] std::vector<Ellipse> whole_ellipses(const std::vector<Ellipse>& arcs) const {
    constexpr double kSame = 1e-12;  // of the size, and rad
    const double near = kSame * norm(box_.size());
    std::vector<Ellipse> out;
    for (const Ellipse& next : arcs) {
      Ellipse* last = out.empty() ? nullptr : &out.back();
      const bool goes_on = last != nullptr && norm(next.centre - last->centre) <= near &&
                           std::abs(next.semi_major - last->semi_major) <= near &&
                           std::abs(next.semi_minor - last->semi_minor) <= near &&
                           std::abs(next.rotation - last->rotation) <= kSame &&
                           (next.to > next.from) == (last->to > last->from) &&
                           std::abs(turn_between(last->to, next.from)) <= kSame;
      if (!goes_on) {
        out.push_back(next);
        continue;
      }
      last->to += next.to - next.from;
      if (std::abs(std::abs(last->to - last->from) - kFullTurn) <= kSame * kFullTurn) {
        last->to = last->from + std::copysign(kFullTurn, last->to - last->from);
      }
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

  /// Lines and arcs that are one curve among others: one entity, that they stay one.
  bool as_one_entity() {
    const std::vector<Piece>& pieces = contour_->pieces;
    if (!std::all_of(pieces.begin(), pieces.end(), is_circular)) return false;
    const std::vector<Piece> whole = exchange::whole_arcs(pieces);
    if (whole.size() > 1 || !centres_are_near(*contour_)) {
      lwpolyline(whole, contour_->closed);
    } else {
      circular(whole.front());
    }
    return true;
  }

  Result<void> exact() {
    if (!in_pieces_ && as_one_entity()) return {};
    const std::vector<Contour> parts = smooth_parts(*contour_);
    for (const Contour& part : parts) {
      OBVID_TRY(exact(part, contour_->closed && parts.size() == 1));
    }
    return {};
  }

  Result<void> exact(const Contour& part, bool closed) {
    if (std::all_of(part.pieces.begin(), part.pieces.end(), is_circular)) {
      if (centres_are_near(part)) {
        for (const Piece& piece : exchange::whole_arcs(part.pieces)) circular(piece);
      } else {
        lwpolyline(part.pieces, closed);
      }
      return {};
    }
    if (const auto conics = ellipses(part)) {
      for (const Ellipse& one : in_pieces_ ? *conics : whole_ellipses(*conics)) ellipse(one);
      return {};
    }
    auto made = nurbs_of(part, {true, tolerance_}, watch_);
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

  void circular(const Piece& piece) {
    if (const auto* one = std::get_if<LinePiece>(&piece)) return line(*one);
    arc(std::get<ArcPiece>(piece));
  }

  Result<void> cubic() {
    const std::vector<Contour> parts = smooth_parts(*contour_);
    for (const Contour& part : parts) {
      OBVID_TRY(cubic(part, contour_->closed && parts.size() == 1));
    }
    return {};
  }

  Result<void> cubic(const Contour& part, bool closed) {
    const auto along = cubic_along(part, tolerance_, watch_);
    OBVID_TRY(along);
    result_.deviation = std::max(result_.deviation, along->deviation);
    spline(as_nurbs(along->spline), closed);
    return {};
  }

  Result<void> arcs() {
    auto along = arcs_along(*contour_, tolerance_, watch_);
    OBVID_TRY(along);
    result_.deviation = std::max(result_.deviation, along->deviation);
    if (profile_ == DxfProfile::kArcsR12) {
      polyline(along->pieces);
    } else {
      lwpolyline(along->pieces, contour_->closed);
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
    out_.pair(70, contour_->closed ? 1 : 0);
    for (const auto& vertex : exchange::bulge_vertices(pieces, contour_->closed)) {
      out_.pair(0, "VERTEX");
      out_.pair(8, layer_);
      out_.point3(10, vertex.at);
      out_.pair(42, vertex.bulge);
    }
    out_.pair(0, "SEQEND");
    out_.pair(8, layer_);
    ++result_.entities;
  }

  const std::vector<DxfCurve>& curves_;
  DxfProfile profile_;
  Watch* watch_;
  LayerNames layers_;
  bool in_pieces_ = false;
  const Contour* contour_ = nullptr;  ///< that is drawn
  double tolerance_ = 0.0;            ///< of it
  std::string layer_;                 ///< of it, as in the file
  DxfWriter out_;
  DxfText result_;
  Box2 box_;
};

Result<void> can_be_drawn(const DxfCurve& curve) {
  if (!(curve.tolerance > 0.0)) {
    return error(ErrorCode::kBadOption, "the tolerance must be greater than 0")
        .value(curve.tolerance);
  }
  if (curve.contour.pieces.empty() || curve.contour.joints.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  return {};
}

}  // namespace

std::string dxf_unit(const Units& units) { return unit_code(units) != 0 ? units.name : ""; }

Result<DxfText> dxf_text(const std::vector<DxfCurve>& curves, DxfProfile profile, Watch* watch) {
  if (curves.empty()) return error(ErrorCode::kNothingThere, "there are no curves to write");
  for (const DxfCurve& curve : curves) {
    OBVID_TRY(can_be_drawn(curve));
    if (curve.contour.units.name != curves.front().contour.units.name) {
      return error(ErrorCode::kBadOption, "a DXF file has one unit for all of its curves");
    }
  }
  return DxfDrawer(curves, profile, watch).run();
}

Result<DxfText> dxf_text(const Contour& contour, const DxfOptions& options, Watch* watch) {
  const std::vector<DxfCurve> one{{contour, options.layer, options.tolerance}};
  OBVID_TRY(can_be_drawn(one.front()));
  return DxfDrawer(one, options.profile, watch).run(options.layer);
}

}  // namespace obvid
