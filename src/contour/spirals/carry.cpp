// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "obvid/chain/internal/spiral_shape.h"
#include "obvid/contour/common/internal/carried_parts.h"
#include "obvid/contour/spirals.h"
#include "obvid/contour/spirals/over_chain.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/end_slopes.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {

using contour_detail::arc_over_chord;

namespace {

/// Rounding of the coordinates may blur at most this part of a piece's change of curvature, and
/// this part of its curvature (a quarter of what is called continuous); where it blurs more, the
/// piece keeps its start as origin and its offsets their own digits.
constexpr double kLargestBlurOfChange = 1e-3;
constexpr double kLargestBlurOfChangeG3 = 1e-11;  // slopes feel it some ten times as much, and are
                                                  // as small as 1e-9 at vertices
constexpr double kLargestBlur = 2.5e-10;
/// Where a piece ends straight, its largest curvature times 1e-6 takes the place of the curvature
/// there: a quarter of what is called continuous then.
constexpr double kLargestBlurWhereStraight = 2.5e-13;
/// Curvature error at an end per rounding of a control point, over the square of the end's leg.
constexpr double kCurvaturePerRounding = 8.0;

bool fits_global_coordinates(const RationalBezier& piece, double kappa_start, double kappa_end,
                             double largest_blur_of_change) {
  const Vec2 a = piece.origin + piece.offset[0], b = piece.origin + piece.offset[4];
  const double extent = std::max(std::abs(a.x) + std::abs(a.y), std::abs(b.x) + std::abs(b.y));
  const Vec2 first = piece.offset[1] - piece.offset[0], last = piece.offset[4] - piece.offset[3];
  const double leg2 = std::min(dot(first, first), dot(last, last));
  const double blur = kCurvaturePerRounding * 0x1p-53 * extent / leg2;
  const double kappa = std::max(std::abs(kappa_start), std::abs(kappa_end));
  const bool straight = kappa_start == 0.0 || kappa_end == 0.0;
  return blur <= largest_blur_of_change * std::abs(kappa_end - kappa_start) &&
         blur <= (straight ? kLargestBlurWhereStraight : kLargestBlur) * kappa;
}

RationalBezier in_global_coordinates(RationalBezier piece, Vec2 end) {
  for (int j = 0; j <= piece.degree; ++j) {
    const auto k = static_cast<std::size_t>(j);
    piece.offset[k] = piece.origin + piece.offset[k];
  }
  piece.origin = {0.0, 0.0};
  piece.offset[static_cast<std::size_t>(piece.degree)] =
      end;  // neighbours share it to the last bit
  return piece;
}

/// Element at the start of a part inside a link, its heading unwrapped between both ends'.
Element element_between(const RationalBezier& part, double theta_before, double theta_after) {
  Element e = element_at(Piece{part}, 0.0);
  const double middle = 0.5 * (theta_before + theta_after);
  e.theta = nearest_angle(e.theta, middle);
  return e;
}

/// At rest: this part of a clothoid's slope, but no less than the last bits of a weight make, and
/// no more than the form has (docs/methods/g3.md).
double resting_slope(const LinkState& link, int direction, double stored) {
  constexpr double kRestingPart = 1e-7;
  constexpr double kBitsOfWeights = 384.0 * 0x1p-53;
  const double clothoid = 6.0 * std::abs(link.sigma) / (link.h * link.h);
  const double turn = std::max(std::abs(link.alpha), std::abs(link.beta));
  const double bits = kBitsOfWeights * turn / (link.h * link.h);
  const double least = std::max(kRestingPart * clothoid, bits);
  const double now = direction * stored;
  return direction * (now > 0.0 ? std::min(now, least) : least);
}

WantedSlopes slopes_of_link(const LinkState& link, int direction, SpiralForm form,
                            const RationalBezier& piece) {
  const SpiralSlopes slopes = spiral_slopes(link, direction, form);
  const auto in_units = [&](const LinkGradient& one, bool at_start) {
    if (std::isinf(one.value)) return resting_slope(link, direction, stored_slope(piece, at_start));
    return direction * 4.0 * std::exp(one.value) / (link.h * link.h);
  };
  return {in_units(slopes.start, true), in_units(slopes.end, false)};
}

}  // namespace

Result<Contour> spirals_over(const std::vector<Vec2>& points, const SeriesChain& chain) {
  Contour contour;
  contour.points = points;
  contour.continuity = chain.smooth ? Continuity::kG3 : Continuity::kG2;
  contour.pieces.reserve(chain.links.size());
  contour.joints.reserve(chain.elements.size());
  std::vector<int> direction;
  direction.reserve(chain.links.size());
  std::vector<RationalBezier> parts;
  const double blur = chain.smooth ? kLargestBlurOfChangeG3 : kLargestBlurOfChange;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const Element& a = chain.elements[i];
    const Element& b = chain.elements[i + 1];
    contour.joints.push_back({a, chain.source[i]});
    contour.joints.back().slope_step = chain.smooth && chain.slope_step[i];
    direction.push_back(chain.direction[i]);
    if (chain.cone[i] == Cone::kNone) {
      contour.pieces.push_back(arc_over_chord(chain.links[i], a, b));
      continue;
    }
    parts.clear();
    const SpiralForm form = chain.form.empty() ? SpiralForm::kOneSided : chain.form[i];
    if (!append_spiral(chain.links[i], chain.direction[i], form, a.point, b.point, parts)) {
      return error(ErrorCode::kInternal, "a link of the chain left its cone")
          .where("piece " + std::to_string(i))
          .hint("report this series")
          .point(i)
          .value(chain.links[i].sigma);
    }
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (j > 0) {  // a piece that turns far came out in parts
        contour.joints.push_back({element_between(parts[j], a.theta, b.theta), std::nullopt});
        direction.push_back(chain.direction[i]);
      }
      const bool global = fits_global_coordinates(parts[j], a.kappa, b.kappa, blur);
      const bool last = j + 1 == parts.size();
      const Vec2 to = last ? b.point : parts[j].origin + parts[j].offset[4];
      contour.pieces.emplace_back(global ? in_global_coordinates(parts[j], to) : parts[j]);
    }
  }
  contour.joints.push_back({chain.elements.back(), chain.source.back()});
  contour.runs = collect_runs(direction);
  return contour;
}

void keep_joint_slopes(const SeriesChain& chain, Contour& contour) {
  if (!chain.smooth) return;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < chain.links.size() && piece < contour.pieces.size(); ++i) {
    const std::size_t first = piece++;
    while (piece < contour.pieces.size() &&
           !(contour.joints[piece].element.point == chain.elements[i + 1].point)) {
      ++piece;
    }
    auto* spiral = std::get_if<RationalBezier>(&contour.pieces[first]);
    if (spiral == nullptr || piece > first + 1 || chain.form[i] == SpiralForm::kOneSided) continue;
    const WantedSlopes wanted =
        slopes_of_link(chain.links[i], chain.direction[i], chain.form[i], *spiral);
    if (std::isfinite(wanted.start) && std::isfinite(wanted.end)) keep_end_slopes(*spiral, wanted);
  }
}

Result<contour_detail::Carried> contour_detail::carry_spiral(const Contour&,
                                                             const CarryOptions& options) {
  auto out = spirals_over(options.points, options.chain);
  OBVID_TRY(out);
  keep_joint_curvatures(*out);
  keep_joint_slopes(options.chain, *out);
  return Carried{std::move(*out)};
}

}  // namespace obvid
