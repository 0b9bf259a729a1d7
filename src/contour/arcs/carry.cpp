// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "obvid/contour/arcs.h"
#include "obvid/contour/common/internal/carried_parts.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/region/internal/refine.h"

namespace obvid::contour_detail {
namespace {

/// Arcs in place of spirals, piece by piece.
class ArcBuilder {
 public:
  ArcBuilder(const Contour& spirals, double tolerance, const std::vector<GivenDatum>& given,
             bool loop)
      : spirals_(spirals), tolerance_(tolerance), loop_(loop) {
    start_given_ = curvature_given(spirals.joints.front(), given);
    end_given_ = curvature_given(spirals.joints.back(), given);
    contour_.units = spirals.units;
    contour_.carrier = Carrier::kArcs;
    contour_.points = spirals.points;
  }

  Result<Carried> run(Watch& watch) {
    const std::vector<int> directions = piece_directions(spirals_);
    for (std::size_t i = 0; i < spirals_.pieces.size(); ++i) {
      if (watch.cancelled()) return fail(cancelled_error());
      contour_.joints.push_back(spirals_.joints[i]);
      const auto* spiral = std::get_if<RationalBezier>(&spirals_.pieces[i]);
      if (spiral == nullptr) {
        contour_.pieces.push_back(spirals_.pieces[i]);
        direction_.push_back(0);
        continue;
      }
      OBVID_TRY(add(i, *spiral, directions[i]));
    }
    contour_.joints.push_back(spirals_.joints.back());
    settle_joint_curvatures();
    contour_.runs = collect_runs(direction_);
    return Carried{std::move(contour_)};
  }

 private:
  static constexpr const char* kLargerTolerance = "choose a larger --tolerance";

  /// Named by the point before the piece.
  [[nodiscard]] tl::unexpected<Error> beside(Error error, std::size_t piece,
                                             const char* hint) const {
    return at_point(std::move(error), spirals_, static_cast<std::ptrdiff_t>(piece), hint);
  }

  Result<void> add(std::size_t i, const RationalBezier& spiral, int direction) {
    const Vec2 anchor = spirals_.joints[i].element.point;
    // seen from its own start, so that arcs keep all digits of its shape
    const Piece local = moved(spiral, -anchor);
    const std::vector<double> steps = fewest_elements(local, direction, tolerance_);
    if (steps.back() < 1.0) {
      return beside(error(ErrorCode::kToleranceNotReached, "the tolerance asks for too many arcs")
                        .value(tolerance_),
                    i, kLargerTolerance);
    }
    Element from = spirals_.joints[i].element, last = spirals_.joints[i + 1].element;
    from.point = {0.0, 0.0};
    last.point = last.point - anchor;
    for (std::size_t j = 1; j < steps.size(); ++j) {
      Element to = j + 1 == steps.size() ? last : element_at(local, steps[j]);
      to.theta = nearest_angle(to.theta, from.theta);
      const bool begins = start_given_ && i == 0 && j == 1;
      const bool ends = end_given_ && i + 1 == spirals_.pieces.size() && j + 1 == steps.size();
      const auto k = choose_arcs(chord_frame(from, to), direction, begins, ends);
      if (!k) {
        return beside(error(ErrorCode::kRoundingDecides,
                            "the rounding of the coordinates decides which arcs join two elements")
                          .value(norm(to.point - from.point)),
                      i, "give coordinates relative to a nearer origin, or fewer points");
      }
      if (!add_pair(from, to, *k, anchor, direction)) {
        return beside(error(ErrorCode::kRoundingDecides,
                            "two elements of the contour are too close for arcs between them")
                          .value(norm(to.point - from.point)),
                      i, kLargerTolerance);
      }
      if (j + 1 < steps.size()) {
        contour_.joints.push_back({{to.point + anchor, to.theta, to.kappa}, std::nullopt});
      }
      from = to;
    }
    return {};
  }

  static bool curvature_given(const Joint& end, const std::vector<GivenDatum>& given) {
    return std::any_of(given.begin(), given.end(), [&](const GivenDatum& one) {
      return end.source == one.point && one.kappa.has_value();
    });
  }

  /// The arc at an end where a curvature was given takes it over: the boundary of the region, by
  /// which a curvature is still monotone.
  static std::optional<BiarcCurvatures> choose_arcs(const ChordFrame& frame, int direction,
                                                    bool begins, bool ends) {
    if (begins)
      return BiarcCurvatures{frame.kappa_start, second_curvature(frame, frame.kappa_start)};
    if (!ends) return choose_biarc(frame, direction);
    // the same from the other end: mirrored in the bisector of the chord, curvatures change places
    const ChordFrame reversed{frame.h,
                              {frame.end_tangent.x, -frame.end_tangent.y},
                              {frame.start_tangent.x, -frame.start_tangent.y},
                              frame.kappa_end,
                              frame.kappa_start};
    return BiarcCurvatures{second_curvature(reversed, frame.kappa_end), frame.kappa_end};
  }

  /// False when an arc would run backwards.
  bool add_pair(const Element& from, const Element& to, const BiarcCurvatures& k, Vec2 anchor,
                int direction) {
    const auto arcs = biarc(from, to, k);
    const auto* first = std::get_if<ArcPiece>(&arcs[0]);
    const auto* second = std::get_if<ArcPiece>(&arcs[1]);
    if ((first != nullptr && !(first->length > 0.0)) ||
        (second != nullptr && !(second->length > 0.0))) {
      return false;
    }
    const double theta = second != nullptr ? second->theta0 : to.theta;
    contour_.pieces.push_back(moved(arcs[0], anchor));
    contour_.pieces.push_back(moved(arcs[1], anchor));
    direction_.insert(direction_.end(), 2, direction);
    contour_.joints.push_back(
        {{end_point(arcs[0]) + anchor, theta, 0.5 * (k.first + k.second)}, std::nullopt});
    return true;
  }

  /// The curvature at a joint lies between those of its arcs; an end has one arc only. A vertex of
  /// the spirals is sharper than both its arcs.
  void settle_joint_curvatures() {
    const auto kappa_of = [](const Piece& piece) {
      const auto* arc = std::get_if<ArcPiece>(&piece);
      return arc != nullptr ? arc->kappa : 0.0;
    };
    const std::size_t n = contour_.pieces.size();
    for (std::size_t j = 0; j <= n; ++j) {
      const double before = kappa_of(contour_.pieces[j > 0 ? j - 1 : (loop_ ? n - 1 : 0)]);
      const double after = kappa_of(contour_.pieces[j < n ? j : (loop_ ? 0 : n - 1)]);
      double& kappa = contour_.joints[j].element.kappa;
      kappa = std::clamp(kappa, std::min(before, after), std::max(before, after));
    }
  }

  const Contour& spirals_;
  double tolerance_;
  bool loop_;  // the end is the start
  bool start_given_ = false, end_given_ = false;
  Contour contour_;
  std::vector<int> direction_;
};

}  // namespace

/// Elements on each spiral piece as far apart as the tolerance allows, two arcs between neighbours.
/// A curvature given at an end is that of its arc. Error E502 when the tolerance asks for too many
/// arcs.
Result<Carried> carry_arcs(const Contour& spirals, const CarryOptions& options) {
  return ArcBuilder(spirals, options.tolerance, options.given, options.loop).run(options.watch);
}

}  // namespace obvid::contour_detail
