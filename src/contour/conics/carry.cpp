// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "obvid/contour/common/internal/carried_parts.h"
#include "obvid/contour/conics.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::contour_detail {
namespace {

/// Conics to a link: headings alone leave too little freedom where neighbouring links differ much.
constexpr int kMostParts = 8;

std::vector<Element> elements_of(const std::vector<Joint>& joints) {
  std::vector<Element> out;
  for (const Joint& joint : joints) out.push_back(joint.element);
  return out;
}

/// The joints of the spirals and, on every piece, those that cut it in `parts`.
std::vector<Joint> joints_on(const Contour& spirals, int parts) {
  std::vector<Joint> out;
  for (std::size_t i = 0; i < spirals.pieces.size(); ++i) {
    out.push_back(spirals.joints[i]);
    for (int k = 1; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      out.push_back(
          {element_near(spirals.pieces[i], t, out.back().element.theta), std::nullopt, {}});
    }
  }
  out.push_back(spirals.joints.back());
  return out;
}

/// A section that goes on where it began, in the same direction.
bool smooth_loop(const Contour& spirals) {
  const Element &first = spirals.joints.front().element, &last = spirals.joints.back().element;
  constexpr double kSameHeading = 1e-9;  // rad: the bound of gaps in certificates
  return first.point == last.point &&
         std::abs(turn_between(first.theta, last.theta)) < kSameHeading;
}

/// Which elements keep their headings, and one curvature that the first weight can meet.
struct GivenToConics {
  std::vector<bool> headings;
  std::optional<std::size_t> curvature;  ///< its element
};

GivenToConics given_to_conics(const std::vector<Joint>& joints,
                              const std::vector<GivenDatum>& given) {
  GivenToConics out;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const GivenDatum* one = given_at(joints[k], given);
    out.headings.push_back(one != nullptr && one->theta.has_value());
    if (one != nullptr && one->kappa && !out.curvature) out.curvature = k;
  }
  return out;
}

/// Weights of conics, one after the other, such that the stored pieces have the same curvature on
/// both sides of each joint; the joints take it. A conic has no other freedom: its weight changes
/// both its end curvatures by one factor.
void chain_conic_weights(Contour& contour) {
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    auto* conic = std::get_if<RationalBezier>(&contour.pieces[i]);
    if (conic == nullptr || conic->degree != 2) continue;
    Element& start = contour.joints[i].element;
    const double stored = stored_curvature(*conic, true);
    const double ratio = i > 0 ? stored / start.kappa : 1.0;
    if (ratio > 0.0 && std::isfinite(ratio)) conic->weight[1] *= std::sqrt(ratio);
    if (i == 0) start.kappa = stored;
    contour.joints[i + 1].element.kappa = stored_curvature(*conic, false);
  }
}

}  // namespace

Result<Carried> carry_conics(const Contour& spirals, const CarryOptions& options) {
  const std::vector<GivenDatum>& given = options.given;
  if (only<LinePiece, ArcPiece>(spirals)) return as_they_are(spirals, Carrier::kConics);
  if (smooth_loop(spirals)) {
    return error(ErrorCode::kNoSpiral,
                 "no chain of conics is made for a closed contour without corners")
        .hint(kOtherCarriers);
  }
  Carried out{like(spirals, Carrier::kConics), {}};
  std::vector<Joint> joints = spirals.joints;
  GivenToConics kept = given_to_conics(joints, given);
  auto freed =
      headings_for_conics(elements_of(joints), {kept.headings, kept.curvature}, &options.watch);
  int parts = 1;
  while (!freed && freed.error().code == ErrorCode::kNotProved && parts < kMostParts &&
         options.watch.may_go_on()) {
    parts *= 2;
    joints = joints_on(spirals, parts);
    kept = given_to_conics(joints, given);
    freed =
        headings_for_conics(elements_of(joints), {kept.headings, kept.curvature}, &options.watch);
  }
  if (!freed && freed.error().code != ErrorCode::kNotProved) {
    return at_point(freed.error(), spirals, freed.error().index / parts, kOtherCarriers);
  }
  if (!freed) {
    out.warnings.emplace_back(
        "no headings were found for which all conics have monotone curvature; the headings are "
        "those of the spirals");
    parts = 1;
    joints = spirals.joints;
    kept = given_to_conics(joints, given);
    freed = elements_of(joints);
  }
  auto chain = conic_chain(*freed, {std::nullopt, kept.curvature});
  if (!chain) return at_point(chain.error(), spirals, chain.error().index / parts, kOtherCarriers);
  for (std::size_t k = 0; k < chain->elements.size(); ++k) {
    out.contour.joints.push_back({chain->elements[k], joints[k].source, {}});
  }
  for (const RationalBezier& piece : chain->pieces) out.contour.pieces.emplace_back(piece);
  std::vector<int> direction;
  for (const int one : piece_directions(spirals)) {
    direction.insert(direction.end(), static_cast<std::size_t>(parts), one);
  }
  out.contour.runs = collect_runs(direction);
  keep_joint_curvatures(out.contour);
  chain_conic_weights(out.contour);
  return out;
}

}  // namespace obvid::contour_detail
