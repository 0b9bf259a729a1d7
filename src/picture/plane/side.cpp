// SPDX-License-Identifier: Apache-2.0
#include "plane/side.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "plane/panels.h"

namespace obvid {
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

PictureScale common_scale(std::span<const PictureSide> sides, const ShownCurvatures& shown) {
  std::vector<const PictureTrack*> tracks;
  for (const PictureSide& side : sides) tracks.push_back(&side.track);
  return curvature_scale(tracks, shown);
}

}  // namespace obvid
