// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/internal/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "box.h"
#include "double_double.h"
#include "obvid/series/analysis.h"

namespace obvid {
namespace {

/// A contour may bulge beyond the points that it passes.
constexpr double kBulge = 16.0;
constexpr double kLargestContour = kBulge * kLargestSeries;
/// Farther from the origin even the largest contour would be a single number.
constexpr double kLargestCoordinate = kLargestContour / kUnitRoundoff;
/// Shorter than any chord that a series within its limits can have, by many digits; squares of it
/// are normal numbers.
constexpr double kShortestPiece = 1e-130;
/// Weights, and the quotient of two in one piece: twofold quotients stay within range.
constexpr double kSmallestWeight = 1e-100;
constexpr double kLargestWeight = 1e100;
/// Ten turns, rad. A piece that is proved has less than one, a full circle of a drawing has one.
constexpr double kMostTurning = 20.0 * std::numbers::pi;
/// rad. Headings are counted on along a contour: a piece adds less than half a turn, a corner too.
constexpr double kFirstHeading = 8.0 * std::numbers::pi;
constexpr double kHeadingPerPiece = 2.0 * std::numbers::pi;

/// False for NaN too.
bool within(double value, double limit) { return value >= -limit && value <= limit; }
bool within(Vec2 v, double limit) { return within(v.x, limit) && within(v.y, limit); }

double length_of(Vec2 v) { return std::hypot(v.x, v.y); }

/// Looks at one list of the contour after the other; the first fault stays.
class Limits {
 public:
  explicit Limits(const Contour& contour)
      : contour_(contour),
        most_heading_(kFirstHeading +
                      kHeadingPerPiece * static_cast<double>(contour.pieces.size())) {}

  std::optional<OutOfRange> run() {
    look_at("points", contour_.points, [this](Vec2 p) { return fault_of_point(p); });
    look_at("point_tolerance", contour_.point_tolerance,
            [](double t) { return t >= 0.0 && t <= kLargestContour ? nullptr : "no tolerance"; });
    look_at("pieces", contour_.pieces, [this](const Piece& piece) {
      return std::visit([this](const auto& kind) { return fault_of(kind); }, piece);
    });
    look_at("elements", contour_.joints, [this](const Joint& joint) { return fault_of(joint); });
    check_size();
    look_at("pieces", contour_.pieces, [this](const Piece& piece) {
      const auto* bezier = std::get_if<RationalBezier>(&piece);
      return bezier != nullptr ? fault_of_origin(*bezier) : nullptr;
    });
    return std::move(found_);
  }

 private:
  template <class List, class Fault>
  void look_at(std::string_view list, const List& items, Fault fault) {
    for (std::size_t i = 0; i < items.size() && !found_; ++i) {
      if (const char* what = fault(items[i])) refuse(list, i, what);
    }
  }

  void refuse(std::string_view list, std::size_t index, std::string what) {
    found_ = OutOfRange{code_, list, index, std::move(what)};
  }

  /// A number that is no size: another code.
  const char* contradiction(const char* what) {
    code_ = ErrorCode::kBadJson;
    return what;
  }

  const char* fault_of_point(Vec2 p) {
    if (!within(p, kLargestCoordinate)) return kCoordinate;
    box_.grow(p);
    return nullptr;
  }

  const char* fault_of_heading(double theta) {
    return within(theta, most_heading_) ? nullptr
                                        : contradiction("the heading is turns beyond its contour");
  }

  const char* fault_of(const LinePiece& line) {
    if (const char* what = fault_of_point(line.start)) return what;
    if (const char* what = fault_of_point(line.end)) return what;
    return length_of(line.end - line.start) >= kShortestPiece ? nullptr : kShort;
  }

  template <class Curve>
  const char* fault_of_turning(const Curve& curve, double kappa0, double kappa1) {
    if (const char* what = fault_of_point(curve.start)) return what;
    if (const char* what = fault_of_point(curve.end)) return what;
    if (!(curve.length >= kShortestPiece && curve.length <= kLargestContour)) {
      return "the length is out of range";
    }
    for (const double kappa : {kappa0, kappa1}) {
      if (!within(kappa * curve.length, kMostTurning))
        return "the piece turns by more than ten turns";
    }
    return fault_of_heading(curve.theta0);
  }
  const char* fault_of(const ArcPiece& arc) { return fault_of_turning(arc, arc.kappa, arc.kappa); }
  const char* fault_of(const ClothoidPiece& one) {
    return fault_of_turning(one, one.kappa0, one.kappa1);
  }

  const char* fault_of(const RationalBezier& piece) {
    if (piece.degree < 1 || piece.degree > kMaxBezierDegree) return "the degree is not known";
    if (!within(piece.origin, kLargestCoordinate)) return kCoordinate;
    double extent = 0.0, least = kLargestWeight, most = 0.0;
    const auto last = static_cast<std::size_t>(piece.degree);
    for (std::size_t j = 0; j <= last; ++j) {
      const double weight = std::abs(piece.weight[j]);
      if (!within(piece.offset[j], kLargestCoordinate)) return kCoordinate;
      if (!(weight >= kSmallestWeight && weight <= kLargestWeight)) return kWeight;
      const Vec2 leg = piece.offset[j] - piece.offset[0];
      extent = std::max({extent, std::abs(leg.x), std::abs(leg.y)});
      least = std::min(least, weight);
      most = std::max(most, weight);
    }
    if (!(most / least <= kLargestWeight)) return kWeight;
    box_.grow(piece.origin + piece.offset[0]);
    box_.grow(piece.origin + piece.offset[last]);
    if (extent > kLargestContour) return "the size of the piece is out of range";
    return extent >= kShortestPiece ? nullptr : kShort;
  }

  const char* fault_of(const Joint& joint) {
    for (const Element* e : {&joint.element, joint.leaving ? &*joint.leaving : nullptr}) {
      if (e == nullptr) continue;
      if (!within(e->point, kLargestCoordinate)) return kCoordinate;
      if (!std::isnan(e->kappa) && !within(e->kappa, kMostTurning / kShortestPiece)) {
        return "the curvature is out of range";
      }
      if (const char* what = fault_of_heading(e->theta)) return what;
    }
    return nullptr;
  }

  void check_size() {
    if (found_ || contour_.pieces.empty()) return;
    const double size = length_of(box_.high - box_.low);
    // a single closed piece has no box: its length was looked at
    if (size <= kLargestContour && (size >= kSmallestSeries || contour_.pieces.size() == 1)) return;
    refuse("", 0,
           fmt::format("the size of the contour is outside {:g} to {:g}", kSmallestSeries,
                       kLargestSeries));
  }

  const char* fault_of_origin(const RationalBezier& piece) {
    if (piece.origin == Vec2{}) return nullptr;
    return box_.distance(piece.origin) <= length_of(box_.high - box_.low)
               ? nullptr
               : contradiction("the origin lies farther from the contour than this is large");
  }

  static constexpr const char* kCoordinate = "a coordinate is out of range";
  static constexpr const char* kWeight = "the weights are out of range";
  static constexpr const char* kShort = "the piece is too short";

  const Contour& contour_;
  double most_heading_;
  Box box_;
  ErrorCode code_ = ErrorCode::kSizeOutOfRange;
  std::optional<OutOfRange> found_;
};

}  // namespace

std::optional<OutOfRange> out_of_range(const Contour& contour) { return Limits(contour).run(); }

std::optional<std::size_t> joint_without_curvature(const Contour& contour) {
  const auto undefined = [](const Joint& joint) {
    return std::isnan(joint.element.kappa) || (joint.leaving && std::isnan(joint.leaving->kappa));
  };
  const auto found = std::find_if(contour.joints.begin(), contour.joints.end(), undefined);
  if (found == contour.joints.end()) return std::nullopt;
  return static_cast<std::size_t>(found - contour.joints.begin());
}

}  // namespace obvid
