// SPDX-License-Identifier: Apache-2.0
#include "verify/curve_deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "obvid/curve/internal/nearest_along.h"
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

/// Arc lengths of the first curve beside which something of the other one begins or ends: its
/// joints and ends.
std::vector<double> beside_joints(const ContourPath& path, std::span<const Piece> other,
                                  const Similarity& to_other) {
  NearestAlong follower(path.pieces());
  std::vector<double> out;
  const auto add = [&](Vec2 p) {
    const NearestAlong::Place place = follower.next(to_other.back(p));
    out.push_back(path.length_at(place.piece, place.t));
  };
  for (const Piece& piece : other) add(start_point(piece));
  if (!other.empty()) add(end_point(other.back()));
  std::sort(out.begin(), out.end());
  return out;
}

/// Middles of parts of every piece, which are equal but for those that `beside` cuts in two; at
/// these and at both ends places that stand for no length.
std::vector<PlaceAlong> places_along(const ContourPath& path, const std::vector<double>& beside) {
  const std::size_t pieces = path.pieces().size();
  std::vector<PlaceAlong> out = {{0.0, 0.0}};
  auto cut = beside.begin();
  const auto add = [&](double from, double to) {
    if (to > from) out.push_back({0.5 * (from + to), to - from});
  };
  for (std::size_t i = 0; i < pieces; ++i) {
    const double start = path.joint(i), length = path.joint(i + 1) - start;
    const double wanted = std::ceil(kPlacesWanted * length / path.length());
    const std::size_t least = pieces > kManyPieces ? 1 : kLeastOfPiece;
    const std::size_t n = std::max(least, static_cast<std::size_t>(std::max(wanted, 0.0)));
    double from = start;
    for (std::size_t k = 1; k <= n; ++k) {
      const double to = start + length * static_cast<double>(k) / static_cast<double>(n);
      for (; cut != beside.end() && *cut < to; ++cut) {
        if (!(*cut > from)) continue;
        add(from, *cut);
        out.push_back({*cut, 0.0});
        from = *cut;
      }
      add(from, to);
      from = to;
    }
  }
  out.push_back({path.length(), 0.0});
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
    const auto amount_at = [&](double s) { return std::abs(at({s, 0.0}).deviation.value_or(0.0)); };
    return at({highest_place(a, b, amount_at), 0.0});
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

/// 0 where nothing is measured.
double amount(const DeviationPlace& place) { return std::abs(place.deviation.value_or(0.0)); }

}  // namespace

Result<CurveDeviation> deviation_from(const FirstCurve& first, std::span<const Piece> other,
                                      const Similarity& to_other, const RunContext& run) {
  const OtherCurve there(other);
  Measuring measuring(first, there, to_other);
  const std::vector<PlaceAlong> places =
      places_along(first.path, beside_joints(first.path, other, to_other));
  measuring.look_which_way(places);
  CurveDeviation out;
  double squares = 0.0, measured = 0.0, missed = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k % kPlacesBetweenQuestions == 0) OBVID_TRY(may_go_on(run));
    const DeviationPlace& place = out.places.emplace_back(measuring.at(places[k]));
    if (!place.deviation) {
      missed += place.weight;
      continue;
    }
    squares += *place.deviation * *place.deviation * place.weight;
    measured += place.weight;
    if (amount(place) > (out.largest ? amount(*out.largest) : -1.0)) out.largest = place;
  }
  out.measured = std::max(0.0, 1.0 - missed / first.path.length());
  if (!out.largest) return out;
  out.root_mean_square = measured > 0.0 ? std::sqrt(squares / measured) : amount(*out.largest);
  // between places: beside each that is larger than both neighbours, and may lead beyond the
  // largest of all, as far as it is above them
  const double most = amount(*out.largest);
  for (std::size_t k = 0; k < out.places.size(); ++k) {
    const std::size_t before = k > 0 ? k - 1 : k, after = std::min(k + 1, out.places.size() - 1);
    const double here = amount(out.places[k]);
    const double least = std::min(amount(out.places[before]), amount(out.places[after]));
    if (here < amount(out.places[before]) || here < amount(out.places[after])) continue;
    if (!(here > 0.0) || here + (here - least) < most) continue;
    OBVID_TRY(may_go_on(run));
    const DeviationPlace between =
        measuring.largest_between(out.places[before].s, out.places[after].s);
    if (amount(between) > amount(*out.largest)) out.largest = between;
  }
  return out;
}

}  // namespace obvid::pipeline_detail
