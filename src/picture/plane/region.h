// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/report/stored_contour.h"
#include "plane/canvas.h"
#include "plane/track.h"
#include "plane/view.h"

namespace obvid {

/// Part of the points-only region over one chord: it lies between two circular arcs from `start`
/// to `end`, relative to `PictureTrack::reference`.
struct PictureLens {
  Vec2 start;
  Vec2 end;
  double half_turn[2] = {0.0, 0.0};  ///< of both arcs, rad, positive where they turn left
  double width = 0.0;                ///< difference of their heights over the chord, units
};

/// Lenses in which every monotone curve through the points lies, as far as the contour itself is
/// monotone over a chord and both its neighbours; none when the points cannot be analysed or are
/// too many for a lens to be seen, nor where points have tolerances or chords end at corners. With
/// a report only those that it says an error of. Cost O(points).
[[nodiscard]] std::vector<PictureLens> points_only_region(const PictureTrack& track,
                                                          const Contour& contour,
                                                          const FitReport* report = nullptr);

/// Outline of one lens, a closed subpath.
void add_lens(PicturePath& path, const PictureLens& lens, const PictureView& view);

}  // namespace obvid
