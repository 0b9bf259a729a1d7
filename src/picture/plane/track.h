// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/core/internal/watch.h"
#include "obvid/curve/contour.h"
#include "obvid/geom/internal/box.h"

namespace obvid {

/// One sampled point of the contour, in coordinates relative to `PictureTrack::reference`.
struct PictureSample {
  Vec2 point;
  Vec2 tangent;        ///< unit vector
  double s = 0.0;      ///< arc length from the start, units
  double kappa = 0.0;  ///< 1/unit
  double t = 0.0;      ///< native parameter inside its piece
  double slope = 0.0;  ///< d kappa/ds, 1/unit^2; 0 where it has no bound
};

/// Vertex, inflection or corner.
struct PictureFeature {
  enum class Kind { kVertex, kInflection, kCorner } kind = Kind::kVertex;
  PictureSample at;
};

/// Tooth of the curvature comb.
using PictureTooth = PictureSample;

/// Features by kind.
struct PictureCounts {
  std::size_t vertices = 0;
  std::size_t inflections = 0;
  std::size_t corners = 0;
};

/// The contour sampled densely enough for a picture.
struct PictureTrack {
  Vec2 reference;                      ///< subtracted from all coordinates before any arithmetic
  std::vector<Piece> pieces;           ///< moved by -reference
  std::vector<Vec2> points;            ///< input points, moved by -reference
  std::vector<PictureSample> samples;  ///< piece after piece, both ends of each included
  std::vector<std::size_t> first;      ///< index of each piece's first sample, plus the end
  std::vector<int> direction;          ///< per piece, of its run; 2 when no run covers it
  std::vector<bool> corner;            ///< per piece, whether it starts at a corner
  bool closed = false;
  bool even_teeth = false;  ///< of the comb: also where the curvature changes fast
  bool runs_tell = true;    ///< vertices lie between runs; else wherever the samples turn back
  std::vector<PictureFeature> features;  ///< where marks go: as far as samples tell
  PictureCounts counts;                  ///< what texts say: see take_counts
  Box2 box{{}, {}};  ///< curve and points, without the comb; relative to `reference`
  double length = 0.0;
  double largest_kappa = 0.0;  ///< absolute
};

/// Direction of a piece that stands in no run.
inline constexpr int kNoRun = 2;

/// Samples the contour. Cost O(pieces). Under watch, one that was cancelled is worth nothing.
[[nodiscard]] PictureTrack make_track(const Contour& contour, Watch* watch = nullptr);

/// As many as are marked: of a track whose counts nothing else tells.
[[nodiscard]] PictureCounts counts_of_marks(const PictureTrack& track);
[[nodiscard]] std::size_t count_features(const PictureTrack& track, PictureFeature::Kind kind);

/// Texts of a picture give the counts of the certificate, not of the samples between which small
/// swings of the curvature are lost. Nothing is marked of which there is none. A
/// certificate without pieces, or with an undecided one, has not counted.
void take_counts(PictureTrack& track, const Certificate& certificate);

/// About `count` teeth, half of them even in arc length, half even in curvature change.
[[nodiscard]] std::vector<PictureTooth> comb_teeth(const PictureTrack& track, int count);

}  // namespace obvid
