// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>

#include "door.h"
#include "obvid/pipeline/internal/region_boundaries.h"

namespace obvid::capi {
namespace {

constexpr std::size_t kNumbersOfArc = 5, kMostArcs = 2;  // of a boundary

/// x, y, heading, curvature, length; what does not fit is not written.
std::size_t put_arcs(const std::vector<Piece>& pieces, double* to) {
  std::size_t count = 0;
  for (const Piece& piece : pieces) {
    if (count == kMostArcs) break;
    double* const row = to + kNumbersOfArc * count++;
    if (const auto* line = std::get_if<LinePiece>(&piece)) {
      const Vec2 along = line->end - line->start;
      row[0] = line->start.x;
      row[1] = line->start.y;
      row[2] = heading(along);
      row[3] = 0.0;
      row[4] = norm(along);
    } else if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
      row[0] = arc->start.x;
      row[1] = arc->start.y;
      row[2] = arc->theta0;
      row[3] = arc->kappa;
      row[4] = arc->length;
    }
  }
  return count;
}

Result<Element> element_of(const double* numbers) {
  for (int k = 0; k < 4; ++k) {
    if (std::isfinite(numbers[k])) continue;
    return fail({ErrorCode::kNotFinite, "an element has a number that is not finite", "", ""});
  }
  return Element{{numbers[0], numbers[1]}, numbers[2], numbers[3]};
}

}  // namespace
}  // namespace obvid::capi

using namespace obvid;
using namespace obvid::capi;

extern "C" {

double obvid_joint_limit(void) { return joint_limit(); }

int obvid_region_arcs(const double* start, const double* end, double* arcs, size_t* counts,
                      obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto first = element_of(start);
    OBVID_TRY(first);
    const auto last = element_of(end);
    OBVID_TRY(last);
    counts[0] = counts[1] = 0;
    const auto found = region_boundaries(*first, *last);
    if (!found) return {};
    counts[0] = put_arcs(found->from_start, arcs);
    counts[1] = put_arcs(found->to_end, arcs + kNumbersOfArc * counts[0]);
    return {};
  });
}
}
