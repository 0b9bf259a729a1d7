// SPDX-License-Identifier: Apache-2.0
// What stands in the files: entities of the exact kind, their flags, digits; and damaged files.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "built_cad.h"
#include "obvid/cad/internal/cad.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

constexpr CadFormat kAllFormats[] = {CadFormat::kStepAp214, CadFormat::kStepAp242, CadFormat::kIges,
                                     CadFormat::kBrep};

class CadFormats : public testing::Test {
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

  static std::string text_of(const CadCurve& curve, CadFormat format) {
    CadWriteOptions options;
    options.format = format;
    const auto text = cad_text({curve}, options);
    EXPECT_TRUE(text) << to_line(text.error());
    return text ? *text : std::string{};
  }

  Result<Drawing> read(const std::string& text) {
    const fs::path file = folder_ / "file.cad";
    std::ofstream(file, std::ios::binary) << text;
    return read_cad(file.string());
  }

  fs::path folder_;
};

/// A quarter of the ellipse x^2/9 + y^2 = 1 from (3, 0) to (0, 1): its curvature there is a/b^2 = 3
/// and b/a^2 = 1/9.
RationalBezier quarter(bool backwards) {
  RationalBezier out;
  out.degree = 2;
  out.offset = {{{3, 0}, {3, 1}, {0, 1}}};
  out.weight = {{1.0, std::numbers::sqrt2 / 2.0, 1.0}};
  if (backwards) std::swap(out.offset[0], out.offset[2]);
  return out;
}

NurbsCurve cubic() {
  NurbsCurve out;
  out.degree = 3;
  out.knots = {0, 0, 0, 0, 1.0 / 3.0, 1, 1, 1, 1};
  out.points = {{0, 0}, {1.0 / 7.0, 2}, {3, 1.0 / 700.0}, {4, -2000.0 / 7.0}, {6, 1}};
  out.weights.assign(5, 1.0);
  return out;
}

/// Values of the first record of this type in the parameter section of an IGES file.
std::vector<double> iges_record(const std::string& text, const std::string& type) {
  std::istringstream lines(text);
  std::string line, record;
  while (std::getline(lines, line)) {
    if (line.size() < 73 || line[72] != 'P') continue;
    const std::string data = line.substr(0, 64);
    if (record.empty() && !data.starts_with(type + ",")) continue;
    record += data;
    if (data.find(';') != std::string::npos) break;
  }
  std::vector<double> values;
  for (const char* at = record.c_str(); *at != '\0' && *at != ';';) {
    char* end = nullptr;
    values.push_back(std::strtod(at, &end));
    while (*end == ' ') ++end;
    at = *end == ',' ? end + 1 : end;
    if (*end != ',' && *end != ';') break;
  }
  return values;
}

TEST_F(CadFormats, EllipsesStayEllipsesBothWays) {
  for (const bool backwards : {false, true}) {
    const CadCurve curve{"ellipse", std::vector<Piece>{quarter(backwards)}};
    EXPECT_NE(text_of(curve, CadFormat::kStepAp214).find("ELLIPSE("), std::string::npos);
    for (const CadFormat format : kAllFormats) {
      const auto drawing = read(text_of(curve, format));
      ASSERT_TRUE(drawing) << to_line(drawing.error());
      ASSERT_EQ(drawing->curves.size(), 1U);
      const auto& pieces = drawing->curves.front().pieces;
      ASSERT_EQ(pieces.size(), 1U);
      const auto* conic = std::get_if<RationalBezier>(&pieces.front());
      ASSERT_NE(conic, nullptr);
      EXPECT_EQ(conic->degree, 2);
      // systems are free to turn an edge round
      const bool turned = (norm(start_point(*conic) - Vec2{3, 0}) > 0.5) != backwards;
      const double at_tip = backwards != turned ? 1.0 : 0.0;
      const double sign = backwards != turned ? -1.0 : 1.0;
      const Jet tip = evaluate(*conic, at_tip), top = evaluate(*conic, 1.0 - at_tip);
      EXPECT_NEAR(norm(tip.point - Vec2{3, 0}), 0.0, 1e-12);
      EXPECT_NEAR(norm(top.point - Vec2{0, 1}), 0.0, 1e-12);
      EXPECT_NEAR(curvature(tip), sign * 3.0, 1e-12);
      EXPECT_NEAR(curvature(top), sign / 9.0, 1e-12);
    }
  }
}

TEST_F(CadFormats, ParabolasStaySplinesWithTheirPoints) {
  RationalBezier parabola = quarter(false);
  parabola.weight = {{1.0, 1.0, 1.0}};
  const std::string text =
      text_of({"parabola", std::vector<Piece>{parabola}}, CadFormat::kStepAp214);
  EXPECT_EQ(text.find("ELLIPSE("), std::string::npos);
  EXPECT_NE(text.find("B_SPLINE_CURVE_WITH_KNOTS"), std::string::npos);
}

TEST_F(CadFormats, IgesSplinesSayThatTheyArePlaneAndWhetherTheyHaveWeights) {
  NurbsCurve curve = cubic();
  auto record = iges_record(text_of({"cubic", curve}, CadFormat::kIges), "126");
  // type, K, M, plane, closed, polynomial, periodic; 9 knots, 5 weights, 5 points, range, normal
  ASSERT_EQ(record.size(), 7U + 9 + 5 + 15 + 2 + 3);
  EXPECT_EQ(record[1], 4);
  EXPECT_EQ(record[2], 3);
  EXPECT_EQ(record[3], 1);
  EXPECT_EQ(record[5], 1);
  EXPECT_EQ(std::abs(record.back()), 1.0);
  curve.weights[2] = 0.75;
  record = iges_record(text_of({"cubic", curve}, CadFormat::kIges), "126");
  ASSERT_EQ(record.size(), 7U + 9 + 5 + 15 + 2 + 3);
  EXPECT_EQ(record[5], 0);
  EXPECT_EQ(record[7 + 9 + 2], 0.75);
}

TEST_F(CadFormats, NumbersOfIgesKeepSixteenDigits) {
  const NurbsCurve curve = cubic();
  const auto record = iges_record(text_of({"cubic", curve}, CadFormat::kIges), "126");
  ASSERT_GE(record.size(), 36U);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    EXPECT_NEAR(record[21 + 3 * i], curve.points[i].x, 1e-15 * std::abs(curve.points[i].x));
    EXPECT_NEAR(record[22 + 3 * i], curve.points[i].y, 1e-15 * std::abs(curve.points[i].y));
  }
}

TEST_F(CadFormats, HugeAndTinyNumbersStayInTheirPlace) {
  NurbsCurve curve = cubic();
  curve.points[1].y = -1.0 / 3.0 * 1e-120;
  curve.points[2].y = -1.0 / 3.0 * 1e-5;
  for (const CadFormat format : kAllFormats) {
    const auto drawing = read(text_of({"cubic", curve}, format));
    ASSERT_TRUE(drawing) << to_line(drawing.error());
    EXPECT_EQ(drawing->curves.size(), 1U);
  }
}

TEST_F(CadFormats, DamagedFilesEndAtOnce) {
  constexpr std::size_t kCuts = 13;
  const double turn = 0.5 * std::numbers::pi;
  const std::vector<Piece> pieces = {LinePiece{{0, 0}, {2, 0}},
                                     ArcPiece{{2, 0}, {3, 1}, 0.0, 1.0, turn},
                                     LinePiece{{3, 1}, {3, 4}}};
  for (const CadFormat format : kAllFormats) {
    const std::string text = text_of({"outline", pieces}, format);
    for (std::size_t k = 0; k < kCuts; ++k) {
      const auto drawing = read(text.substr(0, text.size() * k / kCuts));
      if (!drawing) {
        EXPECT_EQ(exit_code(drawing.error().code), 3) << to_line(drawing.error());
        EXPECT_EQ(drawing.error().what.find("is not done after"), std::string::npos);
      }
    }
  }
}

TEST_F(CadFormats, ChangedDigitsAreReadOrRefused) {
  const std::string text = text_of({"cubic", cubic()}, CadFormat::kBrep);
  constexpr std::array kOthers = {"9999999999", "-1", "nan", "(", "*"};
  std::size_t turn = 0;
  for (std::size_t at = 0; at < text.size(); at += 7) {
    const char* const other = kOthers[turn++ % kOthers.size()];
    std::string damaged = text;
    damaged.replace(at, 1, other);
    const auto drawing = read(damaged);
    if (!drawing) {
      EXPECT_FALSE(drawing.error().what.empty());
      continue;
    }
    for (const DrawnCurve& curve : drawing->curves) {
      for (const Piece& piece : curve.pieces) {
        EXPECT_TRUE(std::isfinite(norm(start_point(piece)))) << at << other;
      }
    }
  }
}

}  // namespace
}  // namespace obvid
