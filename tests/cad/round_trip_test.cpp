// SPDX-License-Identifier: Apache-2.0
// Contours through STEP, IGES and BREP and back: one edge, the same curve, in every unit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "../common/shared_data.h"
#include "../common/ten_points.h"
#include "built_cad.h"
#include "obvid/cad/internal/cad.h"
#include "obvid/curve/internal/joined_nurbs.h"
#include "obvid/curve/internal/path_distance.h"
#include "obvid/curve/nurbs.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

class CadFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    if (kCadIsMissing) GTEST_SKIP() << kCadMissing;
  }
  void TearDown() override { fs::remove_all(folder_); }

  Result<Drawing> there_and_back(const std::vector<CadCurve>& curves, CadWriteOptions options) {
    const auto text = cad_text(curves, options);
    OBVID_TRY(text);
    const fs::path file = folder_ / "file.cad";
    std::ofstream(file, std::ios::binary) << *text;
    EXPECT_TRUE(needs_cad(*text));
    return read_cad(file.string());
  }

  fs::path folder_;
};

Contour contour_of(const std::vector<Vec2>& points, Carrier carrier) {
  PointSeries series;
  series.points = points;
  FitJob job;
  job.carrier = carrier;
  auto f = fit(series, job);
  EXPECT_TRUE(f);
  return f ? f->contour : Contour{};
}

struct Format {
  CadFormat format;
  const char* name;
};
const Format kFormats[] = {{CadFormat::kStepAp214, "AP214"},
                           {CadFormat::kStepAp242, "AP242"},
                           {CadFormat::kIges, "IGES"},
                           {CadFormat::kBrep, "BREP"}};

/// The curve read against the curve written, span by span at the same parameters.
void expect_same(const NurbsCurve& written, const DrawnCurve& read, double scale, double size,
                 const std::string& what) {
  const auto spans = bezier_spans(written);
  ASSERT_EQ(read.pieces.size(), spans.size()) << what;
  double largest = 0.0, distance = 0.0, difference = 0.0;
  int last = 0, vertices = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const int steps = static_cast<int>(1000 / spans.size()) + 1;
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const Jet a = evaluate(spans[i].piece, t), b = evaluate(read.pieces[i], t);
      distance = std::max(distance, norm(scale * a.point - b.point) / (scale * size));
      difference = std::max(difference, std::abs(curvature(a) - scale * curvature(b)));
      largest = std::max(largest, std::abs(curvature(a)));
      if (k == 0 || k == steps) continue;
      const double rate = curvature_rate(b) * scale * scale;
      const int sign = rate > 0.0 ? 1 : -1;
      if (last != 0 && sign != last) ++vertices;
      last = sign;
    }
  }
  EXPECT_LE(distance, 1e-9) << what;
  EXPECT_LE(difference, 1e-6 * largest) << what;
  EXPECT_EQ(vertices, 0) << what;
}

TEST_F(CadFiles, ContoursComeBackAsOneEdgeWithTheSameCurvature) {
  for (const Carrier carrier : {Carrier::kSpiral, Carrier::kConics, Carrier::kBspline}) {
    const Contour contour = contour_of(kTenPoints, carrier);
    const auto curve = joined_nurbs(contour);
    ASSERT_TRUE(curve);
    for (const Format& one : kFormats) {
      const std::string what = std::string(to_string(carrier)) + " " + one.name;
      CadWriteOptions options;
      options.format = one.format;
      const auto drawing = there_and_back({{"contour", *curve}}, options);
      ASSERT_TRUE(drawing) << what << to_line(drawing.error());
      ASSERT_EQ(drawing->curves.size(), 1U) << what;
      EXPECT_TRUE(drawing->warnings.empty()) << what << drawing->warnings.front();
      expect_same(*curve, drawing->curves[0], 1.0, 300.0, what);
    }
  }
}

TEST_F(CadFiles, UnitsKeepTheLengths) {
  const auto curve = joined_nurbs(contour_of(kTenPoints, Carrier::kSpiral));
  ASSERT_TRUE(curve);
  const std::pair<const char*, double> units[] = {
      {"mm", 1.0}, {"m", 1000.0}, {"in", 25.4}, {"cm", 10.0}, {"ft", 304.8}};
  for (const auto& [unit, millimetres] : units) {
    for (const Format& one : kFormats) {
      if (one.format == CadFormat::kBrep) continue;
      CadWriteOptions options;
      options.format = one.format;
      options.units = unit;
      const auto drawing = there_and_back({{"contour", *curve}}, options);
      ASSERT_TRUE(drawing) << unit << one.name;
      EXPECT_EQ(drawing->units, "mm");
      expect_same(*curve, drawing->curves.at(0), millimetres, 300.0,
                  std::string(unit) + " " + one.name);
    }
  }
  CadWriteOptions options;
  options.units = "furlong";
  const auto refused = cad_text({{"contour", *curve}}, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadOption);
}

TEST_F(CadFiles, KnotsNearerThanTheToleranceOfParametersKeepTheirSpans) {
  constexpr double kSmall = 3e-12;  // Open CASCADE takes knots nearer than 1e-9 for one
  std::vector<Vec2> points;
  for (const Vec2 p : kTenPoints) points.push_back(kSmall * p);
  const auto curve = joined_nurbs(contour_of(points, Carrier::kSpiral));
  ASSERT_TRUE(curve);
  ASSERT_LT(curve->knots.back(), 1e-8);
  CadWriteOptions options;
  options.units = "km";
  const auto drawing = there_and_back({{"contour", *curve}}, options);
  ASSERT_TRUE(drawing) << to_line(drawing.error());
  ASSERT_EQ(drawing->curves.at(0).pieces.size(), bezier_spans(*curve).size());
  expect_same(*curve, drawing->curves[0], 1e6, kSmall * 300.0, "km");
}

TEST_F(CadFiles, LinesAndArcsStayWhatTheyAre) {
  const double turn = 0.5 * std::numbers::pi;
  const std::vector<Piece> pieces = {LinePiece{{0, 0}, {2, 0}},
                                     ArcPiece{{2, 0}, {3, 1}, 0.0, 1.0, turn},
                                     LinePiece{{3, 1}, {3, 4}}};
  for (const Format& one : kFormats) {
    CadWriteOptions options;
    options.format = one.format;
    const auto drawing = there_and_back({{"outline", pieces}}, options);
    ASSERT_TRUE(drawing) << one.name << to_line(drawing.error());
    ASSERT_EQ(drawing->curves.size(), 1U) << one.name;
    const auto& read = drawing->curves[0].pieces;
    ASSERT_EQ(read.size(), 3U) << one.name;
    EXPECT_TRUE(std::holds_alternative<LinePiece>(read[0])) << one.name;
    const auto* arc = std::get_if<ArcPiece>(&read[1]);
    ASSERT_NE(arc, nullptr) << one.name;
    EXPECT_NEAR(arc->kappa, 1.0, 1e-12) << one.name;
    EXPECT_NEAR(arc->length, turn, 1e-12) << one.name;
    EXPECT_NEAR(norm(arc->end - Vec2{3, 1}), 0.0, 1e-12) << one.name;
    const CurveAudit a = audit(drawing->curves[0], "mm");
    EXPECT_EQ(a.continuity, 1) << one.name;
  }
}

TEST_F(CadFiles, EveryPieceOfAWireIsWrittenHoweverFarItsCentreAndHoweverLargeTheCoordinates) {
  // curvature -1e-4, 1e-6 and 1e-12 per km: ends that are reckoned from the centre miss each other
  // by more than the kernel's 1e-7 mm, and the last one by more than a file may
  std::vector<Piece> pieces;
  Vec2 at = {2.4, -12.1};
  double theta = 0.3;
  for (const double kappa : {-0.08, -1e-4, 1e-6, 1e-12, 0.05}) {
    const double turn = 2.0 * kappa;
    // the chord of an arc of length 2: sin(turn/2)/(turn/2) by its series where it cancels
    const double half = 0.5 * turn,
                 chord = 2.0 * (1.0 - half * half / 6.0 * (1.0 - half * half / 20.0));
    const Vec2 end = at + chord * unit_at(theta + half);
    pieces.emplace_back(ArcPiece{at, end, theta, kappa, 2.0});
    theta += turn;
    at = end;
  }
  for (const Format& one : kFormats) {
    CadWriteOptions options;
    options.format = one.format;
    options.units = "km";
    const auto drawing = there_and_back({{"outline", pieces}}, options);
    ASSERT_TRUE(drawing) << one.name << to_line(drawing.error());
    std::vector<Piece> read;
    for (const auto& curve : drawing->curves) {
      read.insert(read.end(), curve.pieces.begin(), curve.pieces.end());
    }
    const double scale =
        norm(end_point(read.back()) - start_point(read.front())) / norm(at - Vec2{2.4, -12.1});
    std::vector<Piece> written;
    for (const Piece& piece : pieces) {
      const auto& arc = std::get<ArcPiece>(piece);
      written.emplace_back(ArcPiece{scale * arc.start, scale * arc.end, arc.theta0,
                                    arc.kappa / scale, arc.length * scale});
    }
    EXPECT_LE(path_distance(written, read), 1e-9 * 10.0 * scale) << one.name;
  }
}

TEST_F(CadFiles, TheSameContourGivesTheSameBytes) {
  const auto curve = joined_nurbs(contour_of(kTenPoints, Carrier::kSpiral));
  ASSERT_TRUE(curve);
  for (const Format& one : kFormats) {
    CadWriteOptions options;
    options.format = one.format;
    const auto a = cad_text({{"contour", *curve}}, options);
    const auto b = cad_text({{"contour", *curve}}, options);
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(*a == *b) << one.name;
  }
}

TEST_F(CadFiles, AFaceIsWrittenBesideTheWireWhereItIsWished) {
  const auto curve = joined_nurbs(contour_of(kTenPoints, Carrier::kSpiral));
  ASSERT_TRUE(curve);
  CadWriteOptions options;
  options.face_width = 5.0;
  const auto text = cad_text({{"contour", *curve}}, options);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("ADVANCED_FACE"), std::string::npos);
}

TEST_F(CadFiles, ClothoidsAreRefusedWithACarrierThatCan) {
  const Contour contour = contour_of(kTenPoints, Carrier::kClothoids);
  const auto text = cad_text({{"contour", contour.pieces}}, {});
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().hint.find("--carrier"), std::string::npos);
}

TEST_F(CadFiles, DamagedFilesAreRefusedAndNothingCrashes) {
  const auto curve = joined_nurbs(contour_of(kTenPoints, Carrier::kSpiral));
  ASSERT_TRUE(curve);
  for (const Format& one : kFormats) {
    CadWriteOptions options;
    options.format = one.format;
    const auto text = cad_text({{"contour", *curve}}, options);
    ASSERT_TRUE(text);
    for (int k = 0; k < 25; ++k) {
      const fs::path file = folder_ / "cut.cad";
      std::ofstream(file, std::ios::binary)
          << text->substr(0, text->size() * static_cast<std::size_t>(k) /
                                 25);  // some of them would hang or crash the kernel
      const auto drawing = read_cad(file.string());
      if (!drawing) {
        EXPECT_FALSE(to_line(drawing.error()).empty());
      }
    }
  }
}

TEST_F(CadFiles, PublicFilesAreReadOrRefusedWithAReason) {
  SKIP_WITHOUT("cad_iges_step");
  const auto folder = shared_data() / "cad_iges_step";
  int read = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (entry.path().extension() == ".csv") continue;
    const auto drawing = read_cad(path);
    if (!drawing) {
      std::printf("%-28s %s\n", entry.path().filename().c_str(), to_line(drawing.error()).c_str());
      EXPECT_FALSE(drawing.error().what.empty());
      continue;
    }
    ++read;
    int vertices = 0, pieces = 0;
    for (const DrawnCurve& curve : drawing->curves) {
      const CurveAudit a = audit(curve, drawing->units);
      vertices += a.vertices;
      pieces += static_cast<int>(curve.pieces.size());
    }
    std::printf("%-28s %4zu curves, %5d pieces, %4d vertices, %zu warnings\n",
                entry.path().filename().c_str(), drawing->curves.size(), pieces, vertices,
                drawing->warnings.size());
  }
  EXPECT_GE(read, 8);
}

}  // namespace
}  // namespace obvid
