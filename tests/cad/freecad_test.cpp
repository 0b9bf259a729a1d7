// SPDX-License-Identifier: Apache-2.0
// CAD files read by FreeCAD, a program of other people: one edge, C1, the same curve and curvature.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../common/programs.h"
#include "built_cad.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  Contour contour;
  double millimetres = 1.0;  ///< of its unit
};

Contour fitted(PointSeries series, FitJob job) {
  auto f = fit(series, job);
  EXPECT_TRUE(f) << to_line(f.error());
  return f ? f->contour : Contour{};
}

std::vector<Case> cases() {
  PointSeries reference;
  reference.points = {{0, 0},          {0.21, -5.28},   {-5.11, -10.13}, {-20.48, -7.65},
                      {-28.68, 16.23}, {-13.87, 40.95}, {17.95, 55.28},  {54.24, 53.04},
                      {100.94, 36.19}, {230.38, -50.82}};
  std::vector<Case> out;
  for (const Carrier carrier : {Carrier::kSpiral, Carrier::kConics, Carrier::kBspline}) {
    FitJob job;
    job.carrier = carrier;
    out.push_back({std::string("series10-") + to_string(carrier), fitted(reference, job)});
  }
  for (const auto& [unit, millimetres] : {std::pair{"m", 1000.0}, std::pair{"in", 25.4}}) {
    Case one{std::string("series10-") + unit, fitted(reference, FitJob{}), millimetres};
    one.contour.units = unit;
    out.push_back(std::move(one));
  }
  auto airfoil = read_points(std::string(OBVID_TEST_DATA) + "/airfoils/arad10.dat");
  EXPECT_TRUE(airfoil);
  if (airfoil) {
    for (Vec2& p : airfoil->points) p = 100.0 * p;
    airfoil->rounding = 100.0 * airfoil->rounding;
    FitJob job;
    job.noise_from_rounding = true;
    out.push_back({"airfoil", fitted(*airfoil, job)});
  }
  return out;
}

double diagonal_of(const Contour& c) {
  Vec2 low = c.points.front(), high = low;
  for (const Vec2 p : c.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return norm(high - low);
}

/// 1,000 points of the contour with their curvatures, as JSON; lengths times `scale`.
std::string contour_points_json(const Contour& contour, double scale) {
  std::ostringstream out;
  out.precision(17);
  const int each = 1000 / static_cast<int>(contour.pieces.size()) + 1;
  bool first = true;
  for (const Piece& piece : contour.pieces) {
    for (int k = 0; k < each; ++k) {
      const Jet jet = evaluate(piece, (k + 0.5) / each);
      out << (first ? "" : ", ") << "[" << scale * jet.point.x << ", " << scale * jet.point.y
          << ", " << curvature(jet) / scale << "]";
      first = false;
    }
  }
  return out.str();
}

class InFreecad : public testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_PROGRAM("freecadcmd");
    std::string pattern = (fs::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }
  fs::path folder_;
};

TEST_F(InFreecad, EveryContourIsOneEdgeWithItsCurvature) {
  std::ostringstream job;
  job << "[";
  int files = 0;
  for (const Case& one : cases()) {
    for (const auto& [format, schema, ending] :
         {std::tuple{FileFormat::kStep, CadFormat::kStepAp214, ".step"},
          std::tuple{FileFormat::kStep, CadFormat::kStepAp242, ".stp"},
          std::tuple{FileFormat::kIges, CadFormat::kStepAp214, ".igs"},
          std::tuple{FileFormat::kBrep, CadFormat::kStepAp214, ".brep"}}) {
      ExportOptions options;
      options.step = schema;
      const auto made = export_contour({one.contour, {}, {}}, format, options);
      if (kCadIsMissing) GTEST_SKIP() << kCadMissing;
      ASSERT_TRUE(made) << to_line(made.error());
      const fs::path file = folder_ / (one.name + ending);
      std::ofstream(file, std::ios::binary) << made->files.front().text;
      const double scale = format == FileFormat::kBrep ? 1.0 : one.millimetres;
      job << (files++ > 0 ? ",\n" : "") << "{\"file\": \"" << file.string()
          << "\", \"size\": " << scale * diagonal_of(one.contour) << ", \"points\": ["
          << contour_points_json(one.contour, scale) << "]}";
    }
  }
  job << "]";
  const fs::path list = folder_ / "judge.json";
  std::ofstream(list) << job.str();
  const std::string out =
      output_of("HOME=" + folder_.string() + " OBVID_JUDGE=" + list.string() + " freecadcmd " +
                OBVID_SOURCE_DIR + "/tests/cad/freecad_judge.py 2>&1 </dev/null");
  ASSERT_NE(out.find("JUDGE DONE"), std::string::npos) << out;
  std::istringstream lines(out);
  std::string word, name;
  int judged = 0;
  while (lines >> word) {
    if (word != "JUDGED") continue;
    int edges = 0, continuity = 0, turns = 0;
    double distance = 0.0, difference = 0.0;
    lines >> name >> edges >> continuity >> distance >> difference >> turns;
    ++judged;
    EXPECT_EQ(edges, 1) << name;
    EXPECT_GE(continuity, 1) << name;
    EXPECT_LE(distance, 1e-9) << name;
    EXPECT_LE(difference, 1e-6) << name;
    EXPECT_EQ(turns, 0) << name;
  }
  EXPECT_EQ(judged, files);
}

}  // namespace
}  // namespace obvid
