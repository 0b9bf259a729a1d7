// SPDX-License-Identifier: Apache-2.0
// STEP files of curves: their grammar, entities, numbers, names and units. That kernels read the
// same curves is tested in tests/cad.
#include "../common/programs.h"
#include "obvid/exchange/internal/step/write.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "road_contours.h"

namespace obvid {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

NurbsCurve step_cubic() {
  return {3,
          {0, 0, 0, 0, 1.0 / 3.0, 1, 1, 1, 1},
          {{0, 0}, {1.0 / 7.0, 2}, {3, 1.0 / 700.0}, {4, -2000.0 / 7.0}, {6, 1e-7}},
          {1, 1, 1, 1, 1}};
}

RationalBezier ellipse_quarter(bool backwards) {
  RationalBezier out;
  out.degree = 2;
  out.offset = {{{3, 0}, {3, 1}, {0, 1}}};
  out.weight = {{1.0, std::numbers::sqrt2 / 2.0, 1.0}};
  if (backwards) std::swap(out.offset[0], out.offset[2]);
  return out;
}

/// Every kind of curve that is written.
std::vector<CadCurve> all_curves() {
  NurbsCurve rational = step_cubic(), closed = step_cubic();
  rational.weights[2] = 0.75;
  closed.points.back() = closed.points.front();
  RationalBezier parabola = ellipse_quarter(false);
  parabola.weight = {{1.0, 1.0, 1.0}};
  const std::vector<Piece> open = {
      LinePiece{{0, 0}, {2, 0}}, ArcPiece{{2, 0}, {3, 1}, 0.0, 1.0, 0.5 * kHalfTurn},
      ArcPiece{{3, 1}, {4, 2}, 0.5 * kHalfTurn, -1.0, 0.5 * kHalfTurn}, LinePiece{{4, 2}, {3, 4}}};
  const std::vector<Piece> slot = {
      LinePiece{{0, 0}, {20, 0}}, ArcPiece{{20, 0}, {20, 10}, 0.0, 0.2, 5 * kHalfTurn},
      LinePiece{{20, 10}, {0, 10}}, ArcPiece{{0, 10}, {0, 0}, kHalfTurn, 0.2, 5 * kHalfTurn}};
  const std::vector<Piece> circle = {
      ArcPiece{{5, 0}, {5, 0}, -0.5 * kHalfTurn, -0.2, 10 * kHalfTurn}};
  return {{"cubic", step_cubic()},
          {"rational", rational},
          {"closed", closed},
          {"open", open},
          {"slot", slot},
          {"circle", circle},
          {"line", std::vector<Piece>{LinePiece{{0, 0}, {3, -4}}}},
          {"ellipse", std::vector<Piece>{ellipse_quarter(false)}},
          {"backwards", std::vector<Piece>{ellipse_quarter(true)}},
          {"parabola", std::vector<Piece>{parabola}}};
}

std::string written_step(const CadCurve& curve, const StepOptions& options = {}) {
  const auto text = step_text({curve}, options);
  EXPECT_TRUE(text) << to_line(text.error());
  return text ? *text : std::string();
}

/// Lines are broken for people only.
bool holds(std::string text, const std::string& part) {
  std::erase(text, '\n');
  return text.find(part) != std::string::npos;
}

TEST(StepWrite, FilesKeepTheGrammarAndTheRulesOfTheSchemas) {
  SKIP_WITHOUT_PROGRAM("python3");
  for (const CadCurve& curve : all_curves()) {
    for (const double face : {0.0, 2.0}) {
      const StepOptions options{face > 0.0 ? StepSchema::kAp242 : StepSchema::kAp214,
                                face > 0.0 ? "in" : "mm", face};
      EXPECT_EQ(judged("check_step.py", written_step(curve, options)), "") << curve.name << face;
    }
  }
}

TEST(StepWrite, TheJudgeOfFilesSeesWhatIsWrong) {
  SKIP_WITHOUT_PROGRAM("python3");
  const std::string slot = written_step(all_curves()[4], {StepSchema::kAp214, "mm", 1.0});
  const std::string cubic = written_step(all_curves()[1]);
  const auto blamed = [](std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) return false;
    return !judged("check_step.py", text.replace(at, from.size(), to)).empty();
  };
  EXPECT_TRUE(blamed(slot, "(20.,0.,0.)", "(20,0.,0.)"));  // no REAL
  EXPECT_TRUE(blamed(slot, "'slot'", "'sl\xC3\xB6t'"));    // not of the alphabet
  EXPECT_TRUE(blamed(slot, "'slot'", "'sl\\ot'"));         // a lone backslash
  EXPECT_TRUE(blamed(slot, "ENDSEC;\nDATA;", "DATA;"));    // header without end
  EXPECT_TRUE(blamed(slot, "PARAMETER_VALUE(20.)", "PARAMETER_VALUE(21.)"));
  EXPECT_TRUE(blamed(slot, ".CONTINUOUS.", ".DISCONTINUOUS."));
  EXPECT_TRUE(blamed(slot, "ORIENTED_EDGE('',*,*,", "ORIENTED_EDGE('',"));
  EXPECT_TRUE(blamed(cubic, "(4,1,4)", "(4,2,4)"));  // knots without points
  EXPECT_TRUE(blamed(cubic, "0.3333333333333333,", "1.3333333333333333,"));
  EXPECT_TRUE(blamed(cubic, "RATIONAL_B_SPLINE_CURVE", "ANY_B_SPLINE_CURVE"));
  EXPECT_TRUE(blamed(cubic, "FILE_SCHEMA", "FILE_SCHEME"));
}

// ISO 10303-21, 6.3.2: digits, a point, E before the exponent.
TEST(StepWrite, NumbersHaveAPointAndTheFewestDigitsThatGiveThemBack) {
  const std::string text = written_step({"cubic", step_cubic()});
  EXPECT_TRUE(holds(text, "(0.14285714285714285,2.,0.)"));    // 1/7, and 0.1428571428571428 is less
  EXPECT_TRUE(holds(text, "(3.,0.0014285714285714286,0.)"));  // 1/700
  EXPECT_TRUE(holds(text, "(4.,-285.7142857142857,0.)"));     // -2000/7
  EXPECT_TRUE(holds(text, "(6.,1.E-07,0.)"));
  NurbsCurve large = step_cubic();
  large.points[1] = {1e22, -0.0};
  EXPECT_TRUE(holds(written_step({"large", large}), "(1.E+22,0.,0.)"));
}

// ISO 10303-21, 6.3.3: U+00F6, U+00DF and U+1F600; marks and backslashes are doubled.
TEST(StepWrite, NamesKeepTheirLettersMarksAndBackslashes) {
  const std::string text =
      written_step({"Gr\xC3\xB6\xC3\x9F"
                    "e 'a' \\ \n\xF0\x9F\x98\x80",
                    step_cubic()});
  const std::string name = R"('Gr\X2\00F600DF\X0\e ''a'' \\  \X4\0001F600\X0\')";
  EXPECT_TRUE(holds(text, "FILE_NAME(" + name));
  EXPECT_TRUE(holds(text, "PRODUCT(" + name));
  if (is_installed("python3")) {
    EXPECT_EQ(judged("check_step.py", text), "");
  }
}

TEST(StepWrite, NamesThatAreMissingOrNoUtf8AreWrittenAllTheSame) {
  EXPECT_TRUE(holds(written_step({"", step_cubic()}), "PRODUCT('contour','contour'"));
  // a byte that is no UTF-8 is taken as Latin 1
  EXPECT_TRUE(holds(written_step({"\xE4", step_cubic()}), R"(PRODUCT('\X2\00E4\X0\')"));
}

struct UnitCase {
  const char* unit;
  const char* stated;
  const char* three;  ///< 3 units in the unit of the file
};

// The international yard and pound agreement of 1959: 1 in = 25.4 mm; 1 mi = 5280 ft.
TEST(StepWrite, UnitsAreStatedAndLengthsConvertedWhereStepHasNone) {
  const UnitCase cases[] = {
      {"nm", "SI_UNIT(.MICRO.,.METRE.)", "0.003"}, {"um", "SI_UNIT(.MICRO.,.METRE.)", "3."},
      {"mm", "SI_UNIT(.MILLI.,.METRE.)", "3."},    {"cm", "SI_UNIT(.CENTI.,.METRE.)", "3."},
      {"m", "SI_UNIT($,.METRE.)", "3."},           {"km", "SI_UNIT(.KILO.,.METRE.)", "3."},
      {"mil", "LENGTH_MEASURE(0.0254)", "3."},     {"in", "LENGTH_MEASURE(25.4)", "3."},
      {"ft", "LENGTH_MEASURE(304.8)", "3."},       {"yd", "LENGTH_MEASURE(304.8)", "9."},
      {"mi", "LENGTH_MEASURE(1609344.)", "3."}};
  for (const UnitCase& one : cases) {
    const CadCurve line{"line", std::vector<Piece>{LinePiece{{0, 0}, {3, 0}}}};
    const std::string text = written_step(line, {StepSchema::kAp214, one.unit, 0.0});
    EXPECT_TRUE(holds(text, one.stated)) << one.unit;
    EXPECT_TRUE(holds(text, std::string("(") + one.three + ",0.,0.)")) << one.unit;
  }
}

TEST(StepWrite, CurvesAreTheEntitiesThatTheyAre) {
  const auto text_of_curve = [&](std::size_t k) { return written_step(all_curves()[k]); };
  EXPECT_FALSE(holds(text_of_curve(0), "RATIONAL"));
  EXPECT_TRUE(holds(text_of_curve(1), "RATIONAL_B_SPLINE_CURVE((1.,1.,0.75,1.,1.))"));
  EXPECT_TRUE(holds(text_of_curve(4), "COMPOSITE_CURVE("));
  EXPECT_FALSE(holds(text_of_curve(5), "TRIMMED_CURVE"));  // a whole circle has no ends
  EXPECT_TRUE(holds(text_of_curve(7), "ELLIPSE("));
  EXPECT_TRUE(holds(text_of_curve(9), "B_SPLINE_CURVE_WITH_KNOTS("));
}

// A circle 1e7 sizes away: sagitta 1/8 chord^2/radius = 1.25e-8, of which a centre at 1e7 with
// steps of 1.9e-9 keeps one digit.
TEST(StepWrite, ArcsWhoseCentreTakesTheDigitsAreSplines) {
  const double kappa = 1e-7;
  const double length = 2.0 / kappa * std::asin(0.5 * kappa);
  const ArcPiece flat{{0, 0}, {1, 0}, -0.5 * kappa * length, kappa, length};
  const std::string text = written_step({"flat", std::vector<Piece>{flat}});
  EXPECT_FALSE(holds(text, "CIRCLE"));
  EXPECT_TRUE(holds(text, "B_SPLINE_CURVE"));
  // the second control point: where the tangents at the ends of the chord meet, twice the sagitta
  // below it; the point before is that of the axes
  std::size_t at = 0;
  for (int k = 0; k < 3; ++k) at = text.find("CARTESIAN_POINT('',(", at) + 20;
  const std::size_t comma = text.find(',', at);
  EXPECT_NEAR(std::stod(text.substr(at)), 0.5, 1e-12);
  EXPECT_NEAR(std::stod(text.substr(comma + 1)), -2.5e-8, 1e-20);
}

TEST(StepWrite, TheSameCurvesGiveTheSameBytes) {
  EXPECT_EQ(*step_text(all_curves()), *step_text(all_curves()));
}

void expect_refused(const std::vector<CadCurve>& curves, ErrorCode code,
                    const StepOptions& options = {}) {
  const auto text = step_text(curves, options);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, code) << to_line(text.error());
}

TEST(StepWrite, WhatStepCannotSayIsRefused) {
  expect_refused({}, ErrorCode::kNothingThere);
  expect_refused({{"none", std::vector<Piece>{}}}, ErrorCode::kNothingThere);
  expect_refused({{"unit", step_cubic()}}, ErrorCode::kBadOption, {StepSchema::kAp214, "chord", 0});
  expect_refused({{"unit", step_cubic()}}, ErrorCode::kBadOption,
                 {StepSchema::kAp214, "furlong", 0});
  expect_refused({{"clothoid", std::vector<Piece>{ClothoidPiece{{0, 0}, {1, 0}, 0, 0, 1, 1}}}},
                 ErrorCode::kUnsupported);
  expect_refused(
      {{"gap", std::vector<Piece>{LinePiece{{0, 0}, {1, 0}}, LinePiece{{2, 0}, {3, 0}}}}},
      ErrorCode::kInternal);
  NurbsCurve few = step_cubic(), back = step_cubic(), torn = step_cubic(), weight = step_cubic();
  few.knots.pop_back();
  back.knots[4] = 2.0;
  torn.points.insert(torn.points.end(), 3, Vec2{7, 1});
  torn.weights.assign(8, 1.0);
  torn.knots = {0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 1, 1, 1, 1};
  weight.weights[2] = 0.0;
  for (const NurbsCurve& none : {few, back, torn, weight}) {
    expect_refused({{"none", none}}, ErrorCode::kInternal);
  }
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    NurbsCurve point = step_cubic(), knot = step_cubic();
    point.points[1].x = bad;
    knot.knots.back() = bad;
    expect_refused({{"point", point}}, ErrorCode::kNotFinite);
    expect_refused({{"knot", knot}}, ErrorCode::kNotFinite);
    expect_refused({{"line", std::vector<Piece>{LinePiece{{0, 0}, {bad, 1}}}}},
                   ErrorCode::kNotFinite);
  }
}

}  // namespace
}  // namespace obvid
