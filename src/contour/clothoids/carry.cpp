// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "obvid/contour/clothoids.h"
#include "obvid/contour/common/internal/carried_parts.h"
#include "obvid/curve/internal/runs.h"

namespace obvid::contour_detail {
namespace {

tl::unexpected<Error> not_carried(const SeriesChain& chain, std::size_t link) {
  const std::size_t point = chain.source[link].value_or(chain.source[link + 1].value_or(0));
  return error(ErrorCode::kCarrierCannotKeep,
               "three clothoids do not carry the curve between two points")
      .where("point " + std::to_string(point + 1))
      .hint("use --carrier spiral")
      .point(point)
      .value(chain.links[link].sigma);
}

}  // namespace

Result<Carried> carry_clothoids(const Contour&, const CarryOptions& options) {
  const SeriesChain& chain = options.chain;
  Contour contour;
  contour.carrier = Carrier::kClothoids;
  contour.points = options.points;
  std::vector<int> direction;
  std::vector<ClothoidPiece> parts;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    if (options.watch.cancelled()) return fail(cancelled_error());
    const Element &a = chain.elements[i], &b = chain.elements[i + 1];
    contour.joints.push_back({a, chain.source[i], {}});
    direction.push_back(chain.direction[i]);
    if (chain.cone[i] == Cone::kNone) {
      contour.pieces.push_back(arc_over_chord(chain.links[i], a, b));
      continue;
    }
    parts.clear();
    if (!append_clothoids(chain.links[i], chain.direction[i], a, b, parts)) {
      return not_carried(chain, i);
    }
    for (const ClothoidPiece& part : parts) {
      if (&part != &parts.front()) {
        contour.joints.push_back({{part.start, part.theta0, part.kappa0}, std::nullopt, {}});
        direction.push_back(chain.direction[i]);
      }
      contour.pieces.emplace_back(part);
    }
  }
  contour.joints.push_back({chain.elements.back(), chain.source.back(), {}});
  contour.runs = collect_runs(direction);
  return Carried{std::move(contour)};
}

}  // namespace obvid::contour_detail
