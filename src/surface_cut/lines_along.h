// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface_cut/internal/trim.h"
#include "trim_patch.h"

namespace obvid {

/// Signed distance from lines, across them: > 0 on the side that stays. Keeps a reference.
class FieldBesideLines {
 public:
  explicit FieldBesideLines(const std::vector<LineAlong>& lines);

  [[nodiscard]] double value(Vec3 p) const;
  /// Across the nearest line, length 1.
  [[nodiscard]] Vec3 rise(Vec3 p) const;

 private:
  struct Foot {
    Vec3 point, across;
  };
  [[nodiscard]] Foot foot(Vec3 p) const;

  struct Sample {
    std::size_t line = 0;
    double t = 0.0;
    Vec3 point;
  };
  const std::vector<LineAlong>& lines_;
  std::vector<Sample> samples_;
};

/// The parts of the lines that lie on a part of a patch (a box of its parameters), from border to
/// border or closed; those of patches that close on themselves where they lie after whole turns.
[[nodiscard]] Result<std::vector<CutLine>> lines_on(const NurbsSurface& part,
                                                    const NurbsSurface& whole,
                                                    const CuttingField& field,
                                                    const std::vector<LineAlong>& lines);

}  // namespace obvid
