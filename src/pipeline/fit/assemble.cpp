// SPDX-License-Identifier: Apache-2.0
#include "fit/assemble.h"
#include "obvid/geom/internal/angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace obvid::pipeline_detail {
namespace {

/// Pieces of a drawing that agree so far at a joint are one curve there: half of the gaps that the
/// certificate calls continuous, rad and of the larger curvature.
constexpr double kSameElement = 5e-7;

bool continues(const Element& before, const Element& after) {
  const double turn = turn_between(before.theta, after.theta);
  const double larger = std::max(std::abs(before.kappa), std::abs(after.kappa));
  return std::abs(turn) <= kSameElement &&
         std::abs(after.kappa - before.kappa) <= kSameElement * larger;
}

bool keeps_first(const Contour& contour) {
  return !contour.kept.empty() && contour.kept.front() == 0;
}
bool keeps_last(const Contour& contour) {
  return !contour.kept.empty() && contour.kept.back() + 1 == contour.pieces.size();
}

}  // namespace

void Assembly::append(Contour section) {
  if (whole_.pieces.empty()) {
    whole_ = std::move(section);
    return;
  }
  const std::size_t offset = whole_.pieces.size();
  // sections meet at corners, but pieces of a drawing also where the curve goes on
  const bool drawn = keeps_last(whole_) || keeps_first(section);
  const Element& next = section.joints.front().element;
  const bool smooth = drawn && continues(whole_.joints.back().element, next);
  if (!smooth) {
    Joint& joint = whole_.joints.back();
    joint.leaving = next;
    joint.leaving->point = joint.element.point;  // one point: sections give it to the last digit
  }
  whole_.joints.insert(whole_.joints.end(), section.joints.begin() + 1, section.joints.end());
  whole_.pieces.insert(whole_.pieces.end(), section.pieces.begin(), section.pieces.end());
  for (const Run& run : section.runs) {
    const bool first = run.first_piece == 0;
    if (first && smooth && whole_.runs.back().direction == run.direction) {
      whole_.runs.back().last_piece = run.last_piece + offset;
    } else {
      whole_.runs.push_back({run.first_piece + offset, run.last_piece + offset, run.direction});
    }
  }
  for (const std::size_t i : section.kept) whole_.kept.push_back(i + offset);
}

void Assembly::close(bool smooth) {
  whole_.closed = true;
  const Joint last = whole_.joints.back();
  whole_.joints.pop_back();
  const bool drawn = keeps_first(whole_) || keeps_last(whole_);
  if (smooth || (drawn && continues(last.element, whole_.joints.front().element))) return;
  Joint& first = whole_.joints.front();
  first.leaving = first.element;
  first.element = last.element;
  first.element.point = first.leaving->point;
}

}  // namespace obvid::pipeline_detail
