// SPDX-License-Identifier: Apache-2.0
#include "geo/projection_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "obvid/core/units.h"
#include "obvid/io/internal/repeated_heights.h"

namespace obvid::exchange {
namespace {

constexpr double kScaleWorthSaying =
    1e-3;                              // of a length: scale of the plane that users must know of
constexpr double kMostDistance = 3e6;  // m from the middle meridian: the series is good so far
constexpr double kMetresPerDegree = 6371e3 * kOneDegree;  // for the rounding only

/// Middle of the smallest box around all places, seen from the first one.
GeoPoint middle_of_places(const std::vector<GeoSeries>& all) {
  const double reference = all.front().places.front().longitude;
  double west = 0.0, east = 0.0, south = 90.0, north = -90.0;
  for (const GeoSeries& series : all) {
    for (const GeoPoint& place : series.places) {
      const double longitude = longitude_from(reference, place.longitude);
      west = std::min(west, longitude);
      east = std::max(east, longitude);
      south = std::min(south, place.latitude);
      north = std::max(north, place.latitude);
    }
  }
  return {longitude_from(0.0, reference + 0.5 * (west + east)), 0.5 * (south + north)};
}

/// Heights of the points that are kept; a place that repeats may have another one.
void take_heights(const GeoSeries& series, const std::vector<Vec2>& points, PointSeries& out) {
  RepeatedHeights repeated;
  for (std::size_t i = 0; i < series.heights.size(); ++i) {
    if (i > 0 && points[i] == points[i - 1]) {
      repeated.add(*out.fixed.back().height, series.heights[i]);
      continue;
    }
    out.fixed.push_back({});
    out.fixed.back().height = series.heights[i];
  }
  repeated.warn("m", out.warnings);
}

PointSeries projected(GeoSeries series, const LocalProjection& projection) {
  LastDigit longitude, latitude;
  std::vector<Vec2> points;
  points.reserve(series.places.size());
  for (const GeoPoint& place : series.places) {
    points.push_back(projection.to_plane(place));
    longitude.add(place.longitude);
    latitude.add(place.latitude);
  }
  PointSeries out = plane_series(std::move(series.name), "m", points);
  take_heights(series, points, out);
  const double narrow = std::cos(projection.centre().latitude * kOneDegree) * kMetresPerDegree;
  out.rounding = {narrow * longitude.half_unit(), kMetresPerDegree * latitude.half_unit()};
  out.kind = series.kind;
  out.warnings.insert(out.warnings.begin(), series.warnings.begin(), series.warnings.end());
  return out;
}

/// Names of the series without two distinct points.
void drop_single_places(std::vector<GeoSeries>& all, std::vector<std::string>& warnings) {
  const auto single = [](const GeoSeries& series) {
    return std::all_of(series.places.begin(), series.places.end(), [&](const GeoPoint& place) {
      return place.longitude == series.places.front().longitude &&
             place.latitude == series.places.front().latitude;
    });
  };
  const auto first =
      std::stable_partition(all.begin(), all.end(), [&](const GeoSeries& s) { return !single(s); });
  if (first == all.end()) return;
  warnings.push_back(fmt::format("{} series without two different places left out, first {}",
                                 all.end() - first, first->name));
  all.erase(first, all.end());
}

}  // namespace

void LastDigit::add(double value) {
  constexpr int kMostCoordinateDigits = 17;
  const std::string text = fmt::format("{}", value);
  const std::size_t exponent = text.find('e'), point = text.find('.');
  const std::size_t end = std::min(exponent, text.size());
  int decimals = point < end ? static_cast<int>(end - point - 1) : 0;
  if (exponent != std::string::npos) decimals -= std::atoi(text.c_str() + exponent + 1);
  if (point != std::string::npos && text.substr(point, end - point) == ".0") --decimals;
  decimals_ = std::clamp(decimals, decimals_, kMostCoordinateDigits);
}

double LastDigit::half_unit() const { return 0.5 * std::pow(10.0, -decimals_); }

PointSeries plane_series(std::string name, Units units, const std::vector<Vec2>& points) {
  PointSeries out;
  out.name = std::move(name);
  out.units = std::move(units);
  LastDigit x, y;
  for (const Vec2 p : points) {
    if (out.points.empty() || out.points.back() != p) out.points.push_back(p);
    x.add(p.x);
    y.add(p.y);
  }
  out.rounding = {x.half_unit(), y.half_unit()};
  const std::size_t merged = points.size() - out.points.size();
  if (merged > 0) {
    out.warnings.push_back(fmt::format("{} point{} the point before merged into it", merged,
                                       merged == 1 ? " that repeats" : "s that repeat"));
  }
  return out;
}

Result<void> project_series(std::vector<GeoSeries> all, std::string_view name, Drawing& drawing) {
  drop_single_places(all, drawing.warnings);
  if (all.empty()) {
    return error(ErrorCode::kTooFewPoints, "the file holds no line with two different places")
        .where(std::string(name));
  }
  const LocalProjection projection(middle_of_places(all));
  double farthest = 0.0;
  for (const GeoSeries& series : all) {
    for (const GeoPoint& place : series.places) {
      farthest = std::max(farthest, std::abs(projection.to_plane(place).x));
    }
  }
  if (!(farthest <= kMostDistance)) {
    return error(ErrorCode::kSizeOutOfRange,
                 fmt::format("the places lie {:.0f} km from their middle meridian, too far for one "
                             "plane",
                             farthest / 1e3))
        .where(std::string(name))
        .hint("cut the file into regions")
        .value(farthest);
  }
  drawing.units = "m";
  const bool any_heights = std::any_of(
      all.begin(), all.end(), [](const GeoSeries& series) { return !series.heights.empty(); });
  drawing.warnings.push_back(fmt::format(
      "longitude and latitude became metres east and north of {:.6f}, {:.6f} "
      "(transverse Mercator on WGS84, scale 1 there); heights are {}",
      projection.centre().longitude, projection.centre().latitude,
      any_heights ? "those of profiles (obvid alignment), and else not used" : "not used"));
  if (const double scale = projection_scale(farthest) - 1.0; scale > kScaleWorthSaying) {
    drawing.warnings.push_back(fmt::format(
        "the places span so much that lengths are up to {:.2g} % too long", 100.0 * scale));
  }
  for (GeoSeries& series : all) {
    drawing.series.push_back(projected(std::move(series), projection));
  }
  return {};
}

}  // namespace obvid::exchange
