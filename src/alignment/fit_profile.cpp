// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "found_chain.h"
#include "obvid/alignment/internal/borne_grades.h"
#include "obvid/alignment/profile.h"

namespace obvid {
namespace alignment {
namespace {

ProfileKind profile_kind(double kappa) {
  if (kappa == 0.0) return ProfileKind::kGrade;
  return kappa < 0.0 ? ProfileKind::kCrest : ProfileKind::kSag;
}

VerticalProfile profile_of(const FoundChain& found, ProfileCurves curves,
                           const std::vector<double>& tolerance) {
  VerticalProfile out;
  out.curves = curves;
  const bool arcs = curves == ProfileCurves::kArcs;
  const std::vector<Element> joints = found.chain.joints();
  const auto grade_of = [&](double theta) { return arcs ? std::tan(theta) : theta; };
  for (std::size_t k = 0; k < found.chain.size(); ++k) {
    const double kappa = found.chain.curvature(k, 0);
    const Vec2 start = joints[k].point + found.origin;
    ProfileElement e;
    e.kind = profile_kind(kappa);
    e.station = start.x;
    e.length = joints[k + 1].point.x - joints[k].point.x;
    e.height = start.y;
    e.grade0 = grade_of(joints[k].theta);
    e.grade1 = grade_of(joints[k + 1].theta);
    e.radius = kappa == 0.0 ? 0.0 : 1.0 / kappa;
    out.elements.push_back(e);
  }
  const Vec2 end = joints.back().point + found.origin;
  out.end_station = end.x;
  out.end_height = end.y;
  double squares = 0.0;
  for (std::size_t i = 0; i < found.feet.size(); ++i) {
    const double offset = found.feet[i].offset;
    out.offsets.push_back(offset);
    out.largest_share = std::max(out.largest_share, std::abs(offset) / tolerance[i]);
    squares += offset * offset;
  }
  out.rms = std::sqrt(squares / static_cast<double>(found.feet.size()));
  return out;
}

/// The search keeps the least length to first order, the fit where it begins within it.
Result<void> keeps_length(const VerticalProfile& found, const Chain& chain, double least) {
  constexpr double kLimitRounding = 1e-9;  // of the limit
  for (const ProfileElement& e : found.elements) {
    if (e.length > 0.0 && std::isfinite(e.grade1)) continue;
    return error(ErrorCode::kToleranceNotReached, "an arc of the profile was found upright")
        .hint("take parabolas, or allow a smaller tolerance")
        .value(e.station);
  }
  if (chain.size() == 1) return {};
  for (std::size_t k = 0; k < chain.size(); ++k) {
    if (chain.length[k] >= (1.0 - kLimitRounding) * least) continue;
    return error(ErrorCode::kToleranceNotReached,
                 "an element of the profile was found with a smaller length only")
        .hint("allow a larger tolerance, or shorter elements")
        .value(found.elements[k].length);
  }
  return {};
}

/// Curvatures of an arc are the same; here by what the sine of the angle changes on the way.
ProfilePlace on_element(const ProfileElement& e, ProfileCurves curves, double along) {
  if (e.kind == ProfileKind::kGrade) return {e.height + e.grade0 * along, e.grade0};
  if (curves == ProfileCurves::kParabolas) {
    const double grade = e.grade0 + along / e.radius;
    return {e.height + 0.5 * (e.grade0 + grade) * along, grade};
  }
  const double theta0 = std::atan(e.grade0);
  const double sine = std::sin(theta0) + along / e.radius;
  const double theta = std::asin(std::clamp(sine, -1.0, 1.0));
  // the chord of an arc has the mean direction of its ends
  return {e.height + along * std::tan(0.5 * (theta0 + theta)), std::tan(theta)};
}

/// The same from the first height's station to that of the last one: the search begins and ends at
/// the feet of both, which of arcs lie across the profile, and of parabolas there but for rounding.
void begin_and_end_at(VerticalProfile& profile, double from, double to) {
  ProfileElement& first = profile.elements.front();
  const double before = from - first.station;
  if (before < first.length) {
    const ProfilePlace start = on_element(first, profile.curves, before);
    first.station = from;
    first.length -= before;
    first.height = start.height;
    first.grade0 = start.grade;
  }
  ProfileElement& last = profile.elements.back();
  if (!(to > last.station)) return;
  last.length = to - last.station;
  const ProfilePlace end = on_element(last, profile.curves, last.length);
  last.grade1 = end.grade;
  profile.end_station = to;
  profile.end_height = end.height;
}

/// The same loop from another station on. What passes it is cut there.
VerticalProfile begun_at(const VerticalProfile& profile, double begin, double lap) {
  constexpr double kAtJoint = 1e-9;  // of a lap
  VerticalProfile out = profile;
  out.elements.clear();
  const double laps = std::floor((begin - profile.elements.front().station) / lap);
  std::vector<ProfileElement> behind;
  for (ProfileElement e : profile.elements) {
    e.station += laps * lap;
    const double along = begin - e.station;
    if (along <= kAtJoint * lap) {
      out.elements.push_back(e);
      continue;
    }
    if (along < e.length - kAtJoint * lap) {
      const ProfilePlace place = on_element(e, profile.curves, along);
      ProfileElement rest = e;
      rest.station = begin;
      rest.length = e.length - along;
      rest.height = place.height;
      rest.grade0 = place.grade;
      out.elements.push_back(rest);
      e.length = along;
      e.grade1 = place.grade;
    }
    e.station += lap;
    behind.push_back(e);
  }
  out.elements.insert(out.elements.end(), behind.begin(), behind.end());
  out.end_station = out.elements.front().station + lap;
  out.end_height = out.elements.front().height;
  return out;
}

struct Candidate {
  VerticalProfile profile;
  std::size_t humps = 0;

  /// The least is the best.
  [[nodiscard]] std::pair<std::size_t, std::size_t> rank() const {
    return {humps, profile.elements.size()};
  }
};

Result<Candidate> candidate(const std::vector<Vec2>& points, const std::vector<double>& tolerance,
                            const AlignmentOptions& limits, const Sought& sought,
                            const ProfileOptions& options, const RunContext& run) {
  const auto found = find_chain(points, tolerance, limits, sought, run);
  OBVID_TRY(found);
  Candidate out;
  out.profile = profile_of(*found, options.curves, tolerance);
  OBVID_TRY(keeps_length(out.profile, found->chain, options.least_length));
  out.humps = unborne_grades(out.profile, BorneGrades(points, tolerance, options.lap)).size();
  return out;
}

Result<void> check_stations(const std::vector<Vec2>& points, const ProfileOptions& options) {
  if (!(options.lap >= 0.0 && std::isfinite(options.lap) && std::isfinite(options.begin))) {
    return error(ErrorCode::kBadOption, "the lap of a profile must be 0 or more")
        .value(options.lap);
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i].x > points[i - 1].x)) {
      return error(ErrorCode::kChordReversal, "stations of heights must ascend")
          .point(static_cast<std::ptrdiff_t>(i))
          .value(points[i].x);
    }
    if (options.lap > 0.0 && !(points[i].x - points[0].x < options.lap)) {
      return error(ErrorCode::kChordReversal, "heights go around the loop more than once")
          .point(static_cast<std::ptrdiff_t>(i))
          .hint("give those of one lap")
          .value(points[i].x);
    }
  }
  return {};
}

}  // namespace
}  // namespace alignment

Result<VerticalProfile> fit_profile(const std::vector<Vec2>& points,
                                    const std::vector<double>& tolerance,
                                    const ProfileOptions& options, const RunContext& run) {
  OBVID_TRY(alignment::check_stations(points, options));
  AlignmentOptions limits;
  limits.least_length = options.least_length;
  limits.closed = options.lap > 0.0;
  const bool arcs = options.curves == ProfileCurves::kArcs;
  alignment::Sought sought{
      arcs ? alignment::Plane::kMap : alignment::Plane::kGraph, true, {options.lap, 0.0}, true};
  std::optional<alignment::Candidate> best;
  std::optional<Error> refused;
  // with corners, without, and at last what there always is: grades from height to height
  for (const auto& [corners, rounded] :
       {std::pair{true, false}, std::pair{false, false}, std::pair{true, true}}) {
    sought.corners = corners;
    sought.rounded = rounded;
    auto found = alignment::candidate(points, tolerance, limits, sought, options, run);
    if (!found) {
      if (found.error().code == ErrorCode::kCancelled) return fail(found.error());
      if (!rounded) refused = found.error();
      continue;
    }
    if (!best || found->rank() < best->rank()) best = std::move(*found);
    if (best->humps == 0) break;
  }
  if (!best) return fail(*refused);
  VerticalProfile& out = best->profile;
  if (limits.closed) return alignment::begun_at(out, options.begin, options.lap);
  alignment::begin_and_end_at(out, points.front().x, points.back().x);
  return std::move(out);
}

ProfilePlace profile_at(const VerticalProfile& profile, double station) {
  const auto& all = profile.elements;
  const auto& first = all.front();
  if (station < first.station) {
    return {first.height + first.grade0 * (station - first.station), first.grade0};
  }
  if (station > profile.end_station) {
    const double grade = all.back().grade1;
    return {profile.end_height + grade * (station - profile.end_station), grade};
  }
  const auto next =
      std::upper_bound(all.begin(), all.end(), station,
                       [](double s, const ProfileElement& e) { return s < e.station; });
  const ProfileElement& e = *std::prev(next);
  return alignment::on_element(e, profile.curves, station - e.station);
}

Vec2 grades_meet(const ProfileElement& e, ProfileCurves curves) {
  double along = 0.5 * e.length;
  if (e.kind != ProfileKind::kGrade && curves == ProfileCurves::kArcs) {
    // both tangents are as long
    const double c0 = std::hypot(1.0, e.grade0), c1 = std::hypot(1.0, e.grade1);
    along = e.length * c1 / (c0 + c1);
  }
  return {e.station + along, e.height + along * e.grade0};
}

}  // namespace obvid
