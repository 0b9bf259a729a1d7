// SPDX-License-Identifier: Apache-2.0
#include "median.h"

#include <algorithm>
#include <cmath>

#include "links.h"
#include "obvid/contour/conics.h"
#include "obvid/region/internal/arcs_over_chord.h"
#include "obvid/region/internal/segment_region.h"
#include "triangle.h"

namespace obvid {
namespace conics {

std::optional<MedianCut> median_cut(const Element& start, const Element& end) {
  const auto t = triangle_over(start, end);
  if (!t) return std::nullopt;
  const ChordFrame frame = chord_frame(start, end);
  const auto region = segment_region(frame, end.kappa > start.kappa ? 1 : -1);
  if (!region) return std::nullopt;
  const double side = -t->turning, a = std::exp(t->log_a);
  const Vec2 apex = {a * std::cos(t->phi), side * a * std::sin(t->phi)};
  const auto s0 = part_of_median(frame, region->from_start, apex);
  const auto s1 = part_of_median(frame, region->to_end, apex);
  if (!s0 || !s1) return std::nullopt;
  return MedianCut{std::min(*s0, *s1), std::max(*s0, *s1)};
}

}  // namespace conics

std::optional<double> median_weight(const Element& start, const Element& end) {
  const auto cut = conics::median_cut(start, end);
  if (!cut) return std::nullopt;
  // the conic of weight w passes the median at the part w/(1 + w)
  const double s = 0.5 * (cut->low + cut->high);
  return s / (1.0 - s);
}

std::optional<WeightRange> region_weights(const Element& start, const Element& end) {
  const auto cut = conics::median_cut(start, end);
  if (!cut) return std::nullopt;
  return WeightRange{cut->low / (1.0 - cut->low), cut->high / (1.0 - cut->high)};
}

std::optional<WeightRange> monotone_weights(const Element& start, const Element& end) {
  const auto t = conics::triangle_over(start, end);
  if (!t) return std::nullopt;
  const auto range = conics::monotone_range(*t);
  if (!(range.low < range.high)) return std::nullopt;
  return WeightRange{std::exp(range.low), std::exp(range.high)};
}

}  // namespace obvid
