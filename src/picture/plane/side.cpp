// SPDX-License-Identifier: Apache-2.0
#include "plane/side.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "plane/panels.h"

namespace obvid {
namespace {

/// The axis leaves out curvatures of this part of the length when that makes it ...
constexpr double kLeftOut = 0.12;
/// ... shorter by this factor at least.
constexpr double kMuchLonger = 3.0;
/// Room beyond the curvatures that the axis shows, as part of them.
constexpr double kBeyondCurvatures = 0.3;

/// Range of the curvatures of all sides without those of the largest size on a part of the length.
PictureRange usual_range(std::span<const PictureSide> sides) {
  std::vector<std::pair<double, double>> steps;  // curvature, length
  double length = 0.0;
  for (const PictureSide& side : sides) {
    for (std::size_t j = 1; j < side.track.samples.size(); ++j) {
      const PictureSample &a = side.track.samples[j - 1], &b = side.track.samples[j];
      steps.emplace_back(b.kappa, b.s - a.s);
      length += b.s - a.s;
    }
  }
  std::sort(steps.begin(), steps.end(),
            [](const auto& a, const auto& b) { return std::fabs(a.first) < std::fabs(b.first); });
  PictureRange range;
  double travelled = 0.0;
  for (const auto& [kappa, part] : steps) {
    travelled += part;
    if (travelled > (1.0 - kLeftOut) * length) break;
    range.low = std::min(range.low, kappa);
    range.high = std::max(range.high, kappa);
  }
  return range;
}

}  // namespace

PictureSide make_picture_side(const Contour& contour, const std::string& title,
                              const Certificate* certificate) {
  PictureSide side{make_track(contour),
                   promises_monotone(contour.carrier) && contour.runs.size() <= kMostColouredRuns,
                   title};
  if (certificate != nullptr) take_counts(side.track, *certificate);
  const PictureCounts& counts = side.track.counts;
  side.caption += (title.empty() ? "" : ": ") + counted(counts.vertices, "vertex", "vertices");
  if (counts.inflections > 0) {
    side.caption += ", " + counted(counts.inflections, "inflection", "inflections");
  }
  if (counts.corners > 0) side.caption += ", " + counted(counts.corners, "corner", "corners");
  return side;
}

PictureScale common_scale(std::span<const PictureSide> sides) {
  PictureScale scale;
  for (const PictureSide& side : sides) {
    const PictureRange one = curvature_range(side.track);
    scale.range.low = std::min(scale.range.low, one.low);
    scale.range.high = std::max(scale.range.high, one.high);
  }
  const PictureRange usual = usual_range(sides);
  const double room = kBeyondCurvatures * (usual.high - usual.low);
  const PictureRange shown{std::max(scale.range.low, usual.low - room),
                           std::min(scale.range.high, usual.high + room)};
  scale.cut =
      kMuchLonger * (shown.high - shown.low) < scale.range.high - scale.range.low && room > 0.0;
  if (scale.cut) scale.range = shown;
  return scale;
}

}  // namespace obvid
