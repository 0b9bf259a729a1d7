// SPDX-License-Identifier: Apache-2.0
#include "joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "box.h"
#include "double_double.h"
#include "end_data.h"
#include "obvid/certify/internal/loose_slopes.h"

namespace obvid {
namespace {

// What is called continuous (docs/claims.md).
constexpr double kPositionBound = 1e-12;  // of the contour's size
/// Coordinates far from the origin cannot say a position better than this, at the most; beyond,
/// nobody would call a joint continuous.
constexpr double kZeroEnd = 1e-9;          // of the larger curvature of the piece
constexpr double kBesideEnd = 0x1p-10;     // of the parameter
constexpr double kPositionCeiling = 1e-6;  // of the contour's size

// How far an element may be outside of what lies between the two ends that meet at its joint.
constexpr double kElementHeading = 1e-9;    // rad
constexpr double kElementCurvature = 1e-9;  // of the curvature at the joint

/// The bound of a gap: what is called continuous, or what rounding explains up to the ceiling.
double allowed(double base, double rounding, double ceiling) {
  return std::max(base, std::min(rounding, ceiling));
}

/// Of the largest curvature at the four ends of two neighbouring pieces: below, the joint is flat
/// beside its pieces, and "of the larger of the two" would divide rounding by zero.
constexpr double kFlat = 1e-6;

/// Two arcs whose curvatures agree this far, of the larger, are one circle in rounded numbers.
constexpr double kSameArc = 1e-9;

/// Curvatures on both sides of a corner that agree this far are the same: nothing ties them to each
/// other, and what iterations leave of two equal ones is no leap.
constexpr double kSameAtCorner = 1e-7;

// Roundings of the comparison of two ends, in units of 2^-53.
constexpr double kOfTurning = 4.0;   // rad: of the product of two directions, and of its arctangent
constexpr double kOfQuotient = 8.0;  // relative: of distances and differences over a size

/// Beyond any contour that a proof makes sense for; also stands in for NaN.
constexpr double kBroken = std::numeric_limits<double>::max();

double known(double gap) { return is_nan(gap) ? kBroken : gap; }

double size_of_box(const Contour& contour, const std::vector<KnownPiece>* known) {
  Box box;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const Piece& piece = contour.pieces[i];
    box.grow(start_point(piece));
    box.grow(end_point(piece));
    // a single closed arc has no other extent
    box.grow(known != nullptr ? (*known)[i].middle : evaluate(piece, 0.5).point);
  }
  const Vec2 size = box.high - box.low;
  return std::hypot(size.x, size.y);
}

/// Rounded outward: at least what it would be without the roundings of its own evaluation.
double outward(double figure) { return figure * (1.0 + kOfQuotient * kUnitRoundoff); }
double inward(double figure) { return figure * (1.0 - kOfQuotient * kUnitRoundoff); }

/// At least the angle between two directions that are known to `error`.
double heading_gap(Vec2 a, Vec2 b, double error) {
  return std::abs(turning(a, b)) + kOfTurning * kUnitRoundoff + error;
}

/// At least the distance between two exact ends.
double distance(const EndData& a, const EndData& b) {
  const Vec2 d = (a.point - b.point) + (a.rest - b.rest);
  return outward(std::hypot(d.x, d.y)) + a.point_error + b.point_error;
}

bool is_arc_or_line(const Piece& piece) {
  return std::holds_alternative<ArcPiece>(piece) || std::holds_alternative<LinePiece>(piece);
}

double largest_kappa(const PieceEnds& piece) {
  return std::max(std::abs(piece.start.kappa), std::abs(piece.end.kappa));
}

/// Walks along the contour, comparing neighbours with each other and with the joint's element.
class JointWalk {
 public:
  JointWalk(const Contour& contour, const PieceBends& bends, const std::vector<KnownPiece>* known)
      : contour_(contour), bends_(bends), known_(known), size_(size_of_box(contour, known)) {}

  JointSurvey run() {
    const std::size_t n = contour_.pieces.size();
    survey_.jump.assign(n, 0);
    if (contour_.continuity == Continuity::kG3) survey_.gaps.slope = 0.0;
    PieceEnds first, before;
    for (std::size_t i = 0; i < n; ++i) {
      const PieceEnds here = ends_at(i);
      if (i == 0) first = here;
      if (i > 0) survey_.jump[i] = compare(i, before, here);
      // the seam is compared when the contour comes round to it
      const bool seam = i == 0 && contour_.closed;
      if (!seam && !compare_with_element(i, i > 0 ? &before : nullptr, &here)) break;
      compare_stored_ends(i, here.end);
      const double largest = std::max(std::abs(here.start.kappa), std::abs(here.end.kappa));
      if (const auto bends = bends_.find(i); bends != bends_.end()) {
        follow_bends(bends->second, here, largest);
      } else {
        follow_end(here.start, largest);
        follow_end(here.end, largest);
      }
      before = here;
    }
    if (n > 0) finish(before, first);
    return std::move(survey_);
  }

 private:
  [[nodiscard]] PieceEnds ends_at(std::size_t i) const {
    if (known_ != nullptr) return (*known_)[i].ends;
    return ends_of(contour_.pieces[i], contour_.continuity == Continuity::kG3);
  }

  void finish(const PieceEnds& last, const PieceEnds& first) {
    const std::size_t n = contour_.pieces.size();
    if (!contour_.closed) {
      compare_with_element(n, &last, nullptr);
      return;
    }
    survey_.jump[0] = compare(0, last, first);
    compare_with_element(0, &last, &first);
    if (first_sign_ != 0 && last_sign_ != first_sign_) ++survey_.inflections;
  }

  /// Whether the gap is within its bound; the first that is not is the reason.
  bool check(double gap, double bound, std::size_t joint, const char* what) {
    const bool within = gap <= bound && gap < kBroken;
    if (within || !survey_.within_bounds) return within;
    survey_.within_bounds = false;
    survey_.loose_joint = joint;
    survey_.reason =
        fmt::format("{} at joint {} is {:.3g}, its bound {:.3g}", what, joint + 1, gap, bound);
    return false;
  }

  void check_position(double far, double rounding, std::size_t joint) {
    const double gap = known(outward(far / size_));
    survey_.gaps.position = std::max(survey_.gaps.position, gap);
    const double bound = allowed(kPositionBound, rounding / size_, kPositionCeiling);
    if (!check(gap, bound, joint, "the position gap")) survey_.meeting = false;
  }

  /// A difference of curvatures against those that meet at a joint.
  struct Scale {
    double kappa = 0.0;
    [[nodiscard]] double of(double difference) const {
      return difference == 0.0 ? 0.0 : known(outward(difference / kappa));
    }
  };

  /// `left` and `right` of a joint; null beyond the end of an open contour.
  static Scale scale_at(const PieceEnds* left, const PieceEnds* right) {
    double there = 0.0, beside = 0.0;
    if (left != nullptr) {
      there = std::abs(left->end.kappa);
      beside = largest_kappa(*left);
    }
    if (right != nullptr) {
      there = std::max(there, std::abs(right->start.kappa));
      beside = std::max(beside, largest_kappa(*right));
    }
    return {std::max(there, kFlat * beside)};
  }

  /// Arcs promise a common tangent only; their jumps are judged as changes of curvature.
  [[nodiscard]] bool may_jump(std::size_t joint) const {
    const std::size_t n = contour_.pieces.size();
    return steps_at_joints(contour_.carrier) &&
           is_arc_or_line(contour_.pieces[(joint + n - 1) % n]) &&
           is_arc_or_line(contour_.pieces[joint]);
  }

  /// Two neighbouring pieces; returns the sign of the curvature's jump if it is one.
  std::int8_t compare(std::size_t joint, const PieceEnds& before, const PieceEnds& after) {
    const EndData &left = before.end, &right = after.start;
    ++survey_.joints;
    check_position(distance(left, right), left.point_rounding + right.point_rounding, joint);
    const double turn = known(
        heading_gap(left.direction, right.direction, left.heading_error + right.heading_error));
    if (is_parted(joint)) {
      if (is_corner(contour_.joints[joint])) {
        ++survey_.corners;
      } else {
        ++survey_.curvature_steps;
        survey_.gaps.heading = std::max(survey_.gaps.heading, turn);
        check(turn, kTangentTurn, joint, "the heading gap");
      }
      return parted_jump(left, right);
    }
    survey_.gaps.heading = std::max(survey_.gaps.heading, turn);
    check(turn, kContinuousHeading, joint, "the heading gap");
    const double jump = right.kappa - left.kappa;
    const double gap = scale_at(&before, &after)
                           .of(outward(std::abs(jump)) + left.kappa_error + right.kappa_error);
    survey_.gaps.curvature = std::max(survey_.gaps.curvature, gap);
    compare_slopes(joint, before, after);
    const bool arcs = may_jump(joint);
    if (!arcs) check(gap, kContinuousCurvature, joint, "the curvature gap");
    if (gap <= (arcs ? kSameArc : kContinuousCurvature)) return 0;
    return static_cast<std::int8_t>(jump > 0.0 ? 1 : jump < 0.0 ? -1 : 0);
  }

  /// Lower bound of the largest of those at the ends of a piece and the mean one over its chord: a
  /// slope may vanish at both ends.
  static double largest_slope(const PieceEnds& piece) {
    const double error = outward(piece.start.kappa_error + piece.end.kappa_error);
    const double change = inward(std::abs(piece.end.kappa - piece.start.kappa)) - error;
    const double mean = inward(std::max(0.0, change) / distance(piece.start, piece.end));
    const double ends = std::max(std::abs(piece.start.slope) - piece.start.slope_error,
                                 std::abs(piece.end.slope) - piece.end.slope_error);
    return std::max(0.0, std::isfinite(mean) ? std::max(ends, mean) : ends);
  }

  /// Slopes of curvature, where the contour claims that they are continuous.
  void compare_slopes(std::size_t joint, const PieceEnds& before, const PieceEnds& after) {
    if (contour_.continuity != Continuity::kG3) return;
    if (contour_.joints[joint].slope_step) {
      ++survey_.slope_steps;
      return;
    }
    const EndData &left = before.end, &right = after.start;
    const double largest = std::max(largest_slope(before), largest_slope(after));
    const auto of_largest = [largest](double difference) {
      return difference == 0.0 ? 0.0 : known(outward(difference / largest));
    };
    const double gap = of_largest(outward(std::abs(right.slope - left.slope)) + left.slope_error +
                                  right.slope_error);
    survey_.gaps.slope = std::max(*survey_.gaps.slope, gap);
    if (!(gap <= kContinuousSlope)) survey_.loose_slopes.push_back(joint);
    check(gap, kContinuousSlope, joint, "the gap of the slope of curvature");
  }

  /// Whether the joint says something else for the piece that leaves it.
  [[nodiscard]] bool is_parted(std::size_t joint) const {
    return joint < contour_.joints.size() && contour_.joints[joint].leaving.has_value();
  }

  /// At a corner only the position is continuous, at a step of the curvature the heading too; which
  /// way the curvature leaps counts like a leap between arcs.
  [[nodiscard]] static std::int8_t parted_jump(const EndData& left, const EndData& right) {
    const double jump = right.kappa - left.kappa;
    const double larger = std::max(std::abs(left.kappa), std::abs(right.kappa));
    const double rounding = left.kappa_rounding + right.kappa_rounding;
    const bool none =
        std::abs(jump) <= allowed(kSameAtCorner * larger, rounding, kContinuousCurvature * larger);
    return static_cast<std::int8_t>(none ? 0 : (jump > 0.0 ? 1 : -1));
  }

  /// The joint's own element against the ends that meet there. False where there is no element.
  bool compare_with_element(std::size_t joint, const PieceEnds* left, const PieceEnds* right) {
    if (joint >= contour_.joints.size()) {
      survey_.meeting = check(kBroken, 0.0, joint, "the number of joints");
      return false;
    }
    const Joint& here = contour_.joints[joint];
    if (!is_parted(joint)) {
      compare_element(joint, here.element, left, right);
    } else if (left == nullptr || right == nullptr) {
      check(kBroken, 0.0, joint, "the missing side of the joint");
    } else {
      compare_element(joint, here.element, left, nullptr);
      compare_element(joint, *here.leaving, nullptr, right);
    }
    return true;
  }

  void compare_element(std::size_t joint, const Element& element, const PieceEnds* left,
                       const PieceEnds* right) {
    const EndData* ends[] = {left != nullptr ? &left->end : nullptr,
                             right != nullptr ? &right->start : nullptr};
    EndData claimed;
    claimed.point = element.point;
    // what lies between both ends belongs to their joint; how far they are apart is judged there
    const double apart = ends[0] != nullptr && ends[1] != nullptr
                             ? heading_gap(ends[0]->direction, ends[1]->direction, 0.0)
                             : 0.0;
    for (const EndData* end : ends) {
      if (end == nullptr) continue;
      check_position(distance(*end, claimed), end->point_rounding, joint);
      check(known(heading_gap(unit_at(element.theta), end->direction, end->heading_error)),
            apart + allowed(kElementHeading, end->heading_rounding, kContinuousHeading), joint,
            "the difference of headings between element and piece");
    }
    check_element_kappa(joint, element.kappa, scale_at(left, right),
                        *(ends[0] != nullptr ? ends[0] : ends[1]),
                        *(ends[1] != nullptr ? ends[1] : ends[0]));
  }

  void check_element_kappa(std::size_t joint, double kappa, const Scale& scale, const EndData& left,
                           const EndData& right) {
    const double rounding = std::max(left.kappa_rounding, right.kappa_rounding);
    const double low = std::min(left.kappa, right.kappa);
    const double high = std::max(left.kappa, right.kappa);
    const double difference = is_nan(kappa) ? kappa : std::max({0.0, low - kappa, kappa - high});
    check(scale.of(known(difference)),
          allowed(kElementCurvature, scale.of(rounding), kContinuousCurvature), joint,
          "the difference of curvatures between element and piece");
  }

  /// The stored end of an arc or clothoid is a number of its own, beside the end it leads to.
  void compare_stored_ends(std::size_t i, const EndData& end) {
    const Piece& piece = contour_.pieces[i];
    if (!std::holds_alternative<ArcPiece>(piece) && !std::holds_alternative<ClothoidPiece>(piece)) {
      return;
    }
    EndData stored;
    stored.point = end_point(piece);
    check_position(distance(end, stored), end.point_rounding, i + 1);
  }

  /// Signs of the curvature along a piece whose ends do not tell them. One beside an end that is a
  /// rounded zero is rounding too, if the piece soon bends the other way.
  void follow_bends(const std::vector<SignFrom>& bends, const PieceEnds& here, double largest) {
    const auto rounded = [largest](const EndData& end) {
      return std::abs(end.kappa) <= zero_beside(end, largest);
    };
    std::size_t first = 0, last = bends.size();
    if (last > 1 && bends[1].t < kBesideEnd && rounded(here.start)) ++first;
    if (last - first > 1 && bends[last - 1].t > 1.0 - kBesideEnd && rounded(here.end)) --last;
    for (std::size_t k = first; k < last; ++k) follow(bends[k].sign);
  }

  /// What of an end's curvature is a rounded zero: what is small beside the larger end of its
  /// piece.
  static double zero_beside(const EndData& end, double largest) {
    return end.kappa_error + kZeroEnd * largest;
  }

  /// Curvature is monotone on each proved piece, so signs at the ends tell all its sign changes.
  void follow_end(const EndData& end, double largest) {
    const double zero = zero_beside(end, largest);
    follow(end.kappa > zero ? 1 : (end.kappa < -zero ? -1 : 0));
  }

  void follow(int sign) {
    if (sign == 0) return;
    if (last_sign_ != 0 && sign != last_sign_) ++survey_.inflections;
    if (first_sign_ == 0) first_sign_ = sign;
    last_sign_ = sign;
  }

  const Contour& contour_;
  const PieceBends& bends_;
  const std::vector<KnownPiece>* known_;
  double size_;
  int first_sign_ = 0;
  int last_sign_ = 0;
  JointSurvey survey_;
};

}  // namespace

JointSurvey survey_joints(const Contour& contour, const PieceBends& bends,
                          const std::vector<KnownPiece>* known) {
  return JointWalk(contour, bends, known).run();
}

std::vector<std::size_t> joints_with_loose_slopes(Contour contour) {
  contour.continuity = Continuity::kG3;
  return survey_joints(contour).loose_slopes;
}

namespace {

/// Whether a joint is where the point that it names may be: on it, or where points have tolerances
/// within that of it or nearer to it than to its neighbours (ends of arcs may lie farther along);
/// nearer by less than the tolerance tells nothing.
bool stands_on(Vec2 place, const Contour& contour, std::size_t point) {
  const auto& points = contour.points;
  if (place == points[point]) return true;
  if (point >= contour.point_tolerance.size() || contour.point_tolerance[point] == 0.0)
    return false;
  const std::size_t n = points.size();
  const double off = norm(place - points[point]);
  const double reach = contour.point_tolerance[point];
  if (off <= reach) return true;
  const std::size_t before = point > 0 ? point - 1 : contour.closed ? n - 1 : point;
  const std::size_t behind = point + 1 < n ? point + 1 : contour.closed ? 0 : point;
  return off - reach <= norm(place - points[before]) && off - reach <= norm(place - points[behind]);
}

}  // namespace

std::string missed_point(const Contour& contour) {
  const std::size_t n = contour.points.size();
  // one closed piece has one joint, all others two at least
  if (n < std::min<std::size_t>(2, std::max<std::size_t>(1, contour.joints.size()))) {
    return "the contour does not name the points that it passes";
  }
  for (std::size_t i = 1; i < n; ++i) {
    if (contour.points[i] == contour.points[i - 1]) {
      return fmt::format("point {} repeats the point before it", i + 1);
    }
  }
  const bool exact = contour.point_tolerance.empty();
  std::size_t met = 0, first = 0, due = 0;  // due: counted from the first source on
  bool begins_between = false;              // with a corner between the last point and that one
  for (std::size_t j = 0; j < contour.joints.size(); ++j) {
    const Joint& joint = contour.joints[j];
    if (!joint.source && joint.after) {  // points behind it are due
      if (*joint.after >= n) return fmt::format("joint {} claims a point that is not there", j + 1);
      if (!joint.leaving) {
        return fmt::format("joint {} claims a corner between points, and is none", j + 1);
      }
      if (j == 0) {
        first = (*joint.after + 1) % n;
        begins_between = true;
        continue;
      }
      const std::size_t place = (*joint.after + n - first) % n;
      if (place + 1 < due || (exact && place + 1 != due)) {
        return fmt::format("joint {} claims a corner behind point {} where point {} is due", j + 1,
                           *joint.after + 1, (due + first) % n + 1);
      }
      due = place + 1;
      continue;
    }
    if (!joint.source) continue;
    if (*joint.source >= n) return fmt::format("joint {} claims a point that is not there", j + 1);
    if (met == 0 && due == 0 && contour.closed && !begins_between) first = *joint.source;
    const std::size_t place = (*joint.source + n - first) % n;
    if (exact ? place != due : place < due) {
      return fmt::format("joint {} claims point {} where point {} is due", j + 1, *joint.source + 1,
                         (due + first) % n + 1);
    }
    if (!stands_on(joint.element.point, contour, *joint.source)) {
      return fmt::format("joint {} does not stand on point {}", j + 1, *joint.source + 1);
    }
    due = place + 1;
    ++met;
  }
  if (exact && met < n) return fmt::format("no joint stands on point {}", (met + first) % n + 1);
  return {};
}

}  // namespace obvid
