// SPDX-License-Identifier: Apache-2.0
#include "leads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "offset_path.h"

namespace obvid::cutting {
namespace {

/// Quarters of circles lead in and out.
constexpr double kLeadTurn = 0.5 * std::numbers::pi;
/// Places on a lead that are looked at: of the tool's radius, how far apart.
constexpr double kApartOnLead = 0.2, kFewestOnLead = 16.0, kMostOnLead = 512.0;
constexpr double kRoundingOfRoom = 1e-9;  // of the tool's radius

}  // namespace

ArcPiece Leads::at(const Piece& piece, double place, bool in) const {
  const Jet jet = evaluate(piece, place);
  const double theta = heading(jet.d1), kappa = (waste_left_ ? 1.0 : -1.0) / radius_;
  const double length = kLeadTurn * radius_;
  const Vec2 centre = jet.point + (1.0 / kappa) * left_normal(unit_at(theta));
  const double other = theta + (in ? -1.0 : 1.0) * kappa * length;
  const Vec2 far = centre - (1.0 / kappa) * left_normal(unit_at(other));
  return in ? ArcPiece{far, jet.point, other, kappa, length}
            : ArcPiece{jet.point, far, theta, kappa, length};
}

bool Leads::has_room(const ArcPiece& lead) const {
  if (edges_.met_by(lead)) return false;
  const double wanted = std::ceil(lead.length / (kApartOnLead * tool_radius_));
  const int places = static_cast<int>(std::clamp(wanted, kFewestOnLead, kMostOnLead));
  for (int k = 0; k <= places; ++k) {
    const Vec2 p = evaluate(lead, static_cast<double>(k) / places).point;
    if (edges_.nearest(p).room < tool_radius_ * (1.0 - kRoundingOfRoom)) return false;
  }
  return true;
}

}  // namespace obvid::cutting
