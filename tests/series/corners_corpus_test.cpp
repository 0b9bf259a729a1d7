// SPDX-License-Identifier: Apache-2.0
// Corners of the public airfoils. Where trailing and leading edges are, their coordinates say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "../common/shared_data.h"
#include "obvid/io/read_points.h"
#include "obvid/series/internal/sections.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

fs::path shared_data() {
  const char* const folder = std::getenv("OBVID_SHARED_DATA");
  return folder != nullptr ? fs::path(folder) : fs::path(OBVID_SHARED_DATA);
}

// Five decimals, as most of the files have, in units of the chord.
constexpr double kRounding = 5e-6;

TEST(PublicAirfoils, LeadingEdgesAreNoCornersAndRepeatedTrailingEdgesAre) {
  SKIP_WITHOUT("airfoils_uiuc_selig");
  const auto folder = shared_data() / "airfoils_uiuc_selig";
  std::size_t read = 0, closed = 0, elsewhere = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    auto series = read_points(entry.path().string());
    ASSERT_TRUE(series.has_value()) << to_line(series.error());
    std::vector<Vec2>& points = series->points;
    const auto [least, most] =
        std::minmax_element(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    const double nose = least->x + 0.05 * (most->x - least->x);
    const bool loop = returns_to_start(points, 0.0, 0.0);
    if (loop) points.pop_back();
    for (const double rounding : {0.0, kRounding}) {
      const std::vector<std::size_t> corners =
          find_corners(points, std::vector<double>(points.size(), rounding), loop, {}, {});
      if (loop) {
        EXPECT_EQ(corners, std::vector<std::size_t>{0}) << entry.path();
      }
      for (const std::size_t i : corners) {
        EXPECT_GT(points[i].x, nose) << entry.path() << " point " << i;
        if (!loop) ++elsewhere;
      }
    }
    ++read;
    if (loop) ++closed;
  }
  EXPECT_EQ(read, 858U);
  EXPECT_EQ(closed, 11U);
  // A step of goe481 and a misprint of wb140, both without and with rounding.
  EXPECT_LE(elsewhere, 6U);
}

}  // namespace
}  // namespace obvid
