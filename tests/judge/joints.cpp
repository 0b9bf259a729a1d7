// SPDX-License-Identifier: Apache-2.0
#include "joints.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "real_curve.h"

namespace judge {
namespace {

/// Curvature gaps are told of this part of the largest curvature at the four ends, at the least.
constexpr double kFlat = 1e-6;
/// Jumps below this, told like gaps, may be rounding.
constexpr double kClearJump = 1e-6;

struct Box {
  double low_x = std::numeric_limits<double>::max(), low_y = low_x;
  double high_x = -low_x, high_y = -low_x;

  void grow(double x, double y) {
    low_x = std::min(low_x, x);
    low_y = std::min(low_y, y);
    high_x = std::max(high_x, x);
    high_y = std::max(high_y, y);
  }
  [[nodiscard]] double diagonal() const { return std::hypot(high_x - low_x, high_y - low_y); }
  [[nodiscard]] double coordinate() const {
    return std::max({std::abs(low_x), std::abs(low_y), std::abs(high_x), std::abs(high_y)});
  }
};

/// At the ends of a piece, and the mean over its chord.
Ball largest_slope(const ContourEnds& ends, std::size_t piece) {
  const End &a = ends.start[piece], &b = ends.end[piece];
  const Ball at_ends = larger(abs(a.slope), abs(b.slope));
  const Ball chord = norm(b.point - a.point);
  return chord.sign() == 1 ? larger(at_ends, abs(b.kappa - a.kappa) / chord) : at_ends;
}

JointFacts between(const ContourFile& contour, const ContourEnds& ends, std::size_t left,
                   std::size_t right) {
  const End &a = ends.end[left], &b = ends.start[right];
  JointFacts out;
  out.corner = contour.corner_at(right);
  out.step = contour.parted_at(right) && !out.corner;
  out.position = norm(b.point - a.point);
  const Ball jump = b.kappa - a.kappa;
  Ball larger_kappa = larger(abs(a.kappa), abs(b.kappa));
  Ball four = larger(larger_kappa, larger(abs(ends.start[left].kappa), abs(ends.end[right].kappa)));
  out.jump = jump.sign() == 2 ? 0 : jump.sign();
  const Ball scale = larger(larger_kappa, Ball(kFlat) * four);
  out.clear_jump = (abs(jump) - Ball(kClearJump) * scale).sign() == 1;
  if (out.corner) return out;
  out.heading = abs(angle_between(a.tangent, b.tangent));
  if (out.step) return out;
  if (jump.sign() != 0 && scale.sign() == 1) out.curvature = abs(jump) / scale;
  out.slope_step = contour.slope_step_at(right);
  const Ball largest = larger(largest_slope(ends, left), largest_slope(ends, right));
  if (!out.slope_step && largest.sign() == 1) out.slope = abs(b.slope - a.slope) / largest;
  return out;
}

int order_of(const ContourFile& contour, const JointFacts& joint) {
  if (joint.heading.lower() > kAngleBound) return 0;
  if (contour.carrier == "arcs" || joint.curvature.lower() > kCurvatureBound) return 1;
  const bool slopes = contour.continuity == "G3" && !joint.slope_step;
  return slopes && joint.slope.lower() <= kSlopeBound ? 3 : 2;
}

}  // namespace

JointOrders orders_of(const ContourFile& contour, const std::vector<JointFacts>& joints) {
  JointOrders out;
  for (std::size_t j = contour.closed ? 0 : 1; j < joints.size(); ++j) {
    const JointFacts& joint = joints[j];
    int* const of_order[] = {&out.corners, &out.g1, &out.g2, &out.g3};
    ++*(joint.corner ? &out.corners : joint.step ? &out.steps : of_order[order_of(contour, joint)]);
  }
  return out;
}

ContourEnds ends_of(const ContourFile& contour) {
  ContourEnds out;
  Box box;
  for (const Point p : contour.points) box.grow(p.x, p.y);
  for (const Piece& piece : contour.pieces) {
    out.start.push_back(start_of(piece));
    out.end.push_back(end_of(piece));
    const Span span(piece, {});
    constexpr int kPlaces = 8;
    Vec before = span.point(0.0L);
    for (int k = 0; k <= kPlaces; ++k) {
      const Vec p = span.point(static_cast<Real>(k) / kPlaces);
      box.grow(static_cast<double>(p.x), static_cast<double>(p.y));
      out.length += static_cast<double>(norm(p - before));
      before = p;
    }
  }
  out.size = box.diagonal();
  out.coordinate = box.coordinate();
  return out;
}

std::vector<JointFacts> joints_of(const ContourFile& contour, const ContourEnds& ends) {
  std::vector<JointFacts> out(contour.pieces.size());
  if (contour.pieces.empty()) return out;
  const std::size_t last = contour.pieces.size() - 1;
  for (std::size_t i = 1; i <= last; ++i) out[i] = between(contour, ends, i - 1, i);
  if (contour.closed) out[0] = between(contour, ends, last, 0);
  return out;
}

}  // namespace judge
