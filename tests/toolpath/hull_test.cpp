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

#include "nc_interpreter.h"
#include "obvid/io/read_grid.h"
#include "obvid/toolpath/toolpath.h"
#include "obvid/toolpath/toolpath_gcode.h"
#include "shapes.h"

namespace obvid {
namespace {

constexpr double kRadius = 3.0, kTolerance = 0.02, kScallop = 0.1;
constexpr double kScale = 5.0;  // makes a model some 160 long
constexpr double kStep = 0.1;   // of the interpreter
constexpr double kStepError = kStep * kStep / (8.0 * kRadius);
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

struct Sample {
  Vec3 point, normal;
};

std::vector<Sample> samples_of(const NurbsSurface& surface, int along_u, int along_v) {
  const auto at = [&](double s, double t) {
    const SurfaceJet jet = evaluate(surface, domain_u(surface).at(s), domain_v(surface).at(t));
    return Sample{jet.point, unit(cross(jet.du, jet.dv))};
  };
  const double sign = at(0.5, 0.5).normal.z < 0.0 ? -1.0 : 1.0;
  std::vector<Sample> out;
  for (int j = 0; j <= along_v; ++j) {
    for (int i = 0; i <= along_u; ++i) {
      Sample s = at(static_cast<double>(i) / along_u, static_cast<double>(j) / along_v);
      s.normal = sign * s.normal;
      out.push_back(s);
    }
  }
  return out;
}

/// Points in square columns.
class Columns {
 public:
  Columns(const std::vector<Vec3>& points, double size) : size_(size) {
    low_ = high_ = {points.front().x, points.front().y};
    for (const Vec3 p : points) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    nx_ = number(high_.x - low_.x) + 1;
    ny_ = number(high_.y - low_.y) + 1;
    cells_.resize(static_cast<std::size_t>(nx_ * ny_));
    for (const Vec3 p : points) cell(number(p.x - low_.x), number(p.y - low_.y)).push_back(p);
  }

  /// All points nearer than `reach` seen from above, and some more.
  template <class Look>
  void near(Vec3 p, double reach, const Look& look) {
    const int x1 = std::min(nx_ - 1, number(p.x + reach - low_.x));
    const int y1 = std::min(ny_ - 1, number(p.y + reach - low_.y));
    for (int y = std::max(0, number(p.y - reach - low_.y)); y <= y1; ++y) {
      for (int x = std::max(0, number(p.x - reach - low_.x)); x <= x1; ++x) {
        for (const Vec3 q : cell(x, y)) look(q);
      }
    }
  }

 private:
  [[nodiscard]] int number(double d) const { return static_cast<int>(std::floor(d / size_)); }
  std::vector<Vec3>& cell(int x, int y) { return cells_[static_cast<std::size_t>(y * nx_ + x)]; }

  double size_;
  Vec2 low_, high_;
  int nx_ = 0, ny_ = 0;
  std::vector<std::vector<Vec3>> cells_;
};

struct FoundOnHull {
  double gouge = 0.0, cusp = 0.0;
  Vec3 place;
  int looked = 0;
};

FoundOnHull simulated(const std::vector<Sample>& samples, const test::NcRun& run) {
  std::vector<Vec3> centres, points;
  for (const test::NcMove& move : run.moves) {
    for (const Vec3 tip : move.points) centres.push_back(tip + Vec3{0.0, 0.0, kRadius});
  }
  for (const Sample& s : samples) points.push_back(s.point);
  Columns balls(centres, 0.5 * kRadius), part(points, 0.5 * kRadius);
  FoundOnHull found;
  for (const Sample& s : samples) {
    double left = 1e9;
    balls.near(s.point, kRadius + 2.0 * kScallop, [&](Vec3 c) {
      const Vec3 to = c - s.point;
      const double along = dot(to, s.normal), beside2 = dot(to, to) - along * along;
      found.gouge = std::max(found.gouge, kRadius - norm(to));
      if (beside2 < kRadius * kRadius) {
        left = std::min(left, along - std::sqrt(kRadius * kRadius - beside2));
      }
    });
    if (s.normal.z < kUpright) continue;
    const Vec3 centre = s.point + kRadius * s.normal;  // of the ball that touches here
    double nearest = kRadius;
    part.near(centre, kRadius, [&](Vec3 q) { nearest = std::min(nearest, norm(q - centre)); });
    if (nearest < kRadius - kTolerance) continue;  // it would cut elsewhere
    ++found.looked;
    if (left > found.cusp) found.place = s.point;
    found.cusp = std::max(found.cusp, left);
  }
  return found;
}

class Hull : public testing::TestWithParam<ToolpathStrategy> {};

TEST_P(Hull, HalfOfSeries60IsNotGougedAndItsCuspsStayBelowTheScallop) {
  const auto file = shared_data() / "hulls_grids" / "Series60Offset_x.dat";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "the public data sets are missing (OBVID_SHARED_DATA)";
  }
  const NurbsSurface surface = lying_hull(file);
  ASSERT_FALSE(surface.points.empty());
  ToolpathOptions options;
  options.cutter = {CutterKind::kBall, 2.0 * kRadius, 0.0};
  options.strategy = GetParam();
  options.angle_deg = 90.0;  // up the bottom, which stands upright here
  options.tolerance = kTolerance;
  options.scallop = kScallop;
  const auto path = plan(test::model_of({surface}), options);
  ASSERT_TRUE(path) << to_line(path.error());
  const auto program = toolpath_gcode(*path);
  ASSERT_TRUE(program) << to_line(program.error());
  const auto run = test::NcInterpreter(kStep).run(program->text);
  ASSERT_TRUE(run.faults.empty()) << run.faults.front();

  const auto samples = samples_of(surface, 300, 300);
  const FoundOnHull found = simulated(samples, run);
  RecordProperty("gouge", std::to_string(found.gouge));
  RecordProperty("cusp", std::to_string(found.cusp));
  RecordProperty("at", std::to_string(found.place.x) + " " + std::to_string(found.place.y) + " " +
                           std::to_string(found.place.z));
  RecordProperty("reported", std::to_string(path->report.scallop));
  RecordProperty("passes", std::to_string(path->report.passes));
  RecordProperty("looked", found.looked);
  for (const std::string& warning : path->warnings) RecordProperty("warning", warning);
  EXPECT_GT(found.looked, static_cast<int>(samples.size() / 2));
  EXPECT_LE(found.gouge, kTolerance);
  EXPECT_LE(found.cusp, kScallop + kTolerance + kStepError);
  EXPECT_LE(found.cusp, path->report.scallop + kTolerance + kStepError);
  EXPECT_GT(found.cusp, 0.2 * kScallop);
}

INSTANTIATE_TEST_SUITE_P(Balls, Hull,
                         testing::Values(ToolpathStrategy::kZigzag,
                                         ToolpathStrategy::kConstantScallop));

}  // namespace
}  // namespace obvid
