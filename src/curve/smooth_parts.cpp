// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/smooth_parts.h"

namespace obvid {
namespace {

/// Joint after piece i, without what comes behind a corner.
Joint end_joint(const Contour& contour, std::size_t i) {
  Joint joint = contour.joints[(i + 1) % contour.joints.size()];
  joint.leaving.reset();
  return joint;
}

Contour part_from(const Contour& contour, std::size_t i) {
  Contour part;
  part.units = contour.units;
  part.carrier = contour.carrier;
  Joint first = contour.joints[i];
  if (first.leaving) first.element = *first.leaving;
  first.leaving.reset();
  part.joints.push_back(first);
  return part;
}

void append(Contour& part, const Contour& next) {
  part.pieces.insert(part.pieces.end(), next.pieces.begin(), next.pieces.end());
  part.joints.insert(part.joints.end(), next.joints.begin() + 1, next.joints.end());
}

}  // namespace

std::vector<Contour> smooth_parts(const Contour& contour, bool over_seam) {
  std::vector<Contour> parts;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    if (i == 0 || contour.joints[i].leaving) parts.push_back(part_from(contour, i));
    parts.back().pieces.push_back(contour.pieces[i]);
    parts.back().joints.push_back(end_joint(contour, i));
  }
  if (parts.empty()) return parts;
  const bool smooth_seam =
      over_seam && contour.closed && !contour.joints.front().leaving;
  if (smooth_seam && parts.size() > 1) {
    append(parts.back(), parts.front());
    parts.erase(parts.begin());
  } else if (smooth_seam) {
    parts.front().closed = true;
    parts.front().joints.pop_back();
  }
  for (Contour& part : parts) {
    part.points = {start_point(part.pieces.front()), end_point(part.pieces.back())};
  }
  return parts;
}

}  // namespace obvid
