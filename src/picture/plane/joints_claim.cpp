// SPDX-License-Identifier: Apache-2.0
#include "obvid/picture/internal/joints_claim.h"

#include <fmt/format.h>

#include <array>

#include "obvid/core/internal/figures.h"

namespace obvid {
namespace {

/// Gaps above are named: what the bounds of certificates call continuous is a number.
constexpr double kNamedGap = 1e-9;

struct JointKind {
  int count = 0;
  const char* joints;  ///< "G2 joints"
  const char* one;     ///< "that is ..."
};

/// Joints that are no corners, the most continuous first.
std::array<JointKind, 3> joint_kinds(Carrier carrier, const Certificate& certificate) {
  const int smooth = certificate.smooth_joints();
  const bool all_step = steps_at_joints(carrier);  // also where a seam says that it does
  const int stepped = all_step ? 0 : certificate.curvature_steps;
  const int others = certificate.joints - certificate.corners - stepped - smooth;
  return {{{smooth, "G3 joints", ""},
           {others, all_step ? "G1 joints" : "G2 joints", "G2"},
           {stepped, "G1 joints with steps of the curvature", "G1 with a step of the curvature"}}};
}

/// "G3 joints between 2 corners but for 8 that are G2".
std::string counted_joints(Carrier carrier, const Certificate& certificate) {
  const int corners = certificate.corners;
  if (certificate.joints == 0) return "no joints";
  if (certificate.joints == corners) return corners == 1 ? "a corner alone" : "corners alone";
  std::string text;
  bool lesser = false;
  for (const JointKind& kind : joint_kinds(carrier, certificate)) {
    if (kind.count == 0) continue;
    if (text.empty()) {
      text = kind.joints;
      if (corners > 0) {
        text += " between " + counted(static_cast<std::size_t>(corners), "corner", "corners");
      }
      continue;
    }
    text += fmt::format("{} {} that {} {}", lesser ? " and" : " but for", kind.count,
                        kind.count == 1 ? "is" : "are", kind.one);
    lesser = true;
  }
  return text;
}

}  // namespace

std::string joints_claim(Carrier carrier, const Certificate& certificate) {
  const JointGaps& gaps = certificate.gaps;
  const bool arcs = steps_at_joints(carrier);
  std::string text = counted_joints(carrier, certificate);
  if (gaps.slope && *gaps.slope > 0.0) {
    text += fmt::format(" (the slope of curvature steps by {} of the largest beside it)",
                        significant(*gaps.slope, 2));
  }
  const double curvature = arcs ? 0.0 : gaps.curvature;
  if (gaps.heading <= kNamedGap && curvature <= kNamedGap) return text;
  text += fmt::format(" within {} rad of heading", significant(gaps.heading, 2));
  if (!arcs) text += fmt::format(" and {} of curvature", significant(gaps.curvature, 2));
  return text;
}

std::string short_bound_text(int bound) {
  return fmt::format("at least {} unless a curve winds", bound);
}

}  // namespace obvid
