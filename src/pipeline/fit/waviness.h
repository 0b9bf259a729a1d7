// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "obvid/core/internal/watch.h"
#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// How often the slope of curvature, d kappa/ds, climbs and falls along a run: its total variation
/// over twice its largest size there, with a slope of zero beyond both ends; the mean over all runs
/// (docs/claims.md). 1 is the least there is: one hill in every run.
class Waviness {
 public:
  /// Work that was cancelled leaves no figure.
  explicit Waviness(Watch& watch) : watch_(watch) {}

  /// Adds the runs of the contour of a section, or of a `loop`.
  void add(const Contour& contour, bool loop);
  /// Nothing without runs along which the curvature changes, where the slope has no bound, and
  /// where rounding of the numbers could change the figure of a run by more than a thousandth.
  [[nodiscard]] std::optional<double> value() const;

 private:
  void add_run(const Contour& contour, std::size_t first, std::size_t last);

  Watch& watch_;
  double hills_ = 0.0;
  std::size_t runs_ = 0;
  bool known_ = true;
};

/// Waviness of a whole contour; nothing for carriers without monotone pieces.
[[nodiscard]] std::optional<double> waviness(const Contour& contour, Watch& watch);

}  // namespace obvid::pipeline_detail
