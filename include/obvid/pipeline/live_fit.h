// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant, an object is used by one thread at a time: docs/threads.md

#include <cstddef>
#include <optional>

#include "obvid/certify/certify.h"
#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/pipeline/fit.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// A contour that follows its points while they are dragged one by one.
///
/// A move changes a neighbourhood of the point only: headings and curvatures there are chosen
/// again, their pieces formed and everything proved. Where a neighbourhood does not do (corners
/// that appear, given data, tolerances, carriers other than `spiral`, links without a spiral) the
/// whole is formed again. Either way the contour is that of `fit` for the moved points: the same,
/// or nowhere farther from it than 1e-9 of the neighbouring chords.
class LiveFit {
 public:
  /// Errors: those of `fit`.
  [[nodiscard]] static Result<LiveFit> form(PointSeries series, const FitJob& job, Watch& watch);

  [[nodiscard]] const Contour& contour() const { return contour_; }
  [[nodiscard]] const Certificate& certificate() const { return certificate_; }
  [[nodiscard]] const PointSeries& series() const { return series_; }

  /// What a move changed.
  struct Change {
    bool whole = false;                           ///< everything was formed again
    std::size_t first_piece = 0, last_piece = 0;  ///< of the contour now
  };

  /// Moves a point of the series (counted as it was given). Errors: those of `fit`, and E203 for a
  /// point that is not there; then series and contour are as they were. The first move solves the
  /// whole once more to know its headings and curvatures.
  Result<Change> move_point(std::size_t point, Vec2 to, Watch& watch);

 private:
  /// Headings and curvatures as the solvers left them.
  struct Chains {
    SeriesChain g2;
    std::optional<SeriesChain> g3;
    bool loop = false;
  };

  LiveFit(PointSeries series, const FitJob& job, Fit fit);
  void know_chains(Watch& watch);
  Result<Change> move_whole(Watch& watch);
  std::optional<Change> move_part(std::size_t point, Watch& watch);

  PointSeries series_;
  FitJob job_;
  Contour contour_;
  Certificate certificate_;
  PieceMemory memory_;  ///< of the contour's pieces, for its proof
  std::optional<Chains> chains_;
  bool chains_known_ = false;  ///< or known not to be of use
};

}  // namespace obvid
