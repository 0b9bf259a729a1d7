// SPDX-License-Identifier: Apache-2.0
// The worksheet of `region`: each figure doctored once.
#include <fmt/format.h>

#include "doctored.h"
#include "heading_reach.h"
#include "region_checks.h"

namespace judge {
namespace {

Worksheet readable(const std::string& json) {
  Worksheet worksheet;
  read_worksheet(json, worksheet);
  EXPECT_EQ(worksheet.fault, "");
  return worksheet;
}

Sheet of_worksheet(const std::string& json) {
  Sheet sheet;
  check_worksheet(readable(json), read_input(data("judge/region.csv"), {}), false, sheet);
  return sheet;
}

/// A figure of a row, a millionth larger.
std::string larger(const std::string& json, const std::string& key, int n) {
  const std::string name = "\"" + key + "\": ";
  std::size_t at = json.find(name);
  for (; n > 0 && at != std::string::npos; --n) at = json.find(name, at + name.size());
  EXPECT_NE(at, std::string::npos) << key;
  const std::size_t from = at + name.size();
  const std::size_t to = json.find_first_of(",}", from);
  const double value = std::strtod(json.substr(from, to - from).c_str(), nullptr);
  EXPECT_NE(value, 0.0) << key;
  std::string out = json;
  return out.replace(from, to - from, fmt::format("{}", value * (1.0 + 1e-6)));
}

TEST(JudgeRegion, AcceptsAWorksheetItsTextAndItsTable) {
  Worksheet worksheet;
  read_worksheet(data("judge/region.json"), worksheet);
  ASSERT_EQ(worksheet.fault, "");
  Sheet sheet = of_worksheet(data("judge/region.json"));
  check_region_text(worksheet, data("judge/region.txt"), sheet);
  check_region_csv(worksheet, data("judge/region.table.csv"), sheet);
  EXPECT_EQ(sheet.wrong(), 0) << all_false(sheet);
  EXPECT_EQ(sheet.counts().at("region.range of curvature").judged, 34);
  EXPECT_EQ(sheet.counts().at("region.inserted").judged, 1);
}

TEST(JudgeRegion, FindsEachFalseFigure) {
  const std::string sound = data("judge/region.json");
  const std::pair<const char*, const char*> all[] = {
      {"chord", "chord"},
      {"to_apex", "to_apex"},
      {"from_apex", "from_apex"},
      {"heading_start", "heading_start"},
      {"heading_end", "heading_end"},
      {"points_only_error", "points_only_error"},
      {"lower_height", "lower_height"},
      {"width", "width"},
      {"chord_apex_height", "chord_apex_height"},
      {"tangent_apex_height", "tangent_apex_height"},
      {"chord_apex_gap", "chord_apex_gap"},
      {"tangent_apex_gap", "tangent_apex_gap"},
      {"chord_convex_bound", "chord_convex_bound"},
      {"tangent_convex_bound", "tangent_convex_bound"},
      {"kappa_start_high", "range of a segment"},
      {"kappa_low", "range of curvature"},
      {"kappa_high", "range of curvature"},
      {"adjacent_kappa", "adjacent_kappa"}};
  for (const auto& [name, claim] : all) {
    const Sheet sheet = of_worksheet(larger(sound, name, 2));
    EXPECT_TRUE(sheet.has(fmt::format("region.{}", claim))) << name << "\n" << all_false(sheet);
  }
  EXPECT_TRUE(of_worksheet(with(sound, "spline_distance", "0.5", 2)).has("region.spline_distance"));
  EXPECT_TRUE(of_worksheet(with(sound, "spline_distance", "null", 2)).has("region.spline_distance"));
  EXPECT_TRUE(of_worksheet(with(sound, "points_only_error", "null", 2))
                  .has("region.points_only_error null"));
  EXPECT_TRUE(of_worksheet(with(sound, "heading_given", "true", 2)).has("region.heading_given"));
  EXPECT_TRUE(of_worksheet(with(sound, "curvature_given", "true", 2)).has("region.curvature_given"));
  EXPECT_TRUE(of_worksheet(with(sound, "kappa_low", "null", 2)).has("region.range of curvature"));
}

TEST(JudgeRegion, FindsAnInsertedPointBesideTheMiddle) {
  const std::string sound = data("judge/region.json");
  const std::size_t at = sound.find("\"inserted\": 1");
  ASSERT_NE(at, std::string::npos);
  const std::size_t point = sound.rfind("\"point\": [", at);
  std::string moved = sound;
  const std::size_t from = point + 10, to = sound.find(',', from);
  const double x = std::strtod(sound.substr(from, to - from).c_str(), nullptr);
  moved.replace(from, to - from, fmt::format("{}", x + 1e-3));
  EXPECT_TRUE(of_worksheet(moved).has("region.inserted"));
}

TEST(JudgeRegion, FindsFalseCellsOfTextAndTable) {
  Worksheet worksheet;
  read_worksheet(data("judge/region.json"), worksheet);
  const std::string text = data("judge/region.txt"), csv = data("judge/region.table.csv");
  for (const char* word : {"chosen", " inserted\n", "104.0000", "straight", "141.0000"}) {
    Sheet sheet;
    check_region_text(worksheet, changed(text, word, "9.12345"), sheet);
    EXPECT_GT(sheet.wrong(), 0) << word;
  }
  for (const char* word : {"chosen", "2-3", ",104,", ",inf", "inserted,2.1"}) {
    Sheet sheet;
    check_region_csv(worksheet, changed(csv, word, ",9.12345"), sheet);
    EXPECT_GT(sheet.wrong(), 0) << word;
  }
}

Sheet of_construction(const std::string& json, const std::string& name) {
  Sheet sheet;
  check_construction(readable(json), read_input(data("judge/region.csv"), {}), name, sheet);
  return sheet;
}

/// The number in a column of the first row of the construction changed.
std::string with_value(const std::string& json, std::size_t column, double value) {
  std::size_t at = json.find("\"values\": [");
  EXPECT_NE(at, std::string::npos);
  at += 11;
  for (; column > 0; --column) at = json.find(',', at) + 1;
  const std::size_t to = json.find_first_of(",]", at);
  std::string out = json;
  return out.replace(at, to - at, fmt::format("{}", value));
}

TEST(JudgeRegion, FindsEachFalseFigureOfAConstruction) {
  struct Doctored {
    const char* name;
    std::size_t column;
    double value;
    const char* claim;
  };
  const Doctored all[] = {{"arcs", 0, -65.7, "R and R' touch"},
                          {"arcs", 1, -75.0, "R and R' touch"},
                          {"arcs", 2, 0.4994, "H"},
                          {"arcs", 3, 0.0215, "error"},
                          {"clothoids", 0, -63.9571, "end"},
                          {"clothoids", 1, -78.0159, "end"},
                          {"clothoids", 2, 16.80307, "end"},
                          {"clothoids", 3, 0.0010502, "step"},
                          {"ellipses", 0, 0.9901, "R"},
                          {"ellipses", 1, -63.3, "R"},
                          {"ellipses", 2, -77.1, "R'"},
                          {"ellipses", 3, 0.0188, "f"},
                          {"ellipses", 4, 0.001, "outside"}};
  for (const Doctored& one : all) {
    const std::string sound = data(fmt::format("judge/region_{}.json", one.name));
    const Sheet good = of_construction(sound, one.name);
    EXPECT_EQ(good.wrong(), 0) << one.name << "\n" << all_false(good);
    const Sheet bad = of_construction(with_value(sound, one.column, one.value), one.name);
    EXPECT_TRUE(bad.has(fmt::format("region {}.{}", one.name, one.claim)))
        << one.name << " " << one.column << "\n" << all_false(bad);
  }
  const std::string ellipses = data("judge/region_ellipses.json");
  EXPECT_TRUE(of_construction(changed(ellipses, "ellipse, monotone", "hyperbola, monotone"),
                              "ellipses")
                  .has("region ellipses.kind"));
  EXPECT_TRUE(of_construction(changed(ellipses, "at points 3, 6, 7", "at points 3, 6"), "ellipses")
                  .has("region ellipses.curvature goes on"));
  EXPECT_TRUE(of_construction(changed(data("judge/region_arcs.json"), "the radii go one way",
                                      "the radii do NOT go one way"),
                              "arcs")
                  .has("region arcs.one way"));
  EXPECT_TRUE(of_construction(changed(data("judge/region_clothoids.json"), "up to 14.5 %",
                                      "up to 14.4 %"),
                              "clothoids")
                  .has("region clothoids.largest step"));
}

Sheet of_drawings(const std::string& dxf, const std::string& svg) {
  Sheet sheet;
  check_region_drawings(readable(data("judge/region.json")), read_input(data("judge/region.csv"), {}),
                        dxf, svg, "mm", sheet);
  return sheet;
}

/// The picture with one corner of the first path of a layer moved by a pixel.
std::string with_moved_corner(const std::string& svg, const std::string& layer) {
  const std::size_t group = svg.find("<g id=\"" + layer + "\">");
  EXPECT_NE(group, std::string::npos) << layer;
  const std::size_t from = svg.find('L', svg.find(" d=\"M", group)) + 1;
  char* end = nullptr;
  const double x = std::strtod(svg.c_str() + from, &end);
  std::string out = svg;
  return out.replace(from, static_cast<std::size_t>(end - svg.c_str()) - from,
                     fmt::format("{:.2f}", x + 1.0));
}

/// The picture without the last path of a layer.
std::string without_path(const std::string& svg, const std::string& layer) {
  const std::size_t group = svg.find("<g id=\"" + layer + "\">"), last = svg.find("</g>", group);
  const std::size_t from = svg.rfind("<path", last);
  EXPECT_GT(from, group) << layer;
  std::string out = svg;
  return out.erase(from, svg.find("/>", from) + 2 - from);
}

TEST(JudgeRegion, FindsEachFalseCurveOfThePicture) {
  const std::string dxf = data("judge/region.dxf"), svg = data("judge/region.svg");
  const Sheet sound = of_drawings(dxf, svg);
  EXPECT_EQ(sound.wrong(), 0) << all_false(sound);
  for (const char* layer : {"REGION", "ADJACENT_CIRCLES", "TRIANGLES", "LIMIT_FROM_START",
                            "LIMIT_TO_END", "TANGENTS"}) {
    const std::string claim = std::string("picture: ") + layer;
    EXPECT_TRUE(of_drawings(dxf, with_moved_corner(svg, layer)).has(claim)) << layer;
    EXPECT_TRUE(of_drawings(dxf, without_path(svg, layer)).has(claim)) << layer;
  }
}

/// Two points on a chord of length 1: the heading before is given, the curvature grows.
TEST(JudgeRegion, LooksForHeadingsAsFarAsSpiralsExist) {
  const Worksheet worksheet = readable(data("judge/region.json"));
  constexpr Real kBefore = -0.3L;
  SheetPoint a, b;
  b.stored = {1.0, 0.0};
  b.point = {1.0L, 0.0L};
  b.index = 1;
  a.heading_given = true;
  a.heading = kBefore;
  b.heading = 0.5L;
  b.headings = Limits{0.3L, 1.5L};
  SheetRow row;
  row.to = 1;
  row.start = Limits{-HUGE_VALL, 0.5L};
  row.end = Limits{0.9L, HUGE_VALL};
  row.figures = worksheet.user.rows.front().figures;
  SheetPart part;
  part.points = {a, b};
  part.rows = {row};
  part.kappas = {0.0, 2.0};
  Input input;
  input.points.resize(2);
  EXPECT_TRUE(found_with_heading(part, input, 1, 0.301L));  // beyond the circle
  EXPECT_FALSE(found_with_heading(part, input, 1, 0.299L));
  // A B = -sin^2(sigma/2) with curvature 0 before
  const auto least = [](Real theta) {
    const Real half = std::sin(0.5L * (kBefore + theta));
    return 2.0L * (std::sin(theta) + half * half / -std::sin(kBefore));
  };
  constexpr Real kLast = 0.7L;
  input.points[0].kappa = 0.0;
  input.points[1].kappa = static_cast<double>(least(kLast));
  EXPECT_TRUE(found_with_heading(part, input, 1, kLast - 1e-3L));
  EXPECT_FALSE(found_with_heading(part, input, 1, kLast + 1e-3L));
}

/// An arc of curvature 0.5 goes before the chord of length 1: the spiral behind it begins with that.
TEST(JudgeRegion, LooksForSpiralsThatBeginWithTheCurvatureOfAnArc) {
  constexpr Real kCurvature = 0.5L, kBefore = -0.3L;
  const Json arc_figures = read_json(R"({"width": 0})").value;
  const Json figures = read_json(R"({"width": 0.01})").value;
  SheetPart part;
  part.points.resize(3);
  // a chord of the arc, which ends at the origin with the heading before
  const Real half = 0.2L, chord = 2.0L * std::sin(half) / kCurvature;
  part.points[0].stored = {static_cast<double>(-chord * std::cos(kBefore - half)),
                           static_cast<double>(-chord * std::sin(kBefore - half))};
  part.points[0].heading = kBefore - 2.0L * half;
  part.points[1].stored = {0.0, 0.0};
  part.points[1].heading = kBefore;
  part.points[2].stored = {1.0, 0.0};
  part.points[2].heading = 0.5L;
  for (std::size_t i = 0; i < 3; ++i) part.points[i].index = i;
  part.points[2].headings = Limits{0.3L, 1.5L};
  SheetRow arc, spiral;
  arc.to = 1;
  arc.start = arc.end = Limits{kCurvature, kCurvature};
  arc.figures = &arc_figures;
  spiral.from = 1;
  spiral.to = 2;
  spiral.start = Limits{kCurvature, kCurvature};
  spiral.end = Limits{0.6L, HUGE_VALL};
  spiral.figures = &figures;
  part.rows = {arc, spiral};
  Input input;
  input.points.resize(3);
  // A B = -sin^2(sigma/2) with the curvature of the arc before
  const auto least = [](Real theta) {
    const Real sine = std::sin(0.5L * (kBefore + theta));
    return 2.0L * (std::sin(theta) + sine * sine / -(0.5L * kCurvature + std::sin(kBefore)));
  };
  constexpr Real kLast = 0.7L;
  input.points[2].kappa = static_cast<double>(least(kLast));
  EXPECT_TRUE(found_with_heading(part, input, 2, kLast - 1e-3L));
  EXPECT_FALSE(found_with_heading(part, input, 2, kLast + 1e-3L));
}

}  // namespace
}  // namespace judge
