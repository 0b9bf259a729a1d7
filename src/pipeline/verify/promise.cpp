// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/promise.h"

#include <fmt/format.h>

#include <cmath>

#include "obvid/core/internal/figures.h"

namespace obvid {
namespace {

std::optional<Error> too_wide(const FitReport& report) {
  if (!(report.largest_width > report.tolerance)) return std::nullopt;
  return error(ErrorCode::kToleranceNotReached,
               fmt::format("the region is {} wide, the tolerance is {}",
                           significant(report.largest_width, 4), significant(report.tolerance, 4)));
}

}  // namespace

std::optional<Error> broken_promise(const Fit& made) {
  if (!keeps_promise(made.contour.carrier, made.certificate)) {
    Error out = error(ErrorCode::kNotProved,
                      "the contour was formed but not proved: " + made.certificate.reason);
    if (!made.contour.kept.empty()) {
      out.hint =
          "pieces of the drawing stay as they are drawn: --drawing points forms a contour through "
          "points of them, and convert takes the curve with its gaps";
    }
    return out;
  }
  return too_wide(made.report);
}

std::optional<Error> broken_promise(const StoredContour& stored, const Verification& found) {
  if (found.false_claim) return found.false_claim;
  if (!keeps_promise(stored.contour.carrier, found.certificate)) {
    return error(ErrorCode::kNotProved, "the contour is not proved: " + found.certificate.reason);
  }
  return stored.report ? too_wide(*stored.report) : std::nullopt;
}

std::string bound_text(int bound) { return short_bound_text(bound) + " between the points"; }

std::string vertex_bound_text(int bound) { return "curvature extrema, " + bound_text(bound); }

std::string verdict_line(Carrier carrier, const Certificate& certificate) {
  const std::string joints = joints_claim(carrier, certificate);
  if (!certificate.proved) {
    const std::string& reason = certificate.reason;
    if (keeps_promise(carrier, certificate)) {
      return fmt::format("NOT monotone, as carrier {} does not promise ({}): {}",
                         to_string(carrier), joints, reason);
    }
    return fmt::format("NOT proved: {}", reason.empty() ? "no reason recorded" : reason);
  }
  return fmt::format("proved: monotone {} on every run, {}, inside the region",
                     steps_at_joints(carrier) ? "radii" : "curvature", joints);
}

std::string gaps_text(Carrier carrier, const Certificate& certificate) {
  const JointGaps& gaps = certificate.gaps;
  std::string text = fmt::format("position {} of the size, heading {} rad",
                                 significant(gaps.position, 2), significant(gaps.heading, 2));
  if (steps_at_joints(carrier)) {
    // where the curvature is drawn to step, the verdict tells it
    if (gaps.curvature > 0.0)
      text += fmt::format("; curvature steps up to {} (arcs)", significant(gaps.curvature, 2));
  } else if (!std::isfinite(gaps.curvature)) {
    text += ", curvature unknown";
  } else {
    text += fmt::format(", curvature {} of the larger", significant(gaps.curvature, 2));
  }
  if (certificate.smooth_joints() > 0)
    text += fmt::format(", slope of curvature {}", significant(*gaps.slope, 2));
  return text;
}

}  // namespace obvid
