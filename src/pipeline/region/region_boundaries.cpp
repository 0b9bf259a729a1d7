// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/region_boundaries.h"

#include <algorithm>
#include <variant>

#include "obvid/certify/certificate.h"
#include "obvid/region/internal/boundary_distance.h"

namespace obvid {

double joint_limit() { return std::max(kContinuousHeading, kContinuousCurvature); }

std::vector<Piece> boundary_in_plane(const PlacedBoundaries& placed, const Boundary& boundary) {
  const auto at = [&placed](Vec2 local) {
    return placed.start + local.x * placed.along + local.y * left_normal(placed.along);
  };
  std::vector<Piece> out;
  for (const Piece& piece : boundary_arcs(placed.frame, boundary)) {
    if (const auto* line = std::get_if<LinePiece>(&piece)) {
      out.emplace_back(LinePiece{at(line->start), at(line->end)});
      continue;
    }
    const auto& arc = std::get<ArcPiece>(piece);
    if (at(arc.start) == at(arc.end)) continue;
    out.emplace_back(ArcPiece{at(arc.start), at(arc.end), heading(placed.along) + arc.theta0,
                              arc.kappa, arc.length});
  }
  return out;
}

std::optional<RegionBoundaries> region_boundaries(const Element& start, const Element& end) {
  const Vec2 chord = end.point - start.point;
  const double length = norm(chord);
  if (!(length > 0.0)) return std::nullopt;
  const ChordFrame frame = chord_frame(start, end);
  const auto region = segment_region(frame, end.kappa < start.kappa ? -1 : 1);
  if (!region) return std::nullopt;
  const PlacedBoundaries placed{frame, *region, start.point, chord / length};
  return RegionBoundaries{boundary_in_plane(placed, region->from_start),
                          boundary_in_plane(placed, region->to_end)};
}

}  // namespace obvid
