// SPDX-License-Identifier: Apache-2.0
// Published series through which the fairest contour swings out in a loop: it must come without.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "obvid/curve/pieces.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

/// Lengths of the contour between its points; points that it meets within `reach`.
std::vector<double> lengths_between_points(const Contour& contour, double reach) {
  constexpr double kAccuracy = 1e-6;  // of lengths about 1 that are compared within a factor
  std::vector<double> out;
  for (const Piece& piece : contour.pieces) {
    const std::size_t next = out.size();
    if (next < contour.points.size() && norm(start_point(piece) - contour.points[next]) <= reach) {
      out.push_back(0.0);
    }
    if (out.empty()) return {};
    out.back() += arc_length(piece, kAccuracy);
  }
  return out;
}

void expect_no_loops(const std::string& name) {
  const auto series = read_points(std::string(OBVID_TEST_DATA) + "/published/" + name);
  ASSERT_TRUE(series) << name;
  for (const double noise : {0.0, 1e-4}) {
    FitJob job;
    if (noise > 0.0) job.noise = noise;
    const auto made = fit(*series, job);
    ASSERT_TRUE(made) << name << ": " << made.error().what;
    EXPECT_TRUE(made->certificate.proved) << name << " " << noise;
    const Contour& contour = made->contour;
    const auto length = lengths_between_points(contour, 2.0 * noise + 1e-12);
    ASSERT_EQ(length.size() + 1, contour.points.size()) << name << " " << noise;
    for (std::size_t k = 0; k + 1 < contour.points.size(); ++k) {
      // a circle that turns by 5/6 of a full turn over a chord is 5/3 pi times as long as it
      constexpr double kNoLoop = 5.3;
      EXPECT_LT(length[k], kNoLoop * norm(contour.points[k + 1] - contour.points[k]))
          << name << " " << noise << ", points " << k + 1 << " to " << k + 2;
    }
  }
}

TEST(Wandering, ContoursThroughASteepStartHaveNoLoops) { expect_no_loops("jupiter9.csv"); }

TEST(Wandering, ContoursThroughAPlateauHaveNoLoops) { expect_no_loops("plateau_rise10.csv"); }

TEST(Wandering, AHeadingThatIsHeldIsTold) {
  const auto series = read_points(std::string(OBVID_TEST_DATA) + "/published/jupiter9.csv");
  ASSERT_TRUE(series);
  const auto made = fit(*series, FitJob{});
  ASSERT_TRUE(made);
  bool told = false;
  for (const std::string& warning : made->warnings) {
    told = told || warning.find("would swing out beside point 8") != std::string::npos;
  }
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace obvid
