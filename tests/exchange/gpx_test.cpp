// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/geo/gpx.h"
#include "../common/shared_data.h"
#include "drawing_checks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "geodesic.h"

namespace obvid {
namespace {

std::string point(const char* kind, double latitude, double longitude) {
  std::ostringstream out;
  out.precision(12);
  out << "<" << kind << " lat='" << latitude << "' lon='" << longitude << "'><ele>3</ele></" << kind
      << ">\n";
  return out.str();
}

TEST(Gpx, SegmentsRoutesAndWaypointsAreSeriesInMetres) {
  const std::string text =
      "<?xml version='1.0'?><gpx xmlns='http://www.topografix.com/GPX/1/1'>" +
      point("wpt", 45.0, 10.0) + point("wpt", 45.01, 10.0) + "<rte><name>Way</name>" +
      point("rtept", 45.0, 10.0) + point("rtept", 45.0, 10.01) + "</rte>" +
      "<trk><name>Walk</name><trkseg>" + point("trkpt", 45.0, 10.0) + point("trkpt", 45.0, 10.0) +
      point("trkpt", 45.001, 10.0) + "</trkseg><trkseg>" + point("trkpt", 45.0, 10.0) +
      point("trkpt", 45.002, 10.0) + "</trkseg></trk></gpx>";
  const auto d = parse_gpx(text, "walk.gpx");
  ASSERT_TRUE(d.has_value()) << d.error().what;
  ASSERT_EQ(d->series.size(), 4U);
  EXPECT_EQ(d->units, "m");
  EXPECT_EQ(d->series[0].name, "route Way");
  EXPECT_EQ(d->series[1].name, "track Walk");
  EXPECT_EQ(d->series[2].name, "track Walk, segment 2");
  EXPECT_EQ(d->series[3].name, "waypoints");
  ASSERT_EQ(d->series[1].points.size(), 2U);
  EXPECT_EQ(d->series[1].warnings.size(), 1U);  // a point that repeats
  EXPECT_TRUE(warns(*d, "10.005000, 45.005000"));
  const Vec2 step = d->series[1].points[1] - d->series[1].points[0];
  EXPECT_NEAR(norm(step), geodesic_distance({10.0, 45.0}, {10.0, 45.001}), 1e-4);
}

TEST(Gpx, APlaceThatRepeatsAtAnotherHeightIsTold) {
  const auto place = [](double latitude, const char* height) {
    return fmt::format("<trkpt lat='{}' lon='10'><ele>{}</ele></trkpt>", latitude, height);
  };
  const auto d = parse_gpx("<gpx><trk><trkseg>" + place(45.0, "300") + place(45.0, "302.5") +
                               place(45.0, "300") + place(45.001, "304") + place(45.001, "303") +
                               "</trkseg></trk></gpx>",
                           "t.gpx");
  ASSERT_TRUE(d.has_value());
  const PointSeries& track = d->series[0];
  ASSERT_EQ(track.points.size(), 2U);
  ASSERT_EQ(track.fixed.size(), 2U);
  EXPECT_EQ(track.fixed[0].height, 300.0);
  EXPECT_EQ(track.fixed[1].height, 304.0);
  ASSERT_EQ(track.warnings.size(), 2U);
  EXPECT_EQ(track.warnings[0].rfind("3 points that repeat", 0), 0U);
  EXPECT_EQ(track.warnings[1].rfind("2 points that repeat the point before have another height, up "
                                    "to 2.5",
                                    0),
            0U)
      << track.warnings[1];
}

TEST(Gpx, TheRoundingIsHalfTheLastDigitInMetres) {
  const auto d = parse_gpx(
      "<gpx><rte>" + point("rtept", 0.0, 10.00001) + point("rtept", 0.0001, 10.0) + "</rte></gpx>",
      "r.gpx");
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->series[0].rounding.x, 0.5e-5 * 111195.0, 1e-3);
  EXPECT_NEAR(d->series[0].rounding.y, 0.5e-4 * 111195.0, 1e-2);
}

TEST(Gpx, PointsThatLieNowhereAreLeftOutWithTheirLine) {
  const std::string text =
      "<gpx><trk><trkseg>\n" + point("trkpt", 45.0, 10.0) +
      "<trkpt lat='NaN' lon='1'/>\n<trkpt lat='91' lon='1'/>\n<trkpt lon='1'/>\n" +
      point("trkpt", 45.0, 10.1) + "</trkseg><trkseg/></trk></gpx>";
  const auto d = parse_gpx(text, "bad.gpx");
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(d->series[0].points.size(), 2U);
  EXPECT_TRUE(warns(*d, "3 times, first in line 3"));
  EXPECT_TRUE(warns(*d, "without points"));
}

TEST(Gpx, ATrackAcrossTheAntimeridianHasNoJump) {
  const auto d =
      parse_gpx("<gpx><rte>" + point("rtept", -17.0, 179.99) + point("rtept", -17.0, -179.99) +
                    point("rtept", -17.0, -179.97) + "</rte></gpx>",
                "fiji.gpx");
  ASSERT_TRUE(d.has_value());
  const auto& p = d->series[0].points;
  EXPECT_NEAR(p[1].x - p[0].x, p[2].x - p[1].x, 1e-3);
}

TEST(Gpx, PlacesTooFarApartForOnePlaneAreRefused) {
  const auto d = parse_gpx(
      "<gpx><rte>" + point("rtept", 0.0, 0.0) + point("rtept", 0.0, 100.0) + "</rte></gpx>",
      "world.gpx");
  ASSERT_FALSE(d.has_value());
  EXPECT_EQ(d.error().code, ErrorCode::kSizeOutOfRange);
  const auto wide = parse_gpx(
      "<gpx><rte>" + point("rtept", 0.0, 0.0) + point("rtept", 0.0, 10.0) + "</rte></gpx>",
      "wide.gpx");
  ASSERT_TRUE(wide.has_value());
  EXPECT_TRUE(warns(*wide, "too long"));
}

TEST(Gpx, BrokenFilesAreRefused) {
  EXPECT_EQ(parse_gpx("<gpx><trk>", "cut.gpx").error().code, ErrorCode::kBadJson);
  EXPECT_EQ(parse_gpx("<gpx/>", "empty.gpx").error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(parse_gpx("<kml/>", "x.kml").error().code, ErrorCode::kUnsupported);
  std::string deep = "<gpx>";
  for (int k = 0; k < 200000; ++k) deep += "<trk>";
  EXPECT_FALSE(parse_gpx(deep, "deep.gpx").has_value());
}

TEST(GpxPublicFiles, EachHasItsPoints) {
  SKIP_WITHOUT("gps_gpx");
  const auto folder = shared_data() / "gps_gpx";
  // Points as counted by another XML parser; none repeats the one before it.
  const std::vector<std::pair<const char*, std::size_t>> expected = {
      {"Mojstrovka", 184},
      {"around-visnjan-with-car", 104},
      {"route", 55},
      {"track-with-extremes", 25}};
  for (const auto& [name, count] : expected) {
    const auto d = parse_gpx(text_of_file(folder / (std::string(name) + ".gpx")), name);
    ASSERT_TRUE(d.has_value()) << name << d.error().what;
    ASSERT_EQ(d->series.size(), 1U) << name;
    EXPECT_EQ(d->series[0].points.size(), count) << name;
    EXPECT_EQ(d->warnings.size(), 1U) << name;  // what the plane is
  }
}

TEST(GpxPublicFiles, CutAnywhereTheyAreRefused) {
  SKIP_WITHOUT("gps_gpx/track-with-extremes.gpx");
  const auto path = shared_data() / "gps_gpx/track-with-extremes.gpx";
  const std::string text = text_of_file(path);
  const std::size_t end = text.rfind("</gpx>");
  ASSERT_NE(end, std::string::npos);
  for (std::size_t n = 0; n < end + 6; ++n) {
    EXPECT_FALSE(parse_gpx(text.substr(0, n), "cut.gpx").has_value()) << n;
  }
}

}  // namespace
}  // namespace obvid
