// SPDX-License-Identifier: Apache-2.0
// Reads the public data sets. What each file holds is known from a table made by another program
// (airfoil_quirks.tsv) and from a naive reading of its lines; neither shares code with the reader.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "../common/shared_data.h"
#include "../common/text.h"
#include "obvid/io/read_points.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::string& set) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(shared_data() / set)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Every line that is two numbers and nothing else, by the C library's conversion.
std::vector<Vec2> naive_pairs(const fs::path& file) {
  std::string content = text_of_file(file);
  std::replace(content.begin(), content.end(), '\r', '\n');
  std::istringstream lines(content);
  std::vector<Vec2> pairs;
  for (std::string line; std::getline(lines, line);) {
    char* end = nullptr;
    const double x = std::strtod(line.c_str(), &end);
    if (end == line.c_str()) continue;
    char* const second = end;
    const double y = std::strtod(second, &end);
    if (end == second) continue;
    while (*end == ' ' || *end == '\t') ++end;
    if (*end == '\0') pairs.push_back({x, y});
  }
  return pairs;
}

std::vector<Vec2> merged(std::vector<Vec2> points) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// Two-sided files as one series: `first` rows of the upper side, reversed, then the lower side.
std::vector<Vec2> joined(const std::vector<Vec2>& rows, std::size_t first) {
  std::vector<Vec2> points(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(first));
  std::reverse(points.begin(), points.end());
  points.insert(points.end(), rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end());
  return merged(std::move(points));
}

std::vector<Vec2> expected_points(const fs::path& file, const std::string& format) {
  std::vector<Vec2> rows = naive_pairs(file);
  if (format == "lednicer") {
    const auto upper = static_cast<std::size_t>(rows.at(0).x);
    rows.erase(rows.begin());
    return joined(rows, upper);
  }
  if (file.extension() == ".af") {
    const bool symmetric = text_of_file(file).find("1\tSym Flag") != std::string::npos;
    const std::size_t upper = symmetric ? rows.size() : rows.size() / 2;
    for (std::size_t i = 0; symmetric && i < upper; ++i) rows.push_back({rows[i].x, -rows[i].y});
    return joined(rows, upper);
  }
  return merged(std::move(rows));
}

TEST(PublicData, EveryAirfoilFileIsReadAsPrinted) {
  SKIP_WITHOUT("airfoil_quirks.tsv");
  std::ifstream table(shared_data() / "airfoil_quirks.tsv");
  std::string line;
  std::getline(table, line);
  std::size_t read = 0;
  while (std::getline(table, line)) {
    std::istringstream row(line);
    std::string set;
    std::string name;
    std::string count;
    std::string format;
    std::getline(row, set, '\t');
    std::getline(row, name, '\t');
    std::getline(row, count, '\t');
    std::getline(row, format, '\t');
    const fs::path file = shared_data() / set / name;
    const auto series = read_points(file.string());
    ASSERT_TRUE(series.has_value()) << to_line(series.error());
    EXPECT_EQ(series->points, expected_points(file, format)) << file;
    // The table counts the grid bounds of MSES as a point, the leading edge of two-sided files
    // twice, and in one file two lines of the remark ("0.00000 0.00102 -> 0.00001 0.00102").
    const auto counted = static_cast<std::size_t>(std::stoul(count));
    const bool two_sided = format == "lednicer" || file.extension() == ".af";
    const std::size_t more = name == "nm26-3smoothed.dat" ? 2 : 1;
    if (!two_sided) {
      EXPECT_LE(counted - series->points.size(), more) << file;
    }
    ++read;
  }
  EXPECT_EQ(read, 1186U);
}

TEST(PublicData, EveryTurbineSectionHasItsTwoHundredPoints) {
  SKIP_WITHOUT("airfoil_quirks.tsv");
  std::size_t read = 0;
  for (const fs::path& file : files_of("windturbine_iea15")) {
    if (file.string().find("_Coords.txt") == std::string::npos) continue;
    const auto series = read_points(file.string());
    ASSERT_TRUE(series.has_value()) << to_line(series.error());
    const std::vector<Vec2> rows = naive_pairs(file);
    ASSERT_EQ(rows.size(), 201U);
    EXPECT_EQ(series->points, merged({rows.begin() + 1, rows.end()})) << file;
    ++read;
  }
  EXPECT_EQ(read, 50U);
}

TEST(PublicData, EveryOtherListOfPointsIsRead) {
  SKIP_WITHOUT("airfoil_quirks.tsv");
  const std::vector<std::pair<std::string, std::size_t>> sets{{"rail_wheel_profiles", 2},
                                                              {"published_series", 9},
                                                              {"tracks_tum", 28},
                                                              {"rail_transition_curves", 72},
                                                              {"outlines_momocs", 319}};
  for (const auto& [set, count] : sets) {
    std::size_t read = 0;
    for (const fs::path& file : files_of(set)) {
      const auto series = read_points(file.string());
      EXPECT_TRUE(series.has_value()) << to_line(series.error());
      ++read;
    }
    EXPECT_EQ(read, count) << set;
  }
  for (const char* name : {"rail_wheel_profiles/RUIC519A.dat", "rail_wheel_profiles/SUIC519A.dat",
                           "hulls_grids/hand.dat"}) {
    const auto series = read_points((shared_data() / name).string());
    ASSERT_TRUE(series.has_value()) << to_line(series.error());
    EXPECT_EQ(series->points, merged(naive_pairs(shared_data() / name))) << name;
  }
}

TEST(PublicData, NamedCoordinatesOfRailCurvesAreTheirPoints) {
  SKIP_WITHOUT("airfoil_quirks.tsv");
  // A clothoid from curvature 0 to 1/300 over 100 m ends at these coordinates (Fresnel integrals).
  const auto series = read_points(
      (shared_data() / "rail_transition_curves" / "toolboxH_Clothoid_100.0_inf_300_1_Meter.txt")
          .string());
  ASSERT_TRUE(series.has_value()) << to_line(series.error());
  ASSERT_EQ(series->points.size(), 101U);
  EXPECT_NEAR(series->points.back().x, 99.7225, 1e-3);
  EXPECT_NEAR(series->points.back().y, 5.5446, 1e-3);
}

TEST(PublicData, ASurveyOfSeveralScansIsRefusedAndOneOfItsScansIsReadWithItsIntervals) {
  SKIP_WITHOUT("airfoil_quirks.tsv");
  const fs::path file = shared_data() / "turbomachinery_nasa" / "ns10_scan_data.dat";
  const auto whole = read_points(file.string());
  ASSERT_FALSE(whole.has_value());
  EXPECT_EQ(whole.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(whole.error().hint.find("x,y,u95"), std::string::npos);
  // First scan: window number, mean axial velocity, and its 95 % interval (columns 1, 3 and 5).
  std::istringstream lines(text_of_file(file));
  std::string text = "x,y,u95\n";
  for (std::string line; std::getline(lines, line);) {
    std::istringstream row(line);
    std::vector<double> cells;
    for (double cell = 0.0; row >> cell;) cells.push_back(cell);
    if (cells.size() < 6) {
      if (text.size() > 100) break;
      continue;
    }
    std::ostringstream out;
    out << cells[0] << ',' << cells[2] << ',' << cells[4] << '\n';
    text += out.str();
  }
  const auto scan = parse_points(text, "scan");
  ASSERT_TRUE(scan.has_value()) << to_line(scan.error());
  ASSERT_GE(scan->points.size(), 24U);
  EXPECT_EQ(scan->points[1], (Vec2{2.0, 175.43}));
  EXPECT_EQ(scan->fixed[1].tolerance.value(), 0.6);
  EXPECT_EQ(scan->fixed[11].tolerance.value(), 0.7);
}

TEST(PublicData, DrawingsAreRefusedByTheirName) {
  SKIP_WITHOUT("airfoil_quirks.tsv");
  const std::vector<std::string> sets{"cad_dxf",           "cad_svg",  "cad_iges_step",
                                      "gps_gpx",           "landxml",  "roads_opendrive",
                                      "tracks_f1_geojson", "nist_strd"};
  std::size_t refused = 0;
  for (const std::string& set : sets) {
    for (const fs::path& file : files_of(set)) {
      const auto series = read_points(file.string());
      ASSERT_FALSE(series.has_value()) << file;
      EXPECT_EQ(exit_code(series.error().code), 3) << file;
      const bool drawing = set != "nist_strd" && file.extension() != ".csv";
      if (drawing) {
        EXPECT_EQ(series.error().code, ErrorCode::kUnsupported) << to_line(series.error());
      }
      ++refused;
    }
  }
  EXPECT_EQ(refused, 120U);
}

}  // namespace
}  // namespace obvid
