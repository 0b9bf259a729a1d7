// SPDX-License-Identifier: Apache-2.0
#include "verify/curve_deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "obvid/numeric/internal/golden.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kPlacesWanted = 2000.0;   // along the first curve
constexpr std::size_t kLeastOfPiece = 4;   // places on each piece of it
constexpr std::size_t kManyPieces = 5000;  // then one on each
constexpr std::size_t kStepsOfOther = 16;  // of the other curve, between which it is looked for
constexpr std::size_t kVotes = 64;         // places that say which way the other curve runs
constexpr int kCrossingSteps = 100;
/// Times the nearest distance: a normal that meets the other curve only farther away has passed it
/// by (at a nose it runs into the inside).
constexpr double kPassedBy = 3.0;
/// Of the largest coordinate, what distances of curves that are one may be by rounding.
constexpr double kRoundedAway = 1e-12;
constexpr std::size_t kPlacesBetweenQuestions = 64;

/// Where normals of one curve meet another one.
class OtherCurve {
 public:
  explicit OtherCurve(std::span<const Piece> pieces) : pieces_(pieces) {
    for (const Piece& piece : pieces) {
      Near near;
      for (std::size_t k = 0; k <= kStepsOfOther; ++k) near.at[k] = evaluate(piece, t_of(k)).point;
      near.middle = near.at[kStepsOfOther / 2];
      double apart = 0.0;
      for (std::size_t k = 0; k <= kStepsOfOther; ++k) {
        near.reach = std::max(near.reach, norm(near.at[k] - near.middle));
        if (k > 0) apart = std::max(apart, norm(near.at[k] - near.at[k - 1]));
      }
      near.reach += apart;
      size_ = std::max(size_, norm(near.middle) + near.reach);
      near_.push_back(near);
    }
  }

  /// Whether it runs against the curve with these places.
  [[nodiscard]] bool runs_against(const std::vector<ContourPath::Place>& places) const {
    double votes = 0.0;
    for (const auto& place : places) {
      double nearest = std::numeric_limits<double>::infinity(), vote = 0.0;
      for (const Near& near : near_) {
        for (std::size_t k = 0; k < kStepsOfOther; ++k) {
          const double away = norm(near.at[k] - place.point);
          if (!(away < nearest)) continue;
          nearest = away;
          vote = dot(near.at[k + 1] - near.at[k], place.tangent) > 0.0 ? 1.0 : -1.0;
        }
      }
      votes += vote;
    }
    return votes < 0.0;
  }

  /// To the left of the tangent, signed; of several crossings in this direction the nearest, where
  /// it is not much farther than the curve itself.
  [[nodiscard]] std::optional<double> across(const ContourPath::Place& from, bool against) const {
    const Vec2 along = against ? -from.tangent : from.tangent;
    const Vec2 left = left_normal(from.tangent);
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<double> best;
    const auto offer = [&](Vec2 p) {
      const double away = dot(p - from.point, left);
      if (!best || std::abs(away) < std::abs(*best)) best = away;
    };
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const Near& near = near_[i];
      if (norm(near.middle - from.point) - near.reach < nearest) {
        for (const Vec2 p : near.at) nearest = std::min(nearest, norm(p - from.point));
      }
      if (std::abs(dot(near.middle - from.point, along)) > near.reach) continue;
      double before = dot(near.at[0] - from.point, along);
      for (std::size_t k = 1; k <= kStepsOfOther; ++k) {
        const double now = dot(near.at[k] - from.point, along);
        if (before <= 0.0 && now > 0.0) offer(crossing(i, k, from.point, along));
        before = now;
      }
    }
    if (best && std::abs(*best) > kPassedBy * nearest + kRoundedAway * size_) return std::nullopt;
    return best;
  }

 private:
  struct Near {
    std::array<Vec2, kStepsOfOther + 1> at{};
    Vec2 middle;
    double reach = 0.0;  // nothing of the piece is farther from its middle
  };
  static double t_of(std::size_t k) {
    return static_cast<double>(k) / static_cast<double>(kStepsOfOther);
  }
  [[nodiscard]] Vec2 crossing(std::size_t piece, std::size_t step, Vec2 p, Vec2 along) const {
    double a = t_of(step - 1), b = t_of(step);
    Vec2 at = near_[piece].at[step];
    for (int k = 0; k < kCrossingSteps; ++k) {
      const double middle = 0.5 * (a + b);
      if (!(middle > a && middle < b)) break;
      at = evaluate(pieces_[piece], middle).point;
      (dot(at - p, along) > 0.0 ? b : a) = middle;
    }
    return at;
  }

  std::span<const Piece> pieces_;
  std::vector<Near> near_;
  double size_ = 0.0;  // the largest coordinate, about
};

struct PlaceAlong {
  double s = 0.0, weight = 0.0;
};

/// Middles of equal parts of every piece.
std::vector<PlaceAlong> places_along(const ContourPath& path) {
  const std::size_t pieces = path.pieces().size();
  std::vector<PlaceAlong> out;
  for (std::size_t i = 0; i < pieces; ++i) {
    const double from = path.joint(i), length = path.joint(i + 1) - from;
    const double wanted = std::ceil(kPlacesWanted * length / path.length());
    const std::size_t least = pieces > kManyPieces ? 1 : kLeastOfPiece;
    const std::size_t n = std::max(least, static_cast<std::size_t>(std::max(wanted, 0.0)));
    const double step = length / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
      out.push_back({from + (static_cast<double>(k) + 0.5) * step, step});
    }
  }
  return out;
}

class Measuring {
 public:
  Measuring(const FirstCurve& first, const OtherCurve& other, const Similarity& to_other)
      : first_(first), other_(other), to_(to_other) {}

  void look_which_way(const std::vector<PlaceAlong>& places) {
    std::vector<ContourPath::Place> some;
    const std::size_t step = std::max<std::size_t>(1, places.size() / kVotes);
    for (std::size_t k = 0; k < places.size(); k += step) some.push_back(taken(places[k].s));
    against_ = other_.runs_against(some);
  }

  [[nodiscard]] DeviationPlace at(const PlaceAlong& place) const {
    DeviationPlace out;
    const ContourPath::Place here = first_.path.at(place.s);
    out.s = place.s;
    out.weight = place.weight;
    out.point = here.point;
    out.normal = first_.sign * left_normal(here.tangent);
    const auto away = other_.across(taken(place.s), against_);
    if (away) out.deviation = first_.sign * *away / to_.scale;
    if (first_.airfoil == nullptr) return out;
    const Vec2 chord = unit_at(first_.airfoil->turn);
    out.along = dot(here.point - first_.airfoil->leading_edge, chord) / first_.airfoil->chord;
    out.upper = cross(chord, out.normal) > 0.0;
    return out;
  }

  /// Around a place, by amount.
  [[nodiscard]] DeviationPlace largest_between(double a, double b) const {
    const auto amount = [&](double s) { return std::abs(at({s, 0.0}).deviation.value_or(0.0)); };
    return at({highest_place(a, b, amount), 0.0});
  }

 private:
  /// The place in the coordinates of the other curve.
  [[nodiscard]] ContourPath::Place taken(double s) const {
    ContourPath::Place out = first_.path.at(s);
    out.point = to_.point(out.point);
    out.tangent = to_.vector(out.tangent);
    return out;
  }

  const FirstCurve& first_;
  const OtherCurve& other_;
  const Similarity& to_;
  bool against_ = false;
};

}  // namespace

Result<CurveDeviation> deviation_from(const FirstCurve& first, std::span<const Piece> other,
                                      const Similarity& to_other, const RunContext& run) {
  const OtherCurve there(other);
  Measuring measuring(first, there, to_other);
  const std::vector<PlaceAlong> places = places_along(first.path);
  measuring.look_which_way(places);
  CurveDeviation out;
  double squares = 0.0, measured = 0.0, most = -1.0;
  std::size_t where = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k % kPlacesBetweenQuestions == 0) OBVID_TRY(may_go_on(run));
    out.places.push_back(measuring.at(places[k]));
    const auto& away = out.places.back().deviation;
    if (!away) continue;
    squares += *away * *away * places[k].weight;
    measured += places[k].weight;
    if (std::abs(*away) > most) most = std::abs(*away), where = k;
  }
  out.measured = std::min(measured / first.path.length(), 1.0);
  if (!(most >= 0.0)) return out;
  out.root_mean_square = std::sqrt(squares / measured);
  out.largest = out.places[where];
  const double from = places[where > 0 ? where - 1 : 0].s;
  const double to = places[std::min(where + 1, places.size() - 1)].s;
  const DeviationPlace between = measuring.largest_between(from, to);
  if (between.deviation && std::abs(*between.deviation) > most) out.largest = between;
  return out;
}

}  // namespace obvid::pipeline_detail
