// SPDX-License-Identifier: Apache-2.0
#include "joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "end_data.h"

namespace obvid {
namespace {

// Upper limits of what is called continuous, where rounding alone would not explain a gap. A
// machine tool or a CAD kernel sees nothing below them.
constexpr double kPositionBase = 1e-12;  // of the contour's size
constexpr double kHeadingBase = 1e-9;    // rad
constexpr double kCurvatureBase = 1e-9;  // of the larger curvature

// What rounding may explain at the most: beyond these nobody would call a joint continuous, and the
// coordinates must be given from a nearer origin.
constexpr double kPositionCeiling = 1e-6;   // of the contour's size
constexpr double kHeadingCeiling = 1e-4;    // rad
constexpr double kCurvatureCeiling = 1e-2;  // of the larger curvature

/// The bound of a gap: what is called continuous, or what rounding explains up to the ceiling.
double allowed(double base, double rounding, double ceiling) {
  return std::max(base, std::min(rounding, ceiling));
}

/// Curvature that counts as flat, against the contour's largest one: where a contour inflects at a
/// joint or runs into a line, "relative to the larger of the two" would divide rounding by zero.
constexpr double kFlat = 1e-6;

/// Curvatures on both sides of a corner that agree this far are the same: nothing ties them to each
/// other, and what iterations leave of two equal ones is no leap.
constexpr double kSameAtCorner = 1e-7;

/// Beyond any contour that a proof makes sense for; also stands in for NaN.
constexpr double kBroken = std::numeric_limits<double>::max();

double known(double gap) { return std::isnan(gap) ? kBroken : gap; }

double size_of_box(const Contour& contour) {
  double low_x = kBroken, low_y = kBroken, high_x = -kBroken, high_y = -kBroken;
  const auto grow = [&](Vec2 p) {
    low_x = std::min(low_x, p.x);
    low_y = std::min(low_y, p.y);
    high_x = std::max(high_x, p.x);
    high_y = std::max(high_y, p.y);
  };
  for (const Piece& piece : contour.pieces) {
    grow(start_point(piece));
    grow(end_point(piece));
    grow(evaluate(piece, 0.5).point);  // a single closed arc has no other extent
  }
  return std::hypot(high_x - low_x, high_y - low_y);
}

double heading_gap(Vec2 a, Vec2 b) { return std::abs(turning(a, b)); }

/// Walks along the contour, comparing neighbours with each other and with the joint's element.
class JointWalk {
 public:
  JointWalk(const Contour& contour, const MonotoneParts& parts)
      : contour_(contour), parts_(parts), size_(size_of_box(contour)) {
    for (const Piece& piece : contour.pieces) {
      largest_kappa_ = std::max(
          {largest_kappa_, std::abs(start_data(piece).kappa), std::abs(end_data(piece).kappa)});
    }
  }

  JointSurvey run() {
    const std::size_t n = contour_.pieces.size();
    survey_.jump.assign(n, 0);
    EndData before{};
    for (std::size_t i = 0; i < n; ++i) {
      const EndData start = start_data(contour_.pieces[i]);
      const EndData end = end_data(contour_.pieces[i]);
      if (i > 0) survey_.jump[i] = compare(i, before, start);
      // the seam is compared when the contour comes round to it
      const bool seam = i == 0 && contour_.closed;
      if (!seam && !compare_with_element(i, i > 0 ? &before : nullptr, &start)) break;
      compare_stored_ends(i);
      follow_sign(start);
      follow_parts(i);
      follow_sign(end);
      before = end;
    }
    finish(before);
    return std::move(survey_);
  }

 private:
  void finish(const EndData& last) {
    if (contour_.pieces.empty()) return;
    const std::size_t n = contour_.pieces.size();
    if (!contour_.closed) {
      compare_with_element(n, &last, nullptr);
      return;
    }
    const EndData first = start_data(contour_.pieces.front());
    survey_.jump[0] = compare(0, last, first);
    compare_with_element(0, &last, &first);
    if (first_sign_ != 0 && last_sign_ != first_sign_) ++survey_.inflections;
  }

  void check(double gap, double bound, std::size_t joint, const char* what) {
    if ((gap <= bound && gap < kBroken) || !survey_.within_bounds) return;
    survey_.within_bounds = false;
    survey_.reason =
        fmt::format("{} at joint {} is {:.3g}, its bound {:.3g}", what, joint, gap, bound);
  }

  void check_position(Vec2 a, Vec2 b, double rounding, std::size_t joint) {
    const double gap = known(norm(a - b) / size_);
    survey_.gaps.position = std::max(survey_.gaps.position, gap);
    check(gap, allowed(kPositionBase, rounding / size_, kPositionCeiling), joint,
          "the position gap");
  }

  double relative(double difference, double a, double b) const {
    const double scale = std::max({std::abs(a), std::abs(b), kFlat * largest_kappa_});
    return difference == 0.0 ? 0.0 : known(difference / scale);
  }

  /// Two neighbouring pieces; returns the sign of the curvature's jump if it is one.
  std::int8_t compare(std::size_t joint, const EndData& left, const EndData& right) {
    check_position(left.point, right.point, left.point_rounding + right.point_rounding, joint);
    const double turn = known(heading_gap(left.direction, right.direction));
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
    check(turn,
          allowed(kHeadingBase, left.heading_rounding + right.heading_rounding, kHeadingCeiling),
          joint, "the heading gap");
    const double jump = right.kappa - left.kappa;
    const double gap = relative(std::abs(jump), left.kappa, right.kappa);
    const double bound =
        allowed(kCurvatureBase,
                relative(left.kappa_rounding + right.kappa_rounding, left.kappa, right.kappa),
                kCurvatureCeiling);
    survey_.gaps.curvature = std::max(survey_.gaps.curvature, gap);
    // Arcs promise a common tangent only; their jumps are judged as changes of curvature.
    if (contour_.carrier != Carrier::kArcs) check(gap, bound, joint, "the curvature gap");
    return static_cast<std::int8_t>(gap <= bound ? 0 : (jump > 0.0 ? 1 : -1));
  }

  /// Whether the joint says something else for the piece that leaves it.
  [[nodiscard]] bool is_parted(std::size_t joint) const {
    return joint < contour_.joints.size() && contour_.joints[joint].leaving.has_value();
  }

  /// At a corner only the position is continuous, at a step of the curvature the heading too; which
  /// way the curvature leaps counts like a leap between arcs.
  [[nodiscard]] static std::int8_t parted_jump(const EndData& left, const EndData& right) {
    const double jump = right.kappa - left.kappa;
    const double rounding = left.kappa_rounding + right.kappa_rounding;
    const double same = kSameAtCorner * std::max(std::abs(left.kappa), std::abs(right.kappa));
    const bool none = std::abs(jump) <= std::max(rounding, same);
    return static_cast<std::int8_t>(none ? 0 : (jump > 0.0 ? 1 : -1));
  }

  /// The joint's own element against the ends that meet there. False where there is no element.
  bool compare_with_element(std::size_t joint, const EndData* left, const EndData* right) {
    if (joint >= contour_.joints.size()) {
      check(kBroken, 0.0, joint, "the number of joints");
      return false;
    }
    if (is_parted(joint)) {
      if (left == nullptr || right == nullptr) {
        check(kBroken, 0.0, joint, "the missing side of the joint");
        return true;
      }
      compare_end(joint, contour_.joints[joint].element, left, left);
      compare_end(joint, *contour_.joints[joint].leaving, right, right);
      return true;
    }
    compare_end(joint, contour_.joints[joint].element, left, right);
    return true;
  }

  void compare_end(std::size_t joint, const Element& element, const EndData* left,
                   const EndData* right) {
    const Vec2 direction = unit_at(element.theta);
    // Reducing an unwrapped heading costs a rounding of its own size.
    const double wrapped = kUnwrapped * std::abs(element.theta);
    for (const EndData* end : {left, right}) {
      if (end == nullptr) continue;
      check_position(end->point, element.point, end->point_rounding, joint);
      check(known(heading_gap(direction, end->direction)),
            allowed(kHeadingBase, end->heading_rounding + wrapped, kHeadingCeiling), joint,
            "the difference of headings between element and piece");
    }
    check_element_kappa(joint, element.kappa, left != nullptr ? left : right,
                        right != nullptr ? right : left);
  }

  void check_element_kappa(std::size_t joint, double kappa, const EndData* left,
                           const EndData* right) {
    const double rounding = std::max(left->kappa_rounding, right->kappa_rounding);
    double difference = std::max(std::abs(kappa - left->kappa), std::abs(kappa - right->kappa));
    if (contour_.carrier == Carrier::kArcs) {
      // Any curvature between both arcs belongs to their common point; an end has one arc only.
      const double low = std::min(left->kappa, right->kappa);
      const double high = std::max(left->kappa, right->kappa);
      difference = std::isnan(kappa) ? kappa : std::max({0.0, low - kappa, kappa - high});
    }
    const double gap = relative(known(difference), left->kappa, right->kappa);
    check(gap,
          allowed(kCurvatureBase, relative(rounding, left->kappa, right->kappa), kCurvatureCeiling),
          joint, "the difference of curvatures between element and piece");
  }

  /// The stored end of an arc or clothoid is a number of its own, beside the end it leads to.
  void compare_stored_ends(std::size_t i) {
    const Piece& piece = contour_.pieces[i];
    if (!std::holds_alternative<ArcPiece>(piece) && !std::holds_alternative<ClothoidPiece>(piece)) {
      return;
    }
    const EndData end = end_data(piece);
    check_position(end.point, end_point(piece), end.point_rounding, i + 1);
  }

  void follow_parts(std::size_t i) {
    const auto parts = parts_.find(i);
    if (parts == parts_.end()) return;
    for (const MonotonePart& part : parts->second) follow_sign(end_data(Piece{part.piece}));
  }

  /// Curvature is monotone on each proved piece, so signs at the ends tell all its sign changes.
  void follow_sign(const EndData& end) {
    const int sign =
        end.kappa > end.kappa_rounding ? 1 : (end.kappa < -end.kappa_rounding ? -1 : 0);
    if (sign == 0) return;
    if (last_sign_ != 0 && sign != last_sign_) ++survey_.inflections;
    if (first_sign_ == 0) first_sign_ = sign;
    last_sign_ = sign;
  }

  static constexpr double kUnwrapped = 0x1p-52;

  const Contour& contour_;
  const MonotoneParts& parts_;
  double size_;
  double largest_kappa_ = 0.0;
  int first_sign_ = 0;
  int last_sign_ = 0;
  JointSurvey survey_;
};

}  // namespace

JointSurvey survey_joints(const Contour& contour, const MonotoneParts& parts) {
  return JointWalk(contour, parts).run();
}

std::string missed_point(const Contour& contour) {
  const std::size_t n = contour.points.size();
  const bool exact = contour.point_tolerance.empty();
  std::size_t met = 0, first = 0, due = 0;  // due: counted from the first source on
  for (std::size_t j = 0; j < contour.joints.size(); ++j) {
    const Joint& joint = contour.joints[j];
    if (!joint.source) continue;
    if (*joint.source >= n) return fmt::format("joint {} claims a point that is not there", j);
    if (met == 0 && contour.closed) first = *joint.source;
    const std::size_t place = (*joint.source + n - first) % n;
    if (exact ? place != due : place < due) {
      return fmt::format("joint {} claims point {} where point {} is due", j, *joint.source,
                         (due + first) % n);
    }
    if (exact && !(joint.element.point == contour.points[*joint.source])) {
      return fmt::format("joint {} does not stand on point {}", j, *joint.source);
    }
    due = place + 1;
    ++met;
  }
  if (exact && met < n) return fmt::format("no joint stands on point {}", (met + first) % n);
  return {};
}

}  // namespace obvid
