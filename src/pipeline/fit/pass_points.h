// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// The place of each number in an order of all of them.
[[nodiscard]] std::vector<std::size_t> places_of(const std::vector<std::size_t>& order);

/// A chain with more elements on the contour that it has, near points that another contour through
/// the same elements passes too far: that one passes them as near as this one then. Headings,
/// curvatures, directions and the contour itself stay what they are.
class PassingChain {
 public:
  /// `spirals`: the contour of `chain`, piece by piece; `points`: those of the whole series, which
  /// follow one another as `order` says.
  PassingChain(const SeriesChain& chain, const Contour& spirals, const std::vector<Vec2>& points,
               const std::vector<std::size_t>& order);

  /// Puts an element where the contour passes the worst of the missed points of every link.
  /// `excess`: per point of the series, how much too far it is passed, units; 0 where it is not.
  /// False where no further element can be put.
  bool pass(const std::vector<double>& excess);
  [[nodiscard]] SeriesChain chain() const;
  /// What holds for links of the given chain, for those of `chain()`.
  [[nodiscard]] std::vector<bool> in_links(const std::vector<bool>& given) const;

 private:
  struct Place {
    std::size_t piece = 0;
    double t = 0.0;
    Element element;
  };
  bool put(std::size_t link, Vec2 p);

  const SeriesChain& chain_;
  const Contour& spirals_;
  const std::vector<Vec2>& points_;
  const std::vector<std::size_t>& order_;
  std::vector<std::size_t> place_;          ///< of each point in the order
  std::vector<std::size_t> first_piece_;    ///< of each link, and the end
  std::vector<std::vector<Place>> places_;  ///< inside each link, in order
};

}  // namespace obvid::pipeline_detail
