// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "obvid/pipeline/surface_export.h"

namespace obvid {
namespace {

/// Lines u = const are (t, t^3 - t / 4, u) for t from -1/2 to 1/2: one change of sign at t = 0,
/// where they bend most at the ends of the third span.
NurbsSurface s_shaped() {
  NurbsSurface s;
  s.degree_u = 1;
  s.degree_v = 3;
  s.knots_u = {0, 0, 1, 1};
  s.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
  // t^3 over [-1/2, 1/2] has the Bezier ordinates -1/8, 1/8, -1/8, 1/8
  const double y[] = {-0.125, 0.125, -0.125, 0.125};
  for (int j = 0; j < 4; ++j) {
    const double t = -0.5 + j / 3.0;
    for (const double u : {0.0, 1.0}) s.points.push_back({t, y[j] - t / 4, u});
  }
  return s;
}

std::string picture_of(const SurfaceModel& model, const ShownLongitudinals& beside) {
  SurfaceExportOptions options;
  options.longitudinals = true;
  options.beside_longitudinals = beside;
  SurfaceExporter exporter(model, options);
  std::vector<std::string> remarks;
  const auto text = exporter.text(FileFormat::kPicture, remarks);
  EXPECT_TRUE(text);
  return text ? *text : std::string{};
}

bool says(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

std::size_t times(const std::string& text, const std::string& what) {
  std::size_t out = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++out;
  return out;
}

TEST(Longitudinals, CountChangesOfSignOfTenLines) {
  const SurfaceModel model{"s", "mm", {{"sheet", s_shaped()}}};
  const std::string text = picture_of(model, {});
  EXPECT_TRUE(says(text, "Changes of sign on 10 lines u = const: 10,")) << text.substr(0, 900);
  EXPECT_EQ(times(text, "changes of sign: 1<"), 10u);
  EXPECT_TRUE(says(text, "sheet, u = 0.0500 · "));
  EXPECT_TRUE(says(text, "Curvature, 1/mm"));
  EXPECT_TRUE(says(text, "knots across"));
}

TEST(Longitudinals, CompareWithTheExactSkin) {
  NurbsSurface flat = s_shaped();
  for (Vec3& p : flat.points) p.y = 0.0;
  const std::string text = picture_of({"s", "mm", {{"a", flat}, {"b", flat}}},
                                      {{s_shaped(), s_shaped()}, {0.0, 0.5, 1.0}});
  EXPECT_TRUE(says(text, "Changes of sign on 10 lines u = const: 10 before, 0 now"));
  EXPECT_EQ(times(text, "changes of sign: 1 before, 0 now"), 10u);
  EXPECT_TRUE(says(text, ">sections<"));
  EXPECT_TRUE(says(text, ">exact skin<"));
}

}  // namespace
}  // namespace obvid
