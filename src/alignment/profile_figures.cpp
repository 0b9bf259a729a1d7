// SPDX-License-Identifier: Apache-2.0
#include "obvid/alignment/internal/profile_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/figures.h"

namespace obvid {
namespace {

/// Of a radius: what another program's digits of grades and lengths may leave.
constexpr double kSameRadius = 1e-6;
constexpr double kGradeRounding = 4.0 * 0x1p-52;  ///< of grades: what their difference is known to
/// Of the numbers themselves: stations and heights that differ by more do not meet.
constexpr double kMeeting = 1e-9;

Error contradicted(std::size_t element, const char* field, const std::string& claimed,
                   const std::string& found) {
  return error(ErrorCode::kFalseClaim,
               fmt::format("the file claims {} = {} of an element of the profile, its grades and "
                           "its length say {}",
                           field, claimed, found))
      .where(fmt::format("elements/{}/{}", element, field))
      .hint("make the profile again");
}

std::optional<Error> contradiction_in(const ProfileElement& e, std::size_t k,
                                      ProfileCurves curves) {
  const ProfileKind kind = kind_between(e.grade0, e.grade1);
  if (e.kind != kind) {
    return contradicted(k, "kind", std::string(name_of(e.kind)), std::string(name_of(kind)));
  }
  double radius = 0.0, rounded = 0.0;
  if (kind != ProfileKind::kGrade) {
    radius = radius_between(e.grade0, e.grade1, e.length, curves);
    rounded =
        kGradeRounding * (std::abs(e.grade0) + std::abs(e.grade1)) / std::abs(e.grade1 - e.grade0);
  }
  if (std::abs(e.radius - radius) <= (kSameRadius + rounded) * std::abs(radius)) {
    return std::nullopt;
  }
  return contradicted(k, "radius", fmt::format("{:.9g}", e.radius), fmt::format("{:.9g}", radius));
}

}  // namespace

ProfileKind kind_between(double grade0, double grade1) {
  if (grade0 == grade1) return ProfileKind::kGrade;
  return grade1 > grade0 ? ProfileKind::kSag : ProfileKind::kCrest;
}

double end_height(const ProfileElement& e, ProfileCurves curves) {
  // chord of an arc: half way between its ends' slopes; of a parabola: between its grades
  const double grade = curves == ProfileCurves::kArcs
                           ? std::tan(0.5 * (std::atan(e.grade0) + std::atan(e.grade1)))
                           : 0.5 * (e.grade0 + e.grade1);
  return e.height + grade * e.length;
}

double radius_between(double grade0, double grade1, double length, ProfileCurves curves) {
  if (curves == ProfileCurves::kParabolas) return length / (grade1 - grade0);
  // sin(a1) - sin(a0) without cancellation
  const double turn = std::atan2(grade1 - grade0, 1.0 + grade0 * grade1);
  const double middle = std::atan(grade0) + 0.5 * turn;
  return 0.5 * length / (std::cos(middle) * std::sin(0.5 * turn));
}

std::optional<Error> contradiction_in(const VerticalProfile& profile) {
  for (std::size_t k = 0; k < profile.elements.size(); ++k) {
    if (auto wrong = contradiction_in(profile.elements[k], k, profile.curves)) return wrong;
  }
  return std::nullopt;
}

std::vector<std::string> loose_figures(const VerticalProfile& profile) {
  const std::vector<ProfileElement>& all = profile.elements;
  double stations = 0.0, heights = 0.0, far = 0.0, high = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool last = k + 1 == all.size();
    const double station = last ? profile.end_station : all[k + 1].station;
    const double height = last ? profile.end_height : all[k + 1].height;
    stations = std::max(stations, std::abs(all[k].station + all[k].length - station));
    heights = std::max(heights, std::abs(end_height(all[k], profile.curves) - height));
    far = std::max({far, std::abs(all[k].station), std::abs(station)});
    high = std::max({high, std::abs(all[k].height), std::abs(height), all[k].length});
  }
  std::vector<std::string> out;
  const auto add = [&](const char* field, const char* what, double within) {
    out.push_back(
        fmt::format("{} (only that {} meet within {})", field, what, significant_above(within, 2)));
  };
  if (stations > kMeeting * far) {
    for (const char* field : {"elements/*/station", "elements/*/length", "end_station"}) {
      add(field, "stations", stations);
    }
  }
  if (heights > kMeeting * high) {
    for (const char* field :
         {"elements/*/height", "elements/*/grade_start", "elements/*/grade_end", "end_height"}) {
      add(field, "heights", heights);
    }
  }
  const bool straight = std::all_of(all.begin(), all.end(), [](const ProfileElement& e) {
    return e.kind == ProfileKind::kGrade;
  });
  if (straight) out.emplace_back("curves (it has none)");
  return out;
}

}  // namespace obvid
