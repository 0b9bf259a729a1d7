// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {
namespace {

/// The heading at the joint is raised by this part of the largest angle that keeps both halves
/// inside the closed form's cone (sigma = 0 would be its degenerate edge).
constexpr double kHeadingShare = 0.4;

/// Biarc on the chord from -1 to 1 with both curvatures known: heading and place of its joint.
struct BiarcJoint {
  double theta;
  Vec2 z;
};

BiarcJoint biarc_joint(double alpha, double beta, double k0, double k1) {
  // closing the chord: (k1 - k0) e^{i theta} = 2 i k0 k1 + k1 e^{i alpha} - k0 e^{i beta}
  const Vec2 v = Vec2{0.0, 2.0 * k0 * k1} + k1 * unit_at(alpha) - k0 * unit_at(beta);
  const double middle = 0.5 * (alpha + beta);
  const double theta = nearest_angle(heading(v), middle);
  if (std::abs(k0) >= std::abs(k1)) {
    const double half_turn = 0.5 * (theta - alpha);
    return {theta, Vec2{-1.0, 0.0} + 2.0 * std::sin(half_turn) / k0 * unit_at(alpha + half_turn)};
  }
  const double half_turn = 0.5 * (beta - theta);
  return {theta, Vec2{1.0, 0.0} - 2.0 * std::sin(half_turn) / k1 * unit_at(theta + half_turn)};
}

}  // namespace

Element free_element(const LinkState& link, int direction, Vec2 start) {
  const double d = direction;
  const double alpha = d * link.alpha, beta = d * link.beta;
  const double A = d * link.A, B = d * link.B;
  const double half = std::sin(0.5 * link.sigma), q = half * half;
  // the first arc's A may range from that of the start to -q/B; take the geometric middle
  const double A_arc = -std::sqrt(-A * q / B), B_arc = q / -A_arc;
  const double k0 = A_arc - std::sin(alpha), k1 = B_arc + std::sin(beta);
  const BiarcJoint joint = biarc_joint(alpha, beta, k0, k1);
  const double kappa = 0.5 * (k0 + k1);
  const double r0 = 0.5 * norm(joint.z - Vec2{-1.0, 0.0}),
               r1 = 0.5 * norm(Vec2{1.0, 0.0} - joint.z);
  // distances of both halves from their circles
  const double a0 = (A_arc - A) * r0, b0 = (kappa - k0) * r0;
  const double a1 = (k1 - kappa) * r1, b1 = (B - B_arc) * r1;
  const double room = std::min({std::sqrt(a0 * b0), b0, std::sqrt(a1 * b1), a1});
  const double theta = joint.theta + kHeadingShare * room;
  const Vec2 local = {joint.z.x + 1.0, d * joint.z.y};
  const Vec2 half_chord = 0.5 * link.h * unit_at(link.omega);
  return {start + complex_product(local, half_chord), link.omega + d * theta,
          d * kappa / (0.5 * link.h)};
}

namespace {

/// On the chord from -1 to 1, where the curvature grows.
struct PlacedElement {
  Vec2 z;
  double theta = 0.0, kappa = 0.0;
};

/// The curvature leaps at the start: on the second arc of the middle biarc, this many times the
/// length of the first one behind it, or half way to the end.
PlacedElement beyond_first_arc(double alpha, double beta, double A, double B, double q) {
  constexpr double kFirstArcs = 3.0;
  const double A_arc = -std::sqrt(-A * q / B), B_arc = q / -A_arc;
  const double k0 = A_arc - std::sin(alpha), k1 = B_arc + std::sin(beta);
  const BiarcJoint joint = biarc_joint(alpha, beta, k0, k1);
  const double first = std::abs((joint.theta - alpha) / k0);
  const double rest = norm(Vec2{1.0, 0.0} - joint.z);
  const double far = std::min(kFirstArcs * first, 0.5 * rest), half_turn = 0.5 * far * k1;
  const double chord = half_turn == 0.0 ? far : far * std::sin(half_turn) / half_turn;
  const Vec2 z = joint.z + chord * unit_at(joint.theta + half_turn);
  // of the chord that is left: as far from the circle here as the end is from its own
  const double share = 0.5 * norm(Vec2{1.0, 0.0} - z), room = (B - B_arc) * share;
  return {z, joint.theta + 2.0 * half_turn + kHeadingShare * room, k1 - room / share};
}

}  // namespace

Element element_beyond_leap(const LinkState& link, int direction, Vec2 start) {
  const double d = direction;
  const double alpha = d * link.alpha, beta = d * link.beta;
  const double A = d * link.A, B = d * link.B;
  const double half = std::sin(0.5 * link.sigma), q = half * half;
  PlacedElement at;
  if (-A >= B) {
    at = beyond_first_arc(alpha, beta, A, B, q);
  } else {  // the curve backwards
    at = beyond_first_arc(beta, alpha, -B, -A, q);
    at = {-1.0 * at.z, at.theta, -at.kappa};
  }
  const Vec2 half_chord = 0.5 * link.h * unit_at(link.omega);
  const Vec2 local = {at.z.x + 1.0, d * at.z.y};
  return {start + complex_product(local, half_chord), link.omega + d * at.theta,
          d * at.kappa / (0.5 * link.h)};
}

}  // namespace obvid
