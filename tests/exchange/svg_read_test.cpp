// SPDX-License-Identifier: Apache-2.0
#include "../common/shared_data.h"
#include "drawing_checks.h"
#include "obvid/exchange/internal/svg/read.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace obvid {
namespace {

constexpr double kPx = 25.4 / 96.0;  // mm

/// A sheet of 100 x 100 mm whose unit is 1 mm.
std::string sheet(const std::string& inside) {
  return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
         "width='100mm' height='100mm' viewBox='0 0 100 100'>" +
         inside + "</svg>";
}

Drawing read_svg_text(const std::string& text) {
  auto drawing = parse_svg(text, "test.svg");
  EXPECT_TRUE(drawing.has_value()) << drawing.error().what;
  return drawing ? *drawing : Drawing{};
}

TEST(SvgRead, MillimetresAreMillimetresAndYPointsUp) {
  const Drawing d = read_svg_text(sheet("<line x1='10' y1='20' x2='30' y2='40'/>"));
  ASSERT_EQ(d.curves.size(), 1U);
  EXPECT_EQ(d.units, "mm");
  EXPECT_TRUE(d.warnings.empty());
  expect_near(start_point(d.curves[0].pieces[0]), {10.0, 80.0});
  expect_near(end_point(d.curves[0].pieces[0]), {30.0, 60.0});
}

TEST(SvgRead, EveryUnitOfASheetHasItsLength) {
  const std::vector<std::pair<std::string, double>> units = {
      {"px", kPx},       {"", kPx},        {"in", 25.4}, {"cm", 10.0},
      {"pt", 25.4 / 72}, {"pc", 25.4 / 6}, {"Q", 0.25}};
  for (const auto& [unit, millimetres] : units) {
    const Drawing d = read_svg_text("<svg width='10" + unit + "' height='10" + unit +
                                    "' viewBox='0 0 1 1'><path d='M0 1H1'/></svg>");
    ASSERT_EQ(d.curves.size(), 1U);
    EXPECT_NEAR(end_point(d.curves[0].pieces[0]).x, 10.0 * millimetres, 1e-12) << unit;
  }
}

TEST(SvgRead, ASheetWithoutSizeIsInPixelsAndSaysSo) {
  const Drawing d = read_svg_text("<svg viewBox='0 0 200 200'><path d='M0 0H96'/></svg>");
  EXPECT_TRUE(warns(d, "1/96 in"));
  expect_near(start_point(d.curves[0].pieces[0]), {0.0, 200.0 * kPx});
  EXPECT_NEAR(end_point(d.curves[0].pieces[0]).x, 25.4, 1e-12);
}

TEST(SvgRead, AViewBoxOfAnotherShapeIsCentredInItsSheet) {
  const Drawing d = read_svg_text(
      "<svg width='200mm' height='100mm' viewBox='0 0 50 50'><path d='M0 0H50'/></svg>");
  expect_near(start_point(d.curves[0].pieces[0]), {50.0, 100.0});
  expect_near(end_point(d.curves[0].pieces[0]), {150.0, 100.0});
}

/// Both circles of radius sqrt 2 through (0, 0) and (2, 0) have their centres at (1, 1) and (1,
/// -1).
TEST(SvgRead, TheTwoFlagsChooseOneOfFourArcs) {
  const double r = std::sqrt(2.0);
  for (const bool large : {false, true}) {
    for (const bool sweep : {false, true}) {
      std::ostringstream d;
      d.precision(17);
      d << "M0 0A" << r << " " << r << " 0 " << large << sweep << "2 0";
      const Drawing drawing = read_svg_text(sheet("<path d='" + d.str() + "'/>"));
      ASSERT_EQ(drawing.curves.size(), 1U);
      const auto& arc = std::get<ArcPiece>(drawing.curves[0].pieces[0]);
      // Seen with y down, sweep 1 passes above the chord; both flags equal: the farther centre.
      const double up = sweep ? 1.0 : -1.0, height = (large ? r + 1.0 : r - 1.0) * up;
      expect_near(evaluate(arc, 0.5).point, {1.0, 100.0 + height}, 1e-9);
      EXPECT_NEAR(arc.length, r * std::numbers::pi * (large ? 1.5 : 0.5), 1e-9);
      EXPECT_NEAR(arc.kappa, -up / r, 1e-9);  // to the right over the chord: a right turn
      expect_near(arc.end, {2.0, 100.0});
    }
  }
}

TEST(SvgRead, RadiiThatDoNotReachAreScaledUpToAHalfEllipse) {
  const Drawing d = read_svg_text(sheet("<path d='M0 0A1 1 0 0 1 20 0'/>"));
  const auto& arc = std::get<ArcPiece>(d.curves[0].pieces[0]);
  EXPECT_NEAR(arc.length, 10.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(std::abs(arc.kappa), 0.1, 1e-14);
}

/// An ellipse of known centre, turned by 25 degrees: the arc from parameter 0.4 to 2.0 and the long
/// way round, in both senses.
TEST(SvgRead, ArcsOfATurnedEllipseLieOnItAndOnTheSideThatTheFlagsSay) {
  const double turned = 25.0 * std::numbers::pi / 180.0, rx = 20.0, ry = 8.0;
  const auto on_ellipse = [&](double a) {  // y down
    return Vec2{50.0, 40.0} +
           complex_product(unit_at(turned), {rx * std::cos(a), ry * std::sin(a)});
  };
  for (const bool sweep : {false, true}) {
    for (const bool large : {false, true}) {
      const double from = sweep == large ? 2.0 : 0.4, to = sweep == large ? 0.4 : 2.0;
      std::ostringstream d;
      d.precision(17);
      const Vec2 a = on_ellipse(from), b = on_ellipse(to);
      d << "M" << a.x << " " << a.y << "A20 8 25 " << large << sweep << b.x << " " << b.y;
      const Drawing drawing = read_svg_text(sheet("<path d='" + d.str() + "'/>"));
      // Parameters grow with sweep 1: 0.4 to 2.0 or 2.0 to 0.4 + 2 pi, and fall with sweep 0.
      const double short_way = 1.6, long_way = 2.0 * std::numbers::pi - 1.6;
      const double change = (large ? long_way : short_way) * (sweep ? 1.0 : -1.0);
      const auto& pieces = drawing.curves[0].pieces;
      const auto count = static_cast<double>(pieces.size());
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Vec2 expected = on_ellipse(from + change * (static_cast<double>(i) + 0.5) / count);
        const Vec2 middle = evaluate(pieces[i], 0.5).point;
        EXPECT_NEAR(middle.x, expected.x, 1e-9) << large << sweep;
        EXPECT_NEAR(100.0 - middle.y, expected.y, 1e-9) << large << sweep;
      }
    }
  }
}

/// Points of an ellipse satisfy its equation; so do those of the rational quadratics everywhere.
TEST(SvgRead, EllipsesAreExactRationalQuadratics) {
  const Drawing d = read_svg_text(sheet("<ellipse cx='50' cy='40' rx='30' ry='20'/>"));
  ASSERT_EQ(d.curves[0].pieces.size(), 4U);
  EXPECT_TRUE(d.curves[0].closed);
  for (const Piece& piece : d.curves[0].pieces) {
    for (int k = 0; k <= 10; ++k) {
      const Vec2 p = evaluate(piece, 0.1 * k).point - Vec2{50.0, 60.0};
      EXPECT_NEAR(p.x * p.x / 900.0 + p.y * p.y / 400.0, 1.0, 1e-13);
    }
  }
}

TEST(SvgRead, ARotatedAndScaledCircleStaysAnArcAndASkewedOneBecomesAnEllipse) {
  const Drawing d =
      read_svg_text(sheet("<g transform='translate(50,50) rotate(30) scale(2)'>"
                          "<circle r='7'/></g><circle r='5' transform='skewX(45)'/>"));
  ASSERT_EQ(d.curves.size(), 2U);
  for (const Piece& piece : d.curves[0].pieces) {
    const auto* arc = std::get_if<ArcPiece>(&piece);
    ASSERT_NE(arc, nullptr);
    EXPECT_NEAR(arc->kappa, -1.0 / 14.0, 1e-14);  // clockwise with y up
    EXPECT_NEAR(norm(evaluate(*arc, 0.3).point - Vec2{50.0, 50.0}), 14.0, 1e-12);
  }
  for (const Piece& piece : d.curves[1].pieces) {
    ASSERT_TRUE(std::holds_alternative<RationalBezier>(piece));
    const Vec2 p = evaluate(piece, 0.37).point;
    const double y = 100.0 - p.y, x = p.x - y;  // skewX(45): x' = x + y
    EXPECT_NEAR(x * x + y * y, 25.0, 1e-12);
  }
}

TEST(SvgRead, TransformsApplyFromRightToLeft) {
  const Drawing d =
      read_svg_text(sheet("<path transform='translate(10 0) scale(2,3) "
                          "rotate(90 1 1) matrix(1 0 0 1 5 6)' d='M0 0L1 0'/>"));
  // (0, 0) -> (5, 6) -> about (1, 1) by 90: (1 - 5, 1 + 4) = (-4, 5) -> (-8, 15) -> (2, 15)
  expect_near(start_point(d.curves[0].pieces[0]), {2.0, 85.0});
  // (1, 0) -> (6, 6) -> (-4, 6) -> (-8, 18) -> (2, 18)
  expect_near(end_point(d.curves[0].pieces[0]), {2.0, 82.0});
}

TEST(SvgRead, ATransformWithAnErrorIsNotUsedAndNamed) {
  const Drawing d = read_svg_text(sheet("<path transform='scale(2) rotate(' d='M0 0H10'/>"));
  EXPECT_TRUE(warns(d, "transform"));
  expect_near(end_point(d.curves[0].pieces[0]), {10.0, 100.0});
}

TEST(SvgRead, WhatIsNotReadAsDrawnIsCounted) {
  const std::string line = "<path d='M0 0h1'/>";
  for (const char* one :
       {"<path d='M0 0h1 x'/>", "<polygon points='0,0 1,0 z'/>", "<circle r='5x'/>",
        "<rect width='4' height='!' x='1'/>", "<use href='#none'/>",
        "<path transform='rotate(' d='M0 0h1'/>", "<path transform='scale(0)' d='M0 0h1'/>",
        "<path style='transform: scale(2)' d='M0 0h1'/>",
        "<path d='M0 0L1e308 1e308' "
        "transform='scale(1e300)'/>"}) {
    EXPECT_EQ(read_svg_text(sheet(line + one)).left_out, 1U) << one;
  }
  // what draws nothing by definition, and what is no curve
  for (const char* one : {"", "<text>a</text>", "<g display='none'><path d='M0 0h1'/></g>",
                          "<rect width='0' height='4'/>", "<image href='a.png'/>"}) {
    EXPECT_EQ(read_svg_text(sheet(line + one)).left_out, 0U) << one;
  }
}

TEST(SvgRead, RoundedRectanglesHaveFourLinesAndFourArcs) {
  const Drawing d = read_svg_text(sheet("<rect x='10' y='10' width='40' height='20' rx='5'/>"));
  ASSERT_EQ(d.curves[0].pieces.size(), 8U);
  double length = 0.0;
  for (const Piece& piece : d.curves[0].pieces) length += arc_length(piece, 1e-9);
  EXPECT_NEAR(length, 2.0 * (30.0 + 10.0) + 10.0 * std::numbers::pi, 1e-9);
}

TEST(SvgRead, ASlotIsARectangleWhoseRoundingTakesItsShortSides) {
  const Drawing d =
      read_svg_text(sheet("<rect x='0' y='0' width='40' height='20' rx='99' ry='10'/>"));
  double length = 0.0;
  for (const Piece& piece : d.curves[0].pieces) length += arc_length(piece, 1e-9);
  // rx is cut to 20: a whole ellipse of semi-axes 20 and 10 (perimeter from its elliptic integral).
  EXPECT_NEAR(length, 96.88448220547675, 1e-7);
  EXPECT_EQ(d.curves[0].pieces.size(), 4U);
}

TEST(SvgRead, EveryCommandOfPathDataRelativeOrAbsoluteMeansTheSame) {
  const Drawing d = read_svg_text(
      sheet("<path d='M10 10L20 10H30V20C30 25 35 30 40 30S50 35 50 40Q55 40 60 45T70 50'/>"
            "<path d='m10 10l10 0h10v10c0 5 5 10 10 10s10 5 10 10q5 0 10 5t10 5'/>"));
  ASSERT_EQ(d.curves.size(), 2U);
  ASSERT_EQ(d.curves[0].pieces.size(), 7U);
  ASSERT_EQ(d.curves[1].pieces.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    expect_near(evaluate(d.curves[0].pieces[i], 0.3).point,
                evaluate(d.curves[1].pieces[i], 0.3).point, 1e-12);
  }
  // S mirrors (35, 30) about (40, 30): (45, 30). T mirrors (55, 40) about (60, 45): (65, 50).
  const auto& smooth = std::get<RationalBezier>(d.curves[0].pieces[4]);
  expect_near(smooth.offset[1], {45.0, 70.0});
  const auto& quadratic = std::get<RationalBezier>(d.curves[0].pieces[6]);
  expect_near(quadratic.offset[1], {65.0, 50.0});
  EXPECT_EQ(quadratic.degree, 2);
}

TEST(SvgRead, PartsOfAPathAreCurvesAndClosingReturnsToTheirStart) {
  const Drawing d = read_svg_text(sheet("<path id='p' d='M0 0h10v10z l5 5 M50 50h10'/>"));
  ASSERT_EQ(d.curves.size(), 3U);
  EXPECT_TRUE(d.curves[0].closed);
  EXPECT_EQ(d.curves[0].label, "path p, part 1");
  EXPECT_FALSE(d.curves[1].closed);
  expect_near(start_point(d.curves[1].pieces[0]), {0.0, 100.0});
}

TEST(SvgRead, RoundingOfRelativeCommandsMakesNoTinyClosingLine) {
  const Drawing d = read_svg_text(sheet("<path d='M.1.2l.1 0 .1 .1 -.1 .1 -.1-.2z'/>"));
  EXPECT_EQ(d.curves[0].pieces.size(), 4U);
  EXPECT_EQ(end_point(d.curves[0].pieces.back()), start_point(d.curves[0].pieces.front()));
}

TEST(SvgRead, UseDrawsWhatItNamesWhereItStands) {
  const Drawing d = read_svg_text(
      sheet("<defs><path id='a' d='M0 0h1'/></defs><use xlink:href='#a' x='10' y='20'/>"
            "<symbol id='s' viewBox='0 0 10 10'><path d='M0 0h10'/></symbol>"
            "<use href='#s' x='50' y='50' width='20' height='20'/><use href='#none'/>"));
  ASSERT_EQ(d.curves.size(), 2U);
  expect_near(end_point(d.curves[0].pieces[0]), {11.0, 80.0});
  expect_near(start_point(d.curves[1].pieces[0]), {50.0, 50.0});
  expect_near(end_point(d.curves[1].pieces[0]), {70.0, 50.0});
  EXPECT_TRUE(warns(d, "'#none'"));
}

TEST(SvgRead, PrefixesHiddenGroupsTextAndForeignElementsAreUnderstood) {
  const Drawing d = read_svg_text(
      "<s:svg xmlns:s='http://www.w3.org/2000/svg' width='96' height='96'><x:path d='M0 0H9'/>"
      "<s:g style='fill:none; display: none'><s:path d='M0 0H9'/></s:g><s:text>a</s:text>"
      "<s:path d='M0 0H96'/></s:svg>");
  ASSERT_EQ(d.curves.size(), 1U);
  EXPECT_TRUE(warns(d, "hidden"));
  EXPECT_TRUE(warns(d, "'text'"));
  expect_near(end_point(d.curves[0].pieces[0]), {25.4, 25.4});
}

/// Whether a style sheet leaves a line with such marks, 1 or 0.
std::size_t shown(const std::string& css, const std::string& marks) {
  const Drawing d = read_svg_text(
      sheet("<style>" + css + "</style><path d='M0 0h1'/><path " + marks + " d='M0 1h1'/>"));
  EXPECT_FALSE(warns(d, "not understood")) << css;
  return d.curves.size() - 1;
}

// CSS 2.1, 6.4: importance, the style attribute, ids, classes, names, and what comes later.
TEST(SvgRead, StyleSheetsHideByTheCascade) {
  const struct {
    const char *css, *marks;
    bool shown;
  } cases[] = {
      {".st0{display:none;}", "class='st0'", false},
      {"\n\t.st1{fill:none}\n\t.st0{display:none;}", "class='a st0 b'", false},
      {".st0{display:none}", "class='st01'", true},
      {"path.st0 , #q{ DISPLAY : NONE }", "class='st0'", false},
      {"rect.st0{display:none}", "class='st0'", true},
      {"#q{display:none}", "id='q'", false},
      {"#q{display:none}.a{display:inline}", "id='q' class='a'", false},
      {".a{display:none}.b{display:inline}", "class='b a'", true},
      {".b{display:inline}.a{display:none}", "class='a b'", false},
      {".b.a{display:inline}.a{display:none}", "class='a b'", true},
      {".a{display:none}", "class='a' style='display:inline'", true},
      {".a{display:none!important}", "class='a' style='display:inline'", false},
      {".a{display:none ! important}", "class='a' style='display:inline !important'", true},
      {".a{display:inline}", "class='a' display='none'", true},
      {"*{visibility:hidden}path{visibility:visible}", "", true},
      {".a{visibility:hidden}", "class='a'", false},
      {".a{opacity:0}", "class='a'", false},
      {"/* .a{display:inline} */.a{display:/**/none}", "class='a'", false},
      {".a{background:url('x;}y');display:none}", "class='a'", false},
      {"svg .a{display:none}", "class='a'", false},
      {"svg > path.a{display:none}", "class='a'", false},
      {"g .a{display:none}", "class='a'", true},
      {"<![CDATA[ .a{display:none} ]]>", "class='a'", false},
      {"@font-face{font-display:swap;src:url(a)} .a{display:none}", "class='a'", false},
  };
  for (const auto& one : cases)
    EXPECT_EQ(shown(one.css, one.marks), one.shown ? 1U : 0U) << one.css;
}

TEST(SvgRead, GroupsHiddenByAClassAndRulesBehindThemAreFollowed) {
  const Drawing d = read_svg_text(
      sheet("<g class='st0'><rect class='st1' width='9' height='9'/></g><circle r='5'/>"
            "<style>.st0{display:none;} .st1{display:inline;}</style>"));
  ASSERT_EQ(d.curves.size(), 1U);
  EXPECT_TRUE(warns(d, "hidden elements (display: none)"));
  const Drawing two = read_svg_text(
      sheet("<style>.a > .b .c{display:none}</style><g class='a'><g class='b'><g><path class='c' "
            "d='M0 0h1'/></g></g></g><g class='b'><path class='c' d='M0 0h2'/></g>"));
  ASSERT_EQ(two.curves.size(), 1U);
  EXPECT_EQ(end_point(two.curves[0].pieces[0]).x, 2.0);
}

TEST(SvgRead, RulesThatMayHideAndAreNotUnderstoodAreTold) {
  for (const char* css :
       {".a:not(.b){display:none}", "[id='q']{visibility:hidden}", ".a+.b{opacity:0}",
        "@media print{.a{display:none}}", ".a{fill:red; .b{display:none}}", "@import 'a.css';"}) {
    EXPECT_TRUE(warns(
        read_svg_text(sheet(std::string("<style>") + css + "</style><path class='a' d='M0 0h1'/>")),
        "not understood"))
        << css;
  }
  EXPECT_FALSE(warns(read_svg_text(sheet("<style>a:hover{fill:red}</style><path d='M0 0h1'/>")),
                     "not understood"));
}

// A class of many words that so many rules ask for: it ends, and says so.
TEST(SvgRead, StyleSheetsOfManyRulesEnd) {
  std::string css, words, lines;
  for (int k = 0; k < 4000; ++k) {
    css += ".a.b" + std::to_string(k) + "{display:none}";
    words += " b" + std::to_string(k) + "x";
    lines += "<path class='a" + std::string(k == 0 ? "" : words.substr(0, 200)) + "' d='M0 0h1'/>";
  }
  const Drawing d = read_svg_text(sheet("<style>" + css + "</style>" + lines));
  EXPECT_EQ(d.curves.size(), 4000U);
  EXPECT_TRUE(warns(d, "too many rules"));
  EXPECT_GT(d.left_out, 0U);
}

TEST(SvgRead, AUseOfItselfAndUsesOfUsesEnd) {
  const Drawing d = read_svg_text(sheet("<g id='a'><path d='M0 0h1'/><use href='#a'/></g>"));
  EXPECT_TRUE(warns(d, "contains itself"));
  std::string bomb = "<defs><path id='u0' d='M0 0h1'/>";
  for (int level = 1; level < 30; ++level) {
    const std::string before = "<use href='#u" + std::to_string(level - 1) + "'/>";
    bomb += "<g id='u" + std::to_string(level) + "'>";
    for (int k = 0; k < 10; ++k) bomb += before;
    bomb += "</g>";
  }
  const Drawing many = read_svg_text(sheet(bomb + "</defs><use href='#u29'/>"));
  EXPECT_TRUE(warns(many, "through use"));
  EXPECT_LT(many.curves.size(), 20000U);
}

TEST(SvgRead, DeepGroupsAreLeftOutAndEntitiesOfTheFileAreNotExpanded) {
  std::string deep;
  for (int k = 0; k < 100000; ++k) deep += "<g>";
  deep += "<path d='M0 0h1'/>";
  for (int k = 0; k < 100000; ++k) deep += "</g>";
  const Drawing d = read_svg_text(sheet("<path d='M0 0h1'/>" + deep));
  EXPECT_EQ(d.curves.size(), 1U);
  EXPECT_TRUE(warns(d, "nested"));
  std::string laughs = "<?xml version='1.0'?><!DOCTYPE svg [<!ENTITY a 'M0 0h1'>";
  for (char c = 'b'; c < 'z'; ++c) {
    laughs += std::string("<!ENTITY ") + c + " '";
    for (int k = 0; k < 10; ++k) laughs += std::string("&") + static_cast<char>(c - 1) + ";";
    laughs += "'>";
  }
  const auto none = parse_svg(laughs + "]><svg><path d='&y;'/></svg>", "bomb.svg");
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, ErrorCode::kNothingThere);
}

TEST(SvgRead, NumbersBeyondTheRangeDrawNothing) {
  const Drawing d =
      read_svg_text(sheet("<path d='M0 0L1e308 1e308' transform='scale(1e300)'/>"
                          "<path d='M0 0L1e999 0'/><path d='M0 0L nan 0'/>"
                          "<path d='M0 0h1'/><circle r='NaN'/><circle r='inf'/>"));
  ASSERT_EQ(d.curves.size(), 1U);
  EXPECT_GE(d.warnings.size(), 4U);
}

TEST(SvgRead, WhatIsNoSvgIsRefusedWithThePlace) {
  const auto cut = parse_svg("<svg>\n<path d='M0 0h1'/>\n<g>", "cut.svg");
  ASSERT_FALSE(cut.has_value());
  EXPECT_EQ(cut.error().code, ErrorCode::kBadJson);
  EXPECT_EQ(cut.error().where, "cut.svg:3");
  const auto other = parse_svg("<html/>", "page.html");
  ASSERT_FALSE(other.has_value());
  EXPECT_EQ(other.error().code, ErrorCode::kUnsupported);
  EXPECT_FALSE(parse_svg("", "empty.svg").has_value());
}

// ---- public files: what stands in them, counted by hand -----------------------------------------

struct ExpectedPicture {
  const char* file;
  std::size_t curves, pieces;  ///< the frame around each picture: 1 and 4
  const char* warning;         ///< part of one that must come; empty: none but that of the size
};

constexpr ExpectedPicture kPublicPictures[] = {
    {"circle_missing-cx-attribute", 3, 12, ""},
    {"circle_missing-cy-attribute", 3, 12, ""},
    {"circle_simple-case", 3, 12, ""},
    {"ellipse_missing-rx-and-ry-attributes", 1, 4, "ellipse ellipse1 draws nothing"},
    {"ellipse_missing-rx-attribute", 2, 8, ""},
    {"ellipse_missing-ry-attribute", 2, 8, ""},
    {"ellipse_percent-values-missing-ry", 2, 8, ""},
    {"ellipse_percent-values", 2, 8, ""},
    {"ellipse_simple-case", 3, 12, ""},
    {"path_A", 1, 4, "path data have an error near \"A 5 5"},
    {"path_M-A-s", 2, 7, ""},
    {"path_M-A-t", 2, 7, ""},
    {"path_M-A-trimmed", 3, 8, ""},
    {"path_M-C", 2, 5, ""},
    {"path_M-H-H-implicit", 2, 6, ""},
    {"path_M-H-H", 2, 6, ""},
    {"path_M-H", 2, 5, ""},
    {"path_M-L-L-Z-rel", 2, 7, ""},
    {"path_M-L-L-Z", 2, 7, ""},
    {"path_M-L-Z-A", 3, 8, ""},
    {"path_M-M-implicit-M-implicit", 2, 6, ""},
    {"path_M-M-rel", 1, 4, "path path1 draws nothing"},
    {"path_M-M", 1, 4, "path path1 draws nothing"},
    {"path_M-Q-T-rel", 2, 6, ""},
    {"path_M-Q-rel-T-rel", 2, 6, ""},
    {"path_M-Q", 2, 5, ""},
    {"path_M-S", 2, 5, ""},
    {"path_M-T-T-rel", 2, 6, ""},
    {"path_M-V-V-implicit", 2, 6, ""},
    {"path_M-V", 2, 5, ""},
    {"path_empty", 1, 4, "path path1 draws nothing"},
    {"path_extra-spaces", 3, 8, ""},
    {"path_negative-large-arc-flag-value", 3, 8, "near \"a 25 25 0 -1"},
    {"path_negative-sweep-flag-value", 3, 8, "near \"a 25 25 0 1 -1"},
    {"path_no-commawsp-before-arc-flags", 3, 8, "near \"a 25 2501 025"},
    {"path_no-commawsp-between-and-after-arc-flags", 3, 10, ""},
    {"path_numeric-character-references", 3, 6, ""},
    {"path_out-of-range-large-arc-flag-value", 3, 8, "near \"a25 25 0 6"},
    {"polygon_ignore-odd-points", 3, 9, "points of a polygon have an error near \"300\""},
    {"polygon_simple-case", 3, 10, ""},
    {"polygon_stop-processing-on-invalid-data", 3, 9, "error near \"text\""},
    {"polyline_stop-processing-on-invalid-data", 3, 8, "error near \"text\""},
};

TEST(SvgPublicFiles, EachDrawsWhatItsNameSays) {
  SKIP_WITHOUT("cad_svg");
  const auto folder = shared_data() / "cad_svg";
  for (const ExpectedPicture& expected : kPublicPictures) {
    const auto path = folder / (std::string("resvg_") + expected.file + ".svg");
    const auto drawing = parse_svg(text_of_file(path), expected.file);
    ASSERT_TRUE(drawing.has_value()) << expected.file << ": " << drawing.error().what;
    std::size_t pieces = 0;
    for (const DrawnCurve& curve : drawing->curves) pieces += curve.pieces.size();
    EXPECT_EQ(drawing->curves.size(), expected.curves) << expected.file;
    EXPECT_EQ(pieces, expected.pieces) << expected.file;
    EXPECT_EQ(drawing->warnings.size() == 1U, *expected.warning == '\0') << expected.file;
    EXPECT_TRUE(warns(*drawing, expected.warning)) << expected.file << drawing->warnings.back();
  }
  const auto all = std::distance(std::filesystem::directory_iterator(folder), {});
  EXPECT_EQ(static_cast<std::size_t>(all), std::size(kPublicPictures));
}

/// In these the second shape covers the first one: the same curve written in another way.
TEST(SvgPublicFiles, TheCoveringShapeIsTheCoveredOne) {
  SKIP_WITHOUT("cad_svg");
  const auto folder = shared_data() / "cad_svg";
  for (const char* name : {"path_M-A-trimmed", "path_extra-spaces",
                           "path_no-commawsp-between-and-after-arc-flags", "polygon_simple-case"}) {
    const auto d = parse_svg(text_of_file(folder / (std::string("resvg_") + name + ".svg")), name);
    ASSERT_TRUE(d.has_value());
    const auto &a = d->curves[0].pieces, &b = d->curves[1].pieces;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      expect_near(evaluate(a[i], 0.4).point, evaluate(b[i], 0.4).point);
    }
  }
}

TEST(SvgPublicFiles, CutAnywhereTheyAreRefusedOrRead) {
  SKIP_WITHOUT("cad_svg");
  const auto folder = shared_data() / "cad_svg";
  std::size_t refused = 0;
  const std::string text = text_of_file(folder / "resvg_path_M-A-trimmed.svg");
  for (std::size_t n = 0; n + 8 < text.size(); ++n) {
    if (!parse_svg(text.substr(0, n), "cut.svg")) ++refused;
  }
  EXPECT_EQ(refused, text.size() - 8);
}

TEST(SvgRead, LayersOfInkscapeLieInEachOtherAndGroupsAreNone) {
  const std::string layer =
      "<g xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' "
      "inkscape:groupmode='layer' id='x' inkscape:label=";
  const Drawing d = read_svg_text(sheet("<path id='a' d='M0 0h1'/>" + layer +
                                        "'Part'><path id='b' d='M0 0h1'/><g id='g'>" + layer +
                                        "'Holes'><path id='c' d='M0 0h1'/></g></g></g>"));
  ASSERT_EQ(d.curves.size(), 3U);
  EXPECT_EQ(d.curves[0].layer, "");
  EXPECT_EQ(d.curves[0].label, "path a");
  EXPECT_EQ(d.curves[1].layer, "Part");
  EXPECT_EQ(d.curves[2].layer, "Part/Holes");
  EXPECT_EQ(d.curves[2].label, "path c on layer Part/Holes");
}

TEST(SvgRead, GroupsWithNamesAreLayersOfOtherPrograms) {
  const Drawing d = read_svg_text(sheet(
      "<g id='Outer'><g><path d='M0 0h1'/></g><polygon points='60,30 59.5,33.1 58.1,35.9 55.9,38.1 "
      "53.1,39.5 50,40 46.9,39.5 44.1,38.1 41.9,35.9 40.5,33.1 40,30 40.5,26.9 41.9,24.1 44.1,21.9 "
      "46.9,20.5 50,20 53.1,20.5 55.9,21.9 58.1,24.1 59.5,26.9'/></g>"));
  ASSERT_EQ(d.curves.size(), 1U);
  EXPECT_EQ(d.curves[0].layer, "Outer");
  ASSERT_EQ(d.series.size(), 1U);
  EXPECT_EQ(d.series[0].layer, "Outer");
}

}  // namespace
}  // namespace obvid
