// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/geo/geojson.h"
#include "../common/shared_data.h"
#include "drawing_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "geodesic.h"

namespace obvid {
namespace {

TEST(GeoJson, EveryLineAndRingIsASeries) {
  const auto d = parse_geojson(
      R"({"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{"name":"A"},"geometry":
          {"type":"LineString","coordinates":[[8,50],[8.01,50,120]]}},
        {"type":"Feature","properties":null,"geometry":null},
        {"type":"Feature","geometry":{"type":"GeometryCollection","geometries":[
          {"type":"MultiLineString","coordinates":[[[8,50],[8,50.1]],[[8,50.2],[8,50.3]]]},
          {"type":"Polygon","coordinates":[[[8,50],[9,50],[9,51],[8,50]]]},
          {"type":"MultiPolygon","coordinates":[[[[8,50],[9,50],[9,51],[8,50]]],[[[8,50],[9,50],[9,51],[8,50]]]]},
          {"type":"MultiPoint","coordinates":[[8,50],[8.5,50]]}]}},
        {"type":"Feature","geometry":{"type":"Point","coordinates":[8,50]}},
        {"type":"Feature","geometry":{"type":"Point","coordinates":[8,50.5]}}]})",
      "all.geojson");
  ASSERT_TRUE(d.has_value()) << d.error().what << d.error().where;
  ASSERT_EQ(d->series.size(), 8U);
  EXPECT_EQ(d->series[0].name, "LineString 1 A");
  EXPECT_EQ(d->series[3].points.size(), 4U);  // a ring ends where it starts
  EXPECT_EQ(d->series[7].name, "points");
  EXPECT_EQ(d->units, "m");
  EXPECT_TRUE(warns(*d, "features without geometry left out (1 times)"));
  const auto& p = d->series[0].points;
  EXPECT_NEAR(norm(p[1] - p[0]), geodesic_distance({8.0, 50.0}, {8.01, 50.0}), 0.02);
}

TEST(GeoJson, AProjectedSystemAndLargeCoordinatesArePlane) {
  const std::string line =
      R"("type":"LineString","coordinates":[[448251.9,5411932.7],[448261.9,5411932.7]])";
  for (const std::string& crs :
       {std::string(),
        std::string(R"("crs":{"type":"name","properties":{"name":"EPSG:25831"}},)")}) {
    const auto d = parse_geojson("{" + crs + line + "}", "utm.geojson");
    ASSERT_TRUE(d.has_value()) << d.error().what;
    EXPECT_TRUE(warns(*d, "plane"));
    EXPECT_EQ(d->series[0].points[1], (Vec2{448261.9, 5411932.7}));
    EXPECT_NEAR(d->series[0].rounding.x, 0.05, 1e-15);
  }
  // Small coordinates are plane ones where the file says so, and not where it names WGS84.
  const std::string small = R"("type":"LineString","coordinates":[[1,2],[3,4]]})";
  const auto plane = parse_geojson(
      R"({"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3857"}},)" + small, "p");
  EXPECT_EQ(plane->series[0].points[1], (Vec2{3.0, 4.0}));
  const auto globe = parse_geojson(
      R"({"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)" + small,
      "g");
  EXPECT_GT(norm(globe->series[0].points[1] - globe->series[0].points[0]), 1e5);
}

TEST(GeoJson, TheAntimeridianMayBeWrittenBothWays) {
  const auto a =
      parse_geojson(R"({"type":"LineString","coordinates":[[179.5,1],[-179.5,1]]})", "a");
  const auto b = parse_geojson(R"({"type":"LineString","coordinates":[[179.5,1],[180.5,1]]})", "b");
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(norm(a->series[0].points[1] - b->series[0].points[1]), 0.0, 1e-6);
  EXPECT_NEAR(a->series[0].points[1].x - a->series[0].points[0].x,
              geodesic_distance({179.5, 1.0}, {-179.5, 1.0}), 2.0);
}

TEST(GeoJson, WhatIsWrongIsNamedWithItsPlace) {
  const auto cut = parse_geojson("{\"type\":\"LineString\",\n\"coordinates\":[[1,2],[3", "cut");
  EXPECT_EQ(cut.error().code, ErrorCode::kBadJson);
  EXPECT_EQ(cut.error().where.substr(0, 6), "cut:2:");
  const auto word =
      parse_geojson(R"({"type":"LineString","coordinates":[[1,2],["x",4]]})", "w.json");
  EXPECT_EQ(word.error().code, ErrorCode::kBadJson);
  EXPECT_EQ(word.error().where, "w.json: /coordinates/1");
  const auto kind = parse_geojson(R"({"type":"Topology","arcs":[]})", "t.json");
  EXPECT_EQ(kind.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(kind.error().what.find("Topology"), std::string::npos);
  EXPECT_FALSE(parse_geojson(R"({"type":"LineString","coordinates":[[1e999,2],[3,4]]})", "i"));
  EXPECT_FALSE(parse_geojson(R"({"type":"LineString","coordinates":[[NaN,2],[3,4]]})", "n"));
  EXPECT_FALSE(parse_geojson("[1,2]", "l"));
  EXPECT_FALSE(parse_geojson("", "e"));
  EXPECT_EQ(parse_geojson(R"({"type":"LineString","coordinates":[]})", "0").error().code,
            ErrorCode::kTooFewPoints);
}

TEST(GeoJson, DeepNestingIsRefusedAtOnce) {
  const std::string open(1000000, '[');
  const auto d = parse_geojson(R"({"type":"LineString","coordinates":)" + open, "deep");
  ASSERT_FALSE(d.has_value());
  EXPECT_NE(d.error().what.find("nested"), std::string::npos);
}

TEST(GeoJson, AMillionPositionsAreRead) {
  std::string text = R"({"type":"LineString","coordinates":[)";
  for (int k = 0; k < 1000000; ++k) {
    text += "[8." + std::to_string(100000 + k % 7) + ",50." + std::to_string(1000000 + k) + "],";
  }
  text.back() = ']';
  const auto d = parse_geojson(text + "}", "big");
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(d->series[0].points.size(), 1000000U);
}

/// Positions of the first line, found as text; its repetitions merge.
std::vector<GeoPoint> positions_of(const std::string& text) {
  std::vector<GeoPoint> out;
  std::size_t at = text.find("\"coordinates\"");
  at = text.find('[', at) + 1;
  while (true) {
    const std::size_t open = text.find_first_of("[]", at);
    if (open == std::string::npos || text[open] == ']') return out;
    std::size_t used = 0;
    const double longitude = std::stod(text.substr(open + 1), &used);
    const std::size_t comma = text.find(',', open);
    out.push_back({longitude, std::stod(text.substr(comma + 1))});
    at = text.find(']', open) + 1;
  }
}

TEST(GeoJsonPublicFiles, CircuitsHaveTheirPointsAndLengths) {
  SKIP_WITHOUT("tracks_f1_geojson");
  const auto folder = shared_data() / "tracks_f1_geojson";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string text = text_of_file(entry.path());
    const auto d = parse_geojson(text, entry.path().filename().string());
    ASSERT_TRUE(d.has_value()) << entry.path() << d.error().what;
    ASSERT_EQ(d->series.size(), 1U);
    const auto places = positions_of(text);
    ASSERT_EQ(d->series[0].points.size(), places.size()) << entry.path();
    double plane = 0.0, ground = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      plane += norm(d->series[0].points[i] - d->series[0].points[i - 1]);
      ground += geodesic_distance(places[i - 1], places[i]);
    }
    EXPECT_GT(ground, 2500.0);
    EXPECT_NEAR(plane / ground, 1.0, 3e-7) << entry.path();
    EXPECT_EQ(d->series[0].points.front(), d->series[0].points.back());
    ++files;
  }
  EXPECT_EQ(files, 19U);
}

TEST(GeoJsonPublicFiles, CutAnywhereTheyAreRefused) {
  SKIP_WITHOUT("tracks_f1_geojson/tr-2005.geojson");
  const auto path = shared_data() / "tracks_f1_geojson/tr-2005.geojson";
  const std::string text = text_of_file(path);
  for (std::size_t n = 0; n < text.rfind('}'); ++n) {
    EXPECT_FALSE(parse_geojson(text.substr(0, n), "cut").has_value()) << n;
  }
}

}  // namespace
}  // namespace obvid
