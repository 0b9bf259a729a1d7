// SPDX-License-Identifier: Apache-2.0
#include "obvid/picture/internal/joints_claim.h"

#include <fmt/format.h>

#include "obvid/core/internal/figures.h"

namespace obvid {
namespace {

/// Gaps above are named: what the bounds of certificates call continuous is a number.
constexpr double kNamedGap = 1e-9;

/// Joints that are less continuous than the others.
std::string lesser_joints(const Certificate& certificate) {
  std::string text;
  const auto add = [&text](int count, const char* what) {
    if (count == 0) return;
    text += fmt::format("{} {} that {} {}", text.empty() ? " but for" : " and", count,
                        count == 1 ? "is" : "are", what);
  };
  add(certificate.curvature_steps, "G1 with a step of the curvature");
  if (certificate.gaps.slope) add(certificate.slope_steps, "G2");
  return text;
}

}  // namespace

std::string joints_claim(Carrier carrier, const Certificate& certificate) {
  const JointGaps& gaps = certificate.gaps;
  const bool arcs = steps_at_joints(carrier);
  std::string text = arcs ? "G1 joints" : gaps.slope ? "G3 joints" : "G2 joints";
  if (certificate.corners > 0) {
    text +=
        " between " + counted(static_cast<std::size_t>(certificate.corners), "corner", "corners");
  }
  text += lesser_joints(certificate);
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

}  // namespace obvid
