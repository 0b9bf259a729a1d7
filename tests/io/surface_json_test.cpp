// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "obvid/io/surface_json.h"

namespace obvid {
namespace {

NurbsSurface bilinear() {
  return {1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}, {}};
}

SurfaceModel model() {
  SurfaceModel out;
  out.name = "hull \"A\"\n";
  out.units = "m";
  NurbsSurface odd = bilinear();
  odd.points[0] = {0.1, -0.0, std::numeric_limits<double>::denorm_min()};
  odd.points[1] = {1.0 / 3.0, std::numeric_limits<double>::max(), -1e-300};
  odd.weights = {1.0, std::sqrt(0.5), std::nextafter(1.0, 2.0), 5e-7};
  odd.knots_u = {-0.1, -0.1, 0.3, 0.3};
  out.patches = {{"first", bilinear()}, {"second", odd}};
  return out;
}

TEST(SurfaceJson, ReadsBackTheSameDoubles) {
  const SurfaceModel written = model();
  const auto read = surface_from_json(surface_json(written), "f");
  ASSERT_TRUE(read) << to_line(read.error());
  EXPECT_EQ(read->name, written.name);
  EXPECT_EQ(read->units, written.units);
  ASSERT_EQ(read->patches.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read->patches[i].name, written.patches[i].name);
    EXPECT_EQ(read->patches[i].surface, written.patches[i].surface);
  }
  EXPECT_TRUE(std::signbit(read->patches[1].surface.points[0].y));
}

/// The file with the first `old_text` replaced; empty when it is not there.
std::string changed(const std::string& old_text, const std::string& new_text) {
  std::string text = surface_json(model());
  const std::size_t at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return at == std::string::npos ? "" : text.replace(at, old_text.size(), new_text);
}

void expect_surface_refused(const std::string& text, std::string_view place) {
  const auto read = surface_from_json(text, "f");
  ASSERT_FALSE(read) << text;
  EXPECT_NE(read.error().where.find(place), std::string::npos) << to_line(read.error());
}

TEST(SurfaceJson, EveryBrokenRuleIsNamedByItsPath) {
  expect_surface_refused(changed("obvid-surface", "obvid-contour"), "/format");
  expect_surface_refused(changed("\"version\": 1", "\"version\": 3"), "/version");
  expect_surface_refused(changed("\"degree_u\": 1", "\"degree_u\": 10"), "/patches/0/degree_u");
  expect_surface_refused(changed("\"degree_v\": 1", "\"degree_v\": 0"), "/patches/0/degree_v");
  expect_surface_refused(changed("[0, 0, 1, 1]", "[0, 0, \"1\", 1]"), "/patches/0/knots_u/2");
  expect_surface_refused(changed("[0, 0, 1, 1]", "[0, 1, 0, 1]"), "/patches/0");
  expect_surface_refused(changed("[0, 0, 1, 1]", "[]"), "/patches/0");
  expect_surface_refused(changed("[1, 0, 0]", "[1, 0]"), "/patches/0/points/1");
  expect_surface_refused(changed("[0, 0, 0], ", ""), "/patches/0");
  expect_surface_refused(changed("5e-07]", "-5e-07]"), "/patches/1");
  expect_surface_refused(changed("5e-07]", "5]]"), "f:");
  expect_surface_refused("{\"format\": \"obvid-surface\", \"version\": 1, \"patches\": []}", "f");
  expect_surface_refused("{\"format\": \"obvid-surface\", \"version\": 1}", "f");
  expect_surface_refused("[1]", "f");
  expect_surface_refused("", "f");
  expect_surface_refused(std::string(100000, '['), "f:1:");
}

TEST(SurfaceJson, FieldsOfOtherProgramsArePassedOver) {
  EXPECT_TRUE(surface_from_json(changed("\"units\"", "\"report\": {\"a\": [1]}, \"units\""), "f"));
}

}  // namespace
}  // namespace obvid
