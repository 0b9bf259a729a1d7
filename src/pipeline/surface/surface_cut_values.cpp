// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "obvid/core/internal/typed_numbers.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/surface_values.h"
#include "obvid/pipeline/surface_cut_job.h"

namespace obvid {
namespace {

constexpr double kMostSections = 10'000.0;

Result<void> set_places(const std::optional<std::string>& typed, const char* option,
                        PlacesAcross& places) {
  if (!typed) return {};
  const std::string_view text = *typed;
  constexpr std::string_view kEvery = "every:", kCount = "count:";
  if (text.substr(0, kEvery.size()) == kEvery) {
    places.every = typed_number(text.substr(kEvery.size()));
    if (places.every && *places.every > 0.0 && std::isfinite(*places.every)) return {};
  } else if (text.substr(0, kCount.size()) == kCount) {
    const auto count = typed_number(text.substr(kCount.size()));
    if (count && *count >= 1.0 && *count <= kMostSections && std::floor(*count) == *count) {
      places.count = static_cast<std::size_t>(*count);
      return {};
    }
  } else if (auto numbers = typed_numbers(text)) {
    places.at = std::move(*numbers);
    return {};
  }
  return fail(bad_option("'" + *typed + "' says no places", option,
                         "give places as 1,2.5, a distance as every:0.5, or a number as count:20"));
}

Result<void> positive_length(const std::optional<double>& value, const char* option) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return {};
  return fail(bad_option("the value must be greater than 0", option, ""));
}

}  // namespace

Result<CutPlane> plane_of(const std::string& typed, const char* option) {
  const auto numbers = typed_numbers(typed);
  const auto bad = [&](const char* why) {
    return fail(bad_option("'" + typed + "' " + why, option,
                           "give NX,NY,NZ,D: all points with NX x + NY y + NZ z = D"));
  };
  if (!numbers || numbers->size() != 4) return bad("is no plane");
  const Vec3 normal{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  const double length = std::hypot(normal.x, normal.y, normal.z);
  if (!(length > 0.0 && std::isfinite(length))) return bad("has no normal");
  return CutPlane{unit(normal / length), (*numbers)[3] / length};
}

Result<void> set_surface_cut(const SurfaceCutValues& typed, SurfaceCutJob& job) {
  for (const std::string& text : typed.planes) {
    const auto plane = plane_of(text, "--plane");
    OBVID_TRY(plane);
    job.planes.push_back(*plane);
  }
  OBVID_TRY(set_places(typed.stations, "--stations", job.stations));
  OBVID_TRY(set_places(typed.waterlines, "--waterlines", job.waterlines));
  OBVID_TRY(set_places(typed.buttocks, "--buttocks", job.buttocks));
  OBVID_TRY(positive_length(typed.tolerance, "--tolerance"));
  OBVID_TRY(positive_length(typed.fair, "--fair"));
  OBVID_TRY(positive_length(typed.density, "--density"));
  if (typed.draught && !std::isfinite(*typed.draught)) {
    return fail(bad_option("the waterplane lies at no finite height", "--draught", ""));
  }
  if ((typed.density || typed.half) && !typed.draught) {
    return fail(bad_option("--density and --half belong to --draught", "",
                           "give the height z of the waterplane"));
  }
  job.draught = typed.draught;
  job.density = typed.density;
  job.half = typed.half;
  job.tolerance = typed.tolerance;
  job.fair = typed.fair;
  return {};
}

}  // namespace obvid
