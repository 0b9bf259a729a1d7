// SPDX-License-Identifier: Apache-2.0
// One half of a public hull, lying on its middle plane: printed programs against points of the
// surface itself, along whose normals the balls' places are looked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "../common/shared_data.h"
#include "cutting.h"
#include "obvid/core/files.h"
#include "obvid/io/internal/read_grid.h"
#include "obvid/io/surface_json.h"
#include "obvid/toolpath/toolpath.h"
#include "shapes.h"

namespace obvid {
namespace {

constexpr double kHullRadius = 3.0, kHullTolerance = 0.02, kHullScallop = 0.1;
constexpr double kScale = 5.0;     // makes a model some 160 long
constexpr double kHullStep = 0.1;  // of the interpreter
constexpr double kSampleError = 1e-5;
constexpr double kStepError = kHullStep * kHullStep / (8.0 * kHullRadius);
constexpr double kUpright = 0.01;  // z of normals: walls that lean outwards are hidden

std::filesystem::path shared_data() {
  const char* const folder = std::getenv("OBVID_SHARED_DATA");
  return folder != nullptr ? folder : OBVID_SHARED_DATA;
}

/// The half hull with its breadth upwards.
NurbsSurface lying_hull(const std::filesystem::path& file) {
  auto grid = read_grid({file.string()});
  if (!grid) return {};
  for (Vec3& p : grid->points) p = kScale * Vec3{p.x, p.z, p.y};
  auto surface = interpolated(*grid);
  return surface ? *surface : NurbsSurface{};
}

std::vector<test::Sample> hull_samples(const NurbsSurface& surface, int along_u, int along_v) {
  const auto at = [&](double s, double t) {
    const SurfaceJet jet = evaluate(surface, domain_u(surface).at(s), domain_v(surface).at(t));
    return test::Sample{jet.point, unit(cross(jet.du, jet.dv))};
  };
  const double sign = at(0.5, 0.5).normal.z < 0.0 ? -1.0 : 1.0;
  std::vector<test::Sample> out;
  for (int j = 0; j <= along_v; ++j) {
    for (int i = 0; i <= along_u; ++i) {
      test::Sample s = at(static_cast<double>(i) / along_u, static_cast<double>(j) / along_v);
      s.normal = sign * s.normal;
      out.push_back(s);
    }
  }
  return out;
}

struct FoundOnHull {
  double gouge = 0.0, cusp = 0.0;
  Vec3 place;
  int looked = 0;
};

FoundOnHull simulated(const std::vector<test::Sample>& samples, const test::NcRun& run) {
  std::vector<Vec3> points;
  for (const test::Sample& s : samples) points.push_back(s.point);
  test::Columns part(points, 0.5 * kHullRadius);
  test::Cut cut({kHullRadius, kHullRadius}, test::tips_of(run));
  FoundOnHull found;
  for (const test::Sample& s : samples) {
    found.gouge = std::max(found.gouge, cut.depth(s.point));
    if (s.normal.z < kUpright) continue;
    const Vec3 centre = s.point + kHullRadius * s.normal;  // of the ball that touches here
    double nearest = kHullRadius;
    part.near(centre, kHullRadius, [&](Vec3 q) { nearest = std::min(nearest, norm(q - centre)); });
    if (nearest < kHullRadius - kHullTolerance) continue;  // it would cut elsewhere
    ++found.looked;
    const double left = cut.left(s, kHullRadius);
    if (left > found.cusp) found.place = s.point;
    found.cusp = std::max(found.cusp, left);
  }
  return found;
}

class Hull : public testing::TestWithParam<ToolpathStrategy> {};

TEST_P(Hull, HalfOfSeries60IsNotGougedAndItsCuspsStayBelowTheScallop) {
  SKIP_WITHOUT("hulls_grids/Series60Offset_x.dat");
  const auto file = shared_data() / "hulls_grids" / "Series60Offset_x.dat";
  const NurbsSurface surface = lying_hull(file);
  ASSERT_FALSE(surface.points.empty());
  ToolpathOptions options;
  options.cutter = {CutterKind::kBall, 2.0 * kHullRadius, 0.0};
  options.strategy = GetParam();
  options.angle_deg = 90.0;  // up the bottom, which stands upright here
  options.tolerance = kHullTolerance;
  options.scallop = kHullScallop;
  const auto path = plan(test::model_of({surface}), options);
  ASSERT_TRUE(path) << to_line(path.error());
  const auto run = test::NcInterpreter(kHullStep).run(path->program.text);
  ASSERT_TRUE(run.faults.empty()) << run.faults.front();

  const auto samples = hull_samples(surface, 200, 200);
  const FoundOnHull found = simulated(samples, run);
  RecordProperty("gouge", std::to_string(found.gouge));
  RecordProperty("cusp", std::to_string(found.cusp));
  RecordProperty("at", std::to_string(found.place.x) + " " + std::to_string(found.place.y) + " " +
                           std::to_string(found.place.z));
  RecordProperty("reported", std::to_string(path->report.scallop.found));
  RecordProperty("passes", std::to_string(path->report.passes));
  RecordProperty("looked", found.looked);
  for (const std::string& warning : path->warnings) RecordProperty("warning", warning);
  EXPECT_GT(found.looked, static_cast<int>(samples.size() / 2));
  EXPECT_LE(found.gouge, path->report.gouge.most + kSampleError);
  EXPECT_LE(path->report.gouge.most, kHullTolerance);
  EXPECT_LE(found.cusp, path->report.scallop.most + kStepError);
  EXPECT_LE(path->report.scallop.found, kHullScallop);
  EXPECT_GT(found.cusp, 0.2 * kHullScallop);
}

INSTANTIATE_TEST_SUITE_P(Balls, Hull,
                         testing::Values(ToolpathStrategy::kZigzag,
                                         ToolpathStrategy::kConstantScallop));

TEST(LongGentleHull, IsNotGougedByArcsThatArePrintedAsLines) {
  SKIP_WITHOUT("found/files/gouge_case_surface.json");
  const auto file = shared_data() / "found" / "files" / "gouge_case_surface.json";
  const auto text = read_file(file.string());
  ASSERT_TRUE(text);
  const auto stored = surface_from_json(*text, file.string());
  ASSERT_TRUE(stored);
  constexpr double kGentleTolerance = 0.01,
                   kGentleScallop = 0.05;  // mm, with which it was gouged by 0.0184
  ToolpathOptions options;
  options.cutter = {CutterKind::kBall, 2.0 * kHullRadius, 0.0};
  options.tolerance = kGentleTolerance;
  options.scallop = kGentleScallop;
  const auto path = plan(*stored, options);
  ASSERT_TRUE(path) << to_line(path.error());
  const auto run = test::NcInterpreter(kHullStep).run(path->program.text);
  ASSERT_TRUE(run.faults.empty()) << run.faults.front();
  const auto samples = hull_samples(stored->patches.front().surface, 400, 60);
  const FoundOnHull found = simulated(samples, run);
  EXPECT_GT(found.looked, static_cast<int>(samples.size() / 2));
  EXPECT_LE(found.gouge, path->report.gouge.most + kSampleError);
  EXPECT_LE(path->report.gouge.most, kGentleTolerance);
  EXPECT_LE(path->report.scallop.found, kGentleScallop);
}

}  // namespace
}  // namespace obvid
