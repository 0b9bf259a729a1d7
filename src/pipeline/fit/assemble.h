// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// Joins the contours of neighbouring sections at their corners, and where pieces of a drawing begin
/// and end.
class Assembly {
 public:
  /// Appends the contour of the next section, which begins where the last one ends.
  void append(Contour section);
  /// The last joint is the first one again: of a smooth loop, or a corner.
  void close(bool smooth);
  [[nodiscard]] Contour take() { return std::move(whole_); }

 private:
  Contour whole_;
};

}  // namespace obvid::pipeline_detail
