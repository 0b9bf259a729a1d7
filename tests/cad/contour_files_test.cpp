// SPDX-License-Identifier: Apache-2.0
// Contours of every carrier, unit and place come back from the files they were written to.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "../common/text.h"
#include "built_cad.h"
#include "obvid/cad/internal/cad.h"
#include "obvid/certify/certify.h"
#include "obvid/curve/internal/joined_nurbs.h"
#include "obvid/curve/nurbs.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

double size_from_start(const Contour& contour) {
  double size = 0.0;
  for (const Vec2 p : contour.points) size = std::max(size, norm(p - contour.points.front()));
  return size;
}

/// Changes between growing and falling, swings below the noise left out.
int turns(const std::vector<double>& values, double noise) {
  int count = 0, direction = 0;
  double extreme = values.front();
  for (const double v : values) {
    const double ahead = direction == 0 ? std::abs(v - extreme) : direction * (v - extreme);
    if (direction == 0 && ahead > noise) direction = v > extreme ? 1 : -1;
    if (direction != 0 && direction * (v - extreme) >= 0.0) {
      extreme = v;
    } else if (direction != 0 && -direction * (v - extreme) > noise) {
      direction = -direction;
      extreme = v;
      ++count;
    }
  }
  return count;
}

/// Whether the file holds this contour and nothing else, in millimetres.
void expect_contour_found(const std::string& file, const Contour& contour, double scale) {
  const auto written = joined_nurbs(contour);
  ASSERT_TRUE(written);
  const auto drawing = read_cad(file);
  ASSERT_TRUE(drawing) << to_line(drawing.error());
  ASSERT_EQ(drawing->curves.size(), 1U);
  EXPECT_TRUE(drawing->warnings.empty()) << drawing->warnings.front();
  const DrawnCurve& read = drawing->curves.front();
  const auto spans = bezier_spans(*written);
  ASSERT_EQ(read.pieces.size(), spans.size());
  const int each = 1000 / static_cast<int>(spans.size()) + 1;
  double distance = 0.0, difference = 0.0, largest = 0.0;
  std::vector<double> before, after;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    for (int k = 0; k <= each; ++k) {
      const double t = static_cast<double>(k) / each;
      const Jet a = evaluate(spans[i].piece, t), b = evaluate(read.pieces[i], t);
      distance = std::max(distance, norm(scale * a.point - b.point));
      before.push_back(curvature(a));
      after.push_back(scale * curvature(b));
      largest = std::max(largest, std::abs(before.back()));
      difference = std::max(difference, std::abs(before.back() - after.back()));
    }
  }
  EXPECT_LE(distance, 1e-9 * scale * size_from_start(contour));
  EXPECT_LE(difference, 1e-6 * largest);
  EXPECT_EQ(turns(after, 1e-8 * largest), turns(before, 1e-8 * largest));
  const bool g3 = contour.continuity == Continuity::kG3 && certify(contour).slope_steps == 0;
  EXPECT_EQ(audit(read, "mm").continuity, g3 ? 3 : 2);
}

class ContourFiles : public testing::Test {
 protected:
  void SetUp() override {
    if (kCadIsMissing) GTEST_SKIP() << kCadMissing;
    std::string pattern = (fs::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  void expect_round_trips(const Contour& contour, double millimetres, const std::string& name) {
    const std::pair<FileFormat, CadFormat> formats[] = {{FileFormat::kStep, CadFormat::kStepAp214},
                                                        {FileFormat::kStep, CadFormat::kStepAp242},
                                                        {FileFormat::kIges, CadFormat::kStepAp214},
                                                        {FileFormat::kBrep, CadFormat::kStepAp214}};
    int number = 0;
    for (const auto& [format, schema] : formats) {
      ExportOptions options;
      options.step = schema;
      const auto made = export_contour({contour, {}, {}}, format, options);
      ASSERT_TRUE(made) << name << ": " << to_line(made.error());
      const fs::path file = folder_ / (name + std::to_string(++number));
      std::ofstream(file, std::ios::binary) << made->files.front().text;
      expect_contour_found(file.string(), contour, format == FileFormat::kBrep ? 1.0 : millimetres);
    }
  }

  fs::path folder_;
};

/// Whether the file holds circle arcs with the ends, lengths and curvatures of these. Readers may
/// begin a closed curve with another piece.
void expect_arcs_found(const std::string& file, const Contour& contour) {
  const auto drawing = read_cad(file);
  ASSERT_TRUE(drawing) << to_line(drawing.error());
  ASSERT_EQ(drawing->curves.size(), 1U);
  EXPECT_EQ(drawing->curves.front().closed, contour.closed);
  std::vector<Piece> read = drawing->curves.front().pieces;
  ASSERT_EQ(read.size(), contour.pieces.size());
  const double size = size_from_start(contour);
  if (contour.closed) {
    const Vec2 first = start_point(contour.pieces.front());
    const auto begin = std::find_if(read.begin(), read.end(), [&](const Piece& piece) {
      return norm(start_point(piece) - first) <= 1e-9 * size;
    });
    ASSERT_NE(begin, read.end());
    std::rotate(read.begin(), begin, read.end());
  }
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto& arc = std::get<ArcPiece>(contour.pieces[i]);
    EXPECT_LE(norm(start_point(read[i]) - arc.start), 1e-9 * size) << i;
    EXPECT_LE(norm(end_point(read[i]) - arc.end), 1e-9 * size) << i;
    EXPECT_NEAR(arc_length(read[i], 1e-12 * size), arc.length, 1e-9 * size) << i;
    for (const double t : {0.0, 0.3, 1.0}) {
      EXPECT_NEAR(curvature(evaluate(read[i], t)), arc.kappa, 1e-6 * std::abs(arc.kappa)) << i;
    }
  }
}

Contour fitted_in(PointSeries series, FitJob job, const std::string& units) {
  auto made = fit(series, job);
  EXPECT_TRUE(made) << to_line(made.error());
  if (!made) return {};
  made->contour.units = units;
  return made->contour;
}

PointSeries series10(double scale, Vec2 shift) {
  PointSeries out;
  out.points = {{0, 0},          {0.21, -5.28},   {-5.11, -10.13}, {-20.48, -7.65},
                {-28.68, 16.23}, {-13.87, 40.95}, {17.95, 55.28},  {54.24, 53.04},
                {100.94, 36.19}, {230.38, -50.82}};
  for (Vec2& p : out.points) p = scale * p + shift;
  return out;
}

TEST_F(ContourFiles, FindsContoursOfEveryCarrierThatIsOneCurve) {
  for (const Carrier carrier : {Carrier::kSpiral, Carrier::kConics, Carrier::kBspline}) {
    FitJob job;
    job.carrier = carrier;
    expect_round_trips(fitted_in(series10(1.0, {}), job, "mm"), 1.0, to_string(carrier));
  }
}

TEST_F(ContourFiles, FindsArcsAsArcsInOpenAndClosedContours) {
  const std::string text = text_of_file(OBVID_TEST_DATA "/contours/arcs_closed.json");
  const auto closed = contour_from_json(text, "arcs_closed.json");
  ASSERT_TRUE(closed) << to_line(closed.error());
  ASSERT_TRUE(closed->contour.closed);
  FitJob job;
  job.carrier = Carrier::kArcs;
  for (const Contour& contour : {closed->contour, fitted_in(series10(1.0, {}), job, "mm")}) {
    for (const FileFormat format : {FileFormat::kStep, FileFormat::kIges, FileFormat::kBrep}) {
      const auto made = export_contour({contour, {}, {}, {}}, format, {});
      ASSERT_TRUE(made) << to_line(made.error());
      const fs::path file = folder_ / "arcs";
      std::ofstream(file, std::ios::binary) << made->files.front().text;
      SCOPED_TRACE(static_cast<int>(format));
      expect_arcs_found(file.string(), contour);
    }
  }
}

TEST_F(ContourFiles, FindsSmallContoursInMetresAndInches) {
  expect_round_trips(fitted_in(series10(1e-3, {}), {}, "m"), 1000.0, "metres");
  expect_round_trips(fitted_in(series10(1.0 / 25.4, {}), {}, "in"), 25.4, "inches");
}

TEST_F(ContourFiles, FindsContoursFarFromTheOrigin) {
  expect_round_trips(fitted_in(series10(1.0, {31250.0, -87500.0}), {}, "mm"), 1.0, "far");
}

TEST_F(ContourFiles, FindsAnAirfoilAsPrinted) {
  auto airfoil = read_points(std::string(OBVID_TEST_DATA) + "/airfoils/arad10.dat");
  ASSERT_TRUE(airfoil);
  FitJob job;
  job.noise_from_rounding = true;
  expect_round_trips(fitted_in(*airfoil, job, "m"), 1000.0, "airfoil");
}

}  // namespace
}  // namespace obvid
