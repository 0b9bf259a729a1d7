// SPDX-License-Identifier: Apache-2.0
#include "obvid/contour/common/internal/carried_parts.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "obvid/geom/internal/angle.h"

namespace obvid::contour_detail {

Contour like(const Contour& spirals, Carrier carrier) {
  Contour out;
  out.units = spirals.units;
  out.carrier = carrier;
  out.points = spirals.points;
  return out;
}

Element element_near(const Piece& piece, double t, double theta) {
  Element e = element_at(piece, t);
  e.theta = nearest_angle(e.theta, theta);
  return e;
}

tl::unexpected<Error> at_point(Error error, const Contour& spirals, std::ptrdiff_t index,
                               const char* hint) {
  std::size_t joint = index < 0 ? 0 : static_cast<std::size_t>(index);
  while (joint > 0 && (joint >= spirals.joints.size() || !spirals.joints[joint].source)) --joint;
  error.hint = hint;
  error.index = -1;
  if (index >= 0 && joint < spirals.joints.size() && spirals.joints[joint].source) {
    error.index = static_cast<std::ptrdiff_t>(*spirals.joints[joint].source);
    error.where = "after point " + std::to_string(error.index + 1);
  }
  return fail(std::move(error));
}

const GivenDatum* given_at(const Joint& joint, const std::vector<GivenDatum>& given) {
  if (!joint.source) return nullptr;
  const auto found =
      std::lower_bound(given.begin(), given.end(), *joint.source,
                       [](const GivenDatum& one, std::size_t point) { return one.point < point; });
  return found != given.end() && found->point == *joint.source ? &*found : nullptr;
}

Carried as_they_are(const Contour& spirals, Carrier carrier) {
  Carried out{spirals, {}};
  out.contour.carrier = carrier;
  return out;
}

void add_free_pieces(const std::vector<RationalBezier>& pieces, Contour& contour) {
  double theta = contour.joints.empty() ? 0.0 : contour.joints.back().element.theta;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    contour.pieces.emplace_back(pieces[i]);
    if (i + 1 == pieces.size()) break;
    const Element e = element_near(contour.pieces.back(), 1.0, theta);
    theta = e.theta;
    contour.joints.push_back({e, std::nullopt, {}});
  }
}

Piece arc_over_chord(const LinkState& link, const Element& a, const Element& b) {
  if (a.kappa == 0.0) return LinePiece{a.point, b.point};
  const double sine = std::clamp(0.5 * a.kappa * link.h, -1.0, 1.0);
  const bool beyond_half = std::abs(link.alpha) > 0.5 * std::numbers::pi;
  const double half_turn =
      beyond_half ? std::copysign(std::numbers::pi, sine) - std::asin(sine) : std::asin(sine);
  return ArcPiece{a.point, b.point, link.omega - half_turn, a.kappa, 2.0 * half_turn / a.kappa};
}

}  // namespace obvid::contour_detail
