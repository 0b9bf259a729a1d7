// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "part.h"

namespace obvid::toolpath {

/// How much a part bulges under a cutter, seen from above: over a way of length c between two
/// places where the cutter rests, it stands above their chord by at most bulge * c^2 / 8, along
/// the normal. Infinite where the part ends or has an edge under the cutter.
/// Derivation: docs/methods/toolpath.md.
class BulgeMap {
 public:
  /// `direction`: of all ways, length 1; nothing: any.
  BulgeMap(const Part& part, std::optional<Vec2> direction, std::size_t threads);

  /// For ways whose middle this is, of at most `longest()`.
  [[nodiscard]] double at(Vec2 middle) const;
  [[nodiscard]] double longest() const { return longest_; }

 private:
  void take(const Part& part, const std::vector<double>& of_triangle);
  void widen(std::size_t by);

  double longest_, size_ = 1.0;  ///< of a cell
  Vec2 low_;
  std::size_t nx_ = 1, ny_ = 1;
  std::vector<float> cells_;
};

}  // namespace obvid::toolpath
