// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/road/landxml.h"
#include "../common/programs.h"
#include "../common/shared_data.h"
#include "drawing_checks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "road_contours.h"

namespace obvid {
namespace {

std::string file_of(const std::string& inside, const std::string& unit = "meter") {
  return "<LandXML version='1.2'><Units><Metric linearUnit='" + unit +
         "'/></Units><CgPoints><CgPoint name='a'>1 2</CgPoint><CgPoint name='b'>5 6 7</CgPoint>"
         "</CgPoints><Alignments><Alignment name='A'><CoordGeom>" +
         inside + "</CoordGeom></Alignment></Alignments></LandXML>";
}

std::string line(const std::string& start, const std::string& end) {
  return "<Line><Start>" + start + "</Start><End>" + end + "</End></Line>";
}

std::string curve(const std::string& attributes, const std::string& start,
                  const std::string& centre, const std::string& end) {
  const std::string middle = centre.empty() ? "" : "<Center>" + centre + "</Center>";
  return "<Curve " + attributes + "><Start>" + start + "</Start>" + middle + "<End>" + end +
         "</End></Curve>";
}

Drawing read_landxml_text(const std::string& text) {
  auto drawing = parse_landxml(text, "test.xml");
  EXPECT_TRUE(drawing.has_value()) << drawing.error().what;
  return drawing ? *drawing : Drawing{};
}

TEST(LandXmlRead, NorthingComesFirstAndPointsMayBeNamed) {
  const Drawing d = read_landxml_text(
      file_of(line("10 20 30", "11 25") + "<Line><Start pntRef='a'/><End pntRef='b'/></Line>"));
  ASSERT_EQ(d.curves.size(), 1U);
  EXPECT_EQ(d.curves[0].label, "Alignment A");
  EXPECT_EQ(start_point(d.curves[0].pieces[0]), (Vec2{20.0, 10.0}));
  EXPECT_EQ(start_point(d.curves[0].pieces[1]), (Vec2{2.0, 1.0}));
  EXPECT_EQ(end_point(d.curves[0].pieces[1]), (Vec2{6.0, 5.0}));
  EXPECT_TRUE(d.warnings.empty());
}

TEST(LandXmlRead, UnitsAreThoseOfTheFile) {
  for (const auto& [theirs, ours] : {std::pair{"meter", "m"},
                                     {"millimeter", "mm"},
                                     {"foot", "ft"},
                                     {"USSurveyFoot", "usft"},
                                     {"inch", "in"}}) {
    EXPECT_EQ(read_landxml_text(file_of(line("0 0", "1 1"), theirs)).units, ours);
  }
  const Drawing unknown = read_landxml_text(file_of(line("0 0", "1 1"), "league"));
  EXPECT_EQ(unknown.units, Units("m", UnitSource::kAssumed));
  EXPECT_TRUE(warns(unknown, "metres are assumed"));
}

/// Around (100, 200) in x, y: from east to north and the long way round.
TEST(LandXmlRead, CurvesTurnAsTheirRotationSays) {
  const Drawing ccw =
      read_landxml_text(file_of(curve("rot='ccw' radius='10'", "200 110", "200 100", "210 100")));
  const auto& quarter = std::get<ArcPiece>(ccw.curves[0].pieces[0]);
  EXPECT_NEAR(quarter.length, 5.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(quarter.kappa, 0.1, 1e-15);
  EXPECT_NEAR(norm(evaluate(quarter, 0.5).point -
                   (Vec2{100.0, 200.0} + 10.0 * unit_at(0.25 * std::numbers::pi))),
              0.0, 1e-12);
  const Drawing cw = read_landxml_text(file_of(curve("rot='cw'", "200 110", "200 100", "210 100")));
  const auto& rest = std::get<ArcPiece>(cw.curves[0].pieces[0]);
  EXPECT_NEAR(rest.length, 15.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(rest.kappa, -0.1, 1e-15);
  // Without a centre: the short arc of the radius.
  const Drawing short_one =
      read_landxml_text(file_of(curve("rot='cw' radius='10'", "200 110", "", "210 100")));
  EXPECT_NEAR(std::get<ArcPiece>(short_one.curves[0].pieces[0]).length, 5.0 * std::numbers::pi,
              1e-9);
}

TEST(LandXmlRead, WhatCannotBeDrawnIsNamedAndCutsTheCurve) {
  const std::string good = line("0 0", "1 1");
  const std::string spiral = "<Start>0 0</Start><PI>1 1</PI><End>2 3</End></Spiral>";
  for (const std::string& bad :
       {line("0 0", "0 0"), line("0", "1 1"), line("0 x", "1 1"), line("0 nan", "1 1"),
        curve("rot='cw' radius='-3'", "0 0", "0 1", "0 2"), curve("rot='cw'", "0 0", "", "0 2"),
        curve("rot='cw' radius='1'", "0 0", "", "0 9"), curve("radius='1'", "0 0", "0 1", "0 2"),
        "<Spiral spiType='cubic' length='1' radiusStart='INF' radiusEnd='9' rot='cw'>" + spiral,
        "<Spiral spiType='clothoid' length='1' radiusStart='0' radiusEnd='9' rot='cw'>" + spiral,
        "<Spiral spiType='clothoid' length='-1' radiusStart='INF' radiusEnd='9' rot='cw'>" + spiral,
        "<Spiral spiType='bloss' length='9' radiusStart='INF' radiusEnd='1e-12' rot='cw'>" + spiral,
        "<Spiral spiType='clothoid' length='9' radiusStart='INF' radiusEnd='1e-3' rot='cw'>" +
            spiral,
        std::string("<Chain>a b</Chain>")}) {
    const Drawing d = read_landxml_text(file_of(good + "\n" + bad + good));
    EXPECT_EQ(d.curves.size(), 2U) << bad;
    EXPECT_TRUE(warns(d, "left out (line 2)")) << bad;
  }
  EXPECT_TRUE(
      warns(read_landxml_text(file_of(good +
                                      "<Spiral spiType='cubic' length='1' radiusStart='INF' "
                                      "radiusEnd='9' rot='cw'>" +
                                      spiral)),
            "'cubic'"));
}

std::string file_with_profile(const std::string& places) {
  std::string out = file_of(line("0 0", "0 600"));
  const std::string_view end = "</CoordGeom>";
  out.insert(out.find(end) + end.size(),
             "<Profile><ProfAlign name='p'>" + places + "</ProfAlign></Profile>");
  return out;
}

TEST(LandXmlRead, ProfilesAreGradesAndCurves) {
  // 2 % up to station 200, then -2 %: a parabola of 100 m, its height 2 (0.04) 100 / 8 below
  const Drawing d = read_landxml_text(file_with_profile(
      "<PVI>0 10</PVI><ParaCurve length='100'>200 14</ParaCurve><PVI>600 6</PVI>"));
  ASSERT_TRUE(d.curves[0].profile);
  const VerticalProfile& profile = *d.curves[0].profile;
  ASSERT_EQ(profile.elements.size(), 3U);
  const ProfileElement& crest = profile.elements[1];
  EXPECT_EQ(crest.kind, ProfileKind::kCrest);
  EXPECT_NEAR(crest.station, 150.0, 1e-12);
  EXPECT_NEAR(crest.length, 100.0, 1e-12);
  EXPECT_NEAR(crest.radius, -2500.0, 1e-9);
  EXPECT_NEAR(profile_at(profile, 200.0).height, 14.0 - 0.04 * 100.0 / 8.0, 1e-12);
  EXPECT_NEAR(profile.end_height, 6.0, 1e-12);
  // lengths 60 and 20 beside the corner: below it by 0.04 60 20 / (2 80)
  const Drawing unlike = read_landxml_text(file_with_profile(
      "<PVI>0 10</PVI><UnsymParaCurve lengthIn='60' lengthOut='20'>200 14</UnsymParaCurve>"
      "<PVI>600 6</PVI>"));
  ASSERT_TRUE(unlike.curves[0].profile);
  ASSERT_EQ(unlike.curves[0].profile->elements.size(), 4U);
  EXPECT_NEAR(profile_at(*unlike.curves[0].profile, 200.0).height, 14.0 - 0.04 * 60 * 20 / 160,
              1e-12);
  // an arc of 5000: tangents of 5000 tan(turn / 2), its middle 5000 (1/cos(turn / 2) - 1) below
  const Drawing round = read_landxml_text(file_with_profile(
      "<PVI>0 10</PVI><CircCurve length='200' radius='5000'>200 14</CircCurve><PVI>600 6</PVI>"));
  ASSERT_TRUE(round.curves[0].profile);
  EXPECT_EQ(round.curves[0].profile->curves, ProfileCurves::kArcs);
  const double half = std::atan(0.02);
  EXPECT_NEAR(profile_at(*round.curves[0].profile, 200.0).height,
              14.0 - 5000.0 * (1.0 / std::cos(half) - 1.0), 1e-9);
  for (const char* bad :
       {"<PVI>0 10</PVI><ParaCurve length='500'>200 14</ParaCurve><PVI>600 6</PVI>",
        "<PVI>0 10</PVI><ParaCurve>200 14</ParaCurve><PVI>600 6</PVI>",
        "<PVI>0 10</PVI><PVI>-5 10</PVI>", "<PVI>0 10</PVI><PVI>x 10</PVI>"}) {
    const Drawing none = read_landxml_text(file_with_profile(bad));
    EXPECT_FALSE(none.curves[0].profile) << bad;
    EXPECT_TRUE(warns(none, "is not used")) << bad;
  }
}

TEST(LandXmlRead, AnAlignmentInPartsHasNoProfile) {
  std::string text = file_with_profile("<PVI>0 10</PVI><PVI>600 6</PVI>");
  const std::string_view end = "</CoordGeom>";
  text.insert(text.find(end), "<Chain length='5'/>" + line("0 605", "0 700"));
  const Drawing d = read_landxml_text(text);
  ASSERT_EQ(d.curves.size(), 2U);
  for (const DrawnCurve& one : d.curves) EXPECT_FALSE(one.profile);
  EXPECT_TRUE(warns(d, "the profile of an alignment in several parts is not used"));
  // a first element without a length: where the others lie along the profile is not known
  text = file_with_profile("<PVI>0 10</PVI><PVI>600 6</PVI>");
  text.insert(text.find("<Line>"), "<Chain/>");
  const Drawing lost = read_landxml_text(text);
  ASSERT_EQ(lost.curves.size(), 1U);
  EXPECT_FALSE(lost.curves[0].profile);
  EXPECT_TRUE(warns(lost, "whose station is not known is not used"));
}

/// Two arcs of radius 10, left, an eighth and a quarter of a turn, of one name.
TEST(LandXmlRead, ArcsOfOneNameAreOneOnlyWhereTheyGoOn) {
  const double h = std::numbers::sqrt2 / 2.0;
  const auto at = [](double x, double y) { return fmt::format("{} {}", y, x); };
  const std::string first =
      curve("name='1' rot='ccw' radius='10'", at(10, 0), at(0, 0), at(10 * h, 10 * h));
  const auto pieces = [&](const std::string& second) {
    const Drawing d = read_landxml_text(file_of(first + second));
    return d.curves.empty() ? std::vector<Piece>{} : d.curves[0].pieces;
  };
  const auto whole = pieces(
      curve("name='1' rot='ccw' radius='10'", at(10 * h, 10 * h), at(0, 0), at(-10 * h, 10 * h)));
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_NEAR(std::get<ArcPiece>(whole[0]).length, 7.5 * std::numbers::pi, 1e-12);
  // a corner: its centre straight below the place where they meet
  const double x = 10 * h, y = 10 * h - 10.0;
  EXPECT_EQ(
      pieces(curve("name='1' rot='ccw' radius='10'", at(10 * h, 10 * h), at(x, y), at(x - 10.0, y)))
          .size(),
      2U);
  // a gap: the same tangent, a tenth to the right
  EXPECT_EQ(pieces(curve("name='1' rot='ccw' radius='10'", at(10 * h + 0.1, 10 * h), at(0.1, 0),
                         at(0.1 - 10 * h, 10 * h)))
                .size(),
            2U);
}

TEST(LandXmlRead, CantIsSaidToBeLeftOut) {
  std::string text = file_of(line("0 0", "0 600"));
  const std::string_view end = "</CoordGeom>";
  text.insert(text.find(end) + end.size(), "<Cant name='c'/>");
  EXPECT_TRUE(warns(read_landxml_text(text), "cant is not used"));
}

TEST(LandXmlRead, SpiralsOfOtherLawsTurnAsTheyShould) {
  // By Simpson's rule on the law itself: curvature 0 to 1/300 over 120.
  const auto share = [](const std::string& kind, double u) {
    constexpr double kPi = std::numbers::pi;
    if (kind == "bloss") return u * u * (3.0 - 2.0 * u);
    if (kind == "sinusoid") return u - std::sin(2.0 * kPi * u) / (2.0 * kPi);
    if (kind == "cosine") return 0.5 * (1.0 - std::cos(kPi * u));
    return u < 0.5 ? 2.0 * u * u : 1.0 - 2.0 * (1.0 - u) * (1.0 - u);
  };
  for (const char* kind : {"bloss", "sinusoid", "cosine", "biquadratic"}) {
    constexpr int kSlices = 20000;
    constexpr double h = 120.0 / kSlices;
    double theta = 0.0;
    Vec2 at;
    for (int i = 0; i < kSlices; ++i) {
      const double middle = theta + 0.5 * h * share(kind, (i + 0.25) / kSlices) / 300.0;
      at = at + h * Vec2{std::cos(middle), std::sin(middle)};
      theta += h * share(kind, (i + 0.5) / kSlices) / 300.0;
    }
    const Drawing d = read_landxml_text(file_of(
        fmt::format("<Spiral spiType='{}' length='120' radiusStart='INF' radiusEnd='300' rot='ccw'>"
                    "<Start>0 0</Start><PI>0 80</PI><End>{:.12f} {:.12f}</End></Spiral>",
                    kind, at.y, at.x)));
    ASSERT_EQ(d.curves.size(), 1U) << kind;
    ASSERT_EQ(d.curves[0].transitions.size(), 1U) << kind;
    EXPECT_EQ(d.curves[0].transitions[0].length, 120.0);
    EXPECT_NEAR(d.curves[0].transitions[0].kappa1, 1.0 / 300.0, 1e-15);
    EXPECT_FALSE(warns(d, "from their stated ends")) << kind;
    const auto& first = std::get<ClothoidPiece>(d.curves[0].pieces.front());
    EXPECT_NEAR(first.theta0, 0.0, 1e-7) << kind;
  }
}

TEST(LandXmlRead, ACubicParabolaHasItsOwnLengthAndRadius) {
  constexpr double c = 1.0 / 150000.0, x = 100.0;  // y = c x^3: its tangents meet at 2 x/3
  constexpr double slope = 3.0 * c * x * x;
  constexpr int kSlices = 20000;
  double length = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double middle = x * (i + 0.5) / kSlices;
    length += x / kSlices * std::hypot(1.0, 3.0 * c * middle * middle);
  }
  const auto stated = [&](double radius) {
    return read_landxml_text(
        file_of(line("0 -50", "0 0") +
                fmt::format("<Spiral spiType='cubicParabola' length='{:.12f}' radiusStart='INF' "
                            "radiusEnd='{:.12f}' rot='ccw'><Start>0 0</Start><PI>0 {:.12f}</PI>"
                            "<End>{:.12f} {:.12f}</End></Spiral>",
                            length, radius, 2.0 / 3.0 * x, c * x * x * x, x)));
  };
  const Drawing d = stated(std::pow(1.0 + slope * slope, 1.5) / (6.0 * c * x));
  ASSERT_EQ(d.curves.size(), 1U);
  ASSERT_EQ(d.curves[0].transitions.size(), 1U);
  const PlacedTransition& found = d.curves[0].transitions[0];
  EXPECT_EQ(found.kind, Transition::kCubic);
  EXPECT_FALSE(warns(d, "from their stated ends"));
  EXPECT_FALSE(warns(d, "contradicts"));
  const Vec2 inside = evaluate(d.curves[0].pieces[found.first_piece], 1.0).point;
  EXPECT_NEAR(inside.y, c * inside.x * inside.x * inside.x, 2e-5);  // 1e-7 of the length
  EXPECT_TRUE(warns(stated(120.0), "does not turn so far between its radii"));
}

TEST(LandXmlWrite, ACubicParabolaThroughItsInflectionIsTwo) {
  const Element start{{3.0, 4.0}, 0.3, -1.0 / 400.0};
  const double kappa1 = 1.0 / 300.0, length = 100.0;
  Contour contour;
  contour.units = "m";
  contour.carrier = Carrier::kImported;
  const auto pieces = clothoids_along(Transition::kCubic, start, kappa1, length, 1e-6);
  ASSERT_TRUE(pieces);
  for (const ClothoidPiece& piece : *pieces) {
    contour.joints.push_back({{piece.start, piece.theta0, piece.kappa0}, {}, {}});
    contour.pieces.emplace_back(piece);
  }
  const Element end = transition_at(Transition::kCubic, start, kappa1, length, length);
  contour.joints.push_back({end, {}, {}});
  LandXmlOptions options;
  options.transitions = {
      {0, contour.pieces.size(), Transition::kCubic, start.kappa, kappa1, length}};
  const auto text = landxml_text(contour, options);
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_EQ(text->find("clothoid"), std::string::npos);
  const Drawing d = read_landxml_text(*text);
  ASSERT_EQ(d.curves.size(), 1U);
  ASSERT_EQ(d.curves[0].transitions.size(), 2U);
  const PlacedTransition &in = d.curves[0].transitions[0], &out = d.curves[0].transitions[1];
  EXPECT_NEAR(in.kappa0, start.kappa, 1e-15);
  EXPECT_EQ(in.kappa1, 0.0);
  EXPECT_EQ(out.kappa0, 0.0);
  EXPECT_NEAR(out.kappa1, kappa1, 1e-15);
  EXPECT_NEAR(in.length + out.length, length, 1e-9);
  // of y = c x^3 from x0 to x1 with these curvatures and this length, by Powell's method and
  // adaptive quadrature elsewhere: c = 9.8250495e-6, x0 = -42.59058672, x1 = 57.34344484
  EXPECT_NEAR(in.length / length, 0.4260275720776776, 1e-9);
  EXPECT_FALSE(warns(d, "from their stated ends"));
  EXPECT_NEAR(norm(end_point(d.curves[0].pieces.back()) - end.point), 0.0, 1e-6);
}

TEST(LandXmlRead, ContradictionsAreNamed) {
  EXPECT_TRUE(
      warns(read_landxml_text(file_of(curve("rot='ccw' radius='11'", "0 10", "0 0", "10 0"))),
            "contradicts"));
  // A clothoid 0 to 1/100 over 60 ends near (59.5, 5.9); a metre more is said.
  const Drawing d = read_landxml_text(
      file_of("<Spiral spiType='clothoid' length='60' radiusStart='INF' radiusEnd='100' rot='ccw'>"
              "<Start>0 0</Start><PI>0 40</PI><End>6 60.5</End></Spiral>"));
  EXPECT_TRUE(warns(d, "from their stated ends"));
}

TEST(LandXmlRead, IrregularLinesAreLinesAndASeries) {
  const Drawing d = read_landxml_text(
      file_of("<IrregularLine><Start>0 0</Start><End>2 9</End><PntList2D>0 0 1 5 2 "
              "9</PntList2D></IrregularLine>"));
  ASSERT_EQ(d.series.size(), 1U);
  EXPECT_EQ(d.series[0].points, (std::vector<Vec2>{{0.0, 0.0}, {5.0, 1.0}, {9.0, 2.0}}));
  EXPECT_EQ(d.curves[0].pieces.size(), 2U);
}

TEST(LandXmlRead, BrokenFilesAreRefused) {
  EXPECT_EQ(parse_landxml("<LandXML>", "x").error().code, ErrorCode::kBadJson);
  EXPECT_EQ(parse_landxml("<LandXML/>", "x").error().code, ErrorCode::kNothingThere);
  EXPECT_EQ(parse_landxml("<svg/>", "x").error().code, ErrorCode::kUnsupported);
  const auto nothing_left = parse_landxml(file_of("<Chain>a b</Chain>"), "x");
  EXPECT_NE(nothing_left.error().hint.find("left out"), std::string::npos);
  std::string deep = "<LandXML>";
  for (int k = 0; k < 300000; ++k) deep += "<CoordGeom>";
  deep += "<Line/>";
  for (int k = 0; k < 300000; ++k) deep += "</CoordGeom>";
  EXPECT_EQ(parse_landxml(deep + "</LandXML>", "x").error().code, ErrorCode::kNothingThere);
}

// ---- public files
// --------------------------------------------------------------------------------

struct Counts {
  const char* file;
  const char* unit;
  std::size_t curves, lines, arcs, spirals;
  double length;  ///< chords of lines, arcs by centre and rotation, stated lengths of spirals
};

constexpr Counts kPublicAlignments[] = {{"j_landxml_sample.xml", "m", 1, 4, 5, 9, 1085.946183},
                                        {"polyline.xml", "ft", 1, 4, 1, 0, 842.538297},
                                        {"subdivision.xml", "ft", 89, 379, 73, 0, 93637.277310}};

TEST(LandXmlPublicFiles, EachHasItsElementsAndLength) {
  SKIP_WITHOUT("landxml");
  const auto folder = shared_data() / "landxml";
  for (const Counts& expected : kPublicAlignments) {
    const auto d = parse_landxml(text_of_file(folder / expected.file), expected.file);
    ASSERT_TRUE(d.has_value()) << expected.file << d.error().what;
    EXPECT_EQ(d->units, expected.unit);
    EXPECT_EQ(d->curves.size(), expected.curves) << expected.file;
    std::array<std::size_t, 4> kinds{};
    double length = 0.0;
    for (const DrawnCurve& one : d->curves) {
      for (const Piece& piece : one.pieces) {
        ++kinds[piece.index()];
        length += arc_length(piece, 1e-9);
      }
    }
    EXPECT_EQ(kinds[0], expected.lines);
    EXPECT_EQ(kinds[1], expected.arcs);
    EXPECT_EQ(kinds[3], expected.spirals);
    EXPECT_NEAR(length, expected.length, 1e-5 * expected.length) << expected.file;
  }
  const auto all = std::distance(std::filesystem::directory_iterator(folder), {});
  EXPECT_EQ(static_cast<std::size_t>(all), std::size(kPublicAlignments));
}

/// The alignment is G2 by design (INF, 250, INF, 150, ...): headings and curvatures agree at every
/// joint to the eight decimals of its coordinates, which proves rotation, order and radii.
TEST(LandXmlPublicFiles, TheJapaneseAlignmentIsCurvatureContinuous) {
  SKIP_WITHOUT("landxml/j_landxml_sample.xml");
  const auto path = shared_data() / "landxml/j_landxml_sample.xml";
  const Drawing d = read_landxml_text(text_of_file(path));
  for (const std::string& told : d.warnings) {  // of two such equations, and of nothing else
    EXPECT_EQ(told.find("a station equation (behind "), 0U) << told;
  }
  const auto& pieces = d.curves[0].pieces;
  ASSERT_EQ(pieces.size(), 18U);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const Element before = at(pieces[i - 1], 1.0), after = at(pieces[i], 0.0);
    EXPECT_EQ(before.point, after.point);
    EXPECT_NEAR(std::remainder(before.theta - after.theta, 2.0 * std::numbers::pi), 0.0, 1e-8) << i;
    EXPECT_NEAR(before.kappa, after.kappa, 1e-12) << i;
  }
}

TEST(LandXmlPublicFiles, CutAnywhereTheyAreRefused) {
  SKIP_WITHOUT("landxml/polyline.xml");
  const auto path = shared_data() / "landxml/polyline.xml";
  const std::string text = text_of_file(path);
  for (std::size_t n = 0; n < text.rfind('>'); ++n) {
    EXPECT_FALSE(parse_landxml(text.substr(0, n), "cut").has_value()) << n;
  }
}

// ---- writer
// --------------------------------------------------------------------------------------

/// A contour, the unit of its file, and what one of its own units is in that unit.
struct Written {
  Contour contour;
  std::string unit;
  double factor = 1.0;
};

/// Units that the format has stay; of the others: 1 dm = 10 cm, 1 yd = 3 ft, 1 mil = in/1000 and
/// 1 um = mm/1000, all by definition.
std::vector<Written> contours_to_write() {
  std::vector<Written> out = {{stored("clothoids_open.json"), "mm"},
                              {stored("clothoids_closed.json"), "m"},
                              {stored("clothoids_wave.json"), "ft"}};
  for (const char* unit : {"mm", "cm", "m", "km", "in", "ft", "usft", "mi"}) {
    out.push_back({every_kind(), unit});
    out.back().contour.units = unit;
  }
  for (const auto& [unit, theirs, factor] :
       {std::tuple{"dm", "cm", 10.0}, {"yd", "ft", 3.0}, {"mil", "in", 1e-3}, {"um", "mm", 1e-3}}) {
    out.push_back({every_kind(), theirs, factor});
    out.back().contour.units = unit;
  }
  return out;
}

TEST(LandXmlWrite, ContoursComeBackTheSameInTheirUnit) {
  for (const auto& [contour, unit, factor] : contours_to_write()) {
    SCOPED_TRACE(std::string(contour.units.name) + " in " + unit);
    const auto text = landxml_text(contour);
    ASSERT_TRUE(text.has_value()) << text.error().what;
    const Drawing d = read_landxml_text(*text);
    ASSERT_EQ(d.curves.size(), 1U);
    EXPECT_EQ(d.units, unit);
    EXPECT_EQ(d.curves[0].closed, contour.closed);
    for (const std::string& warning : d.warnings) ADD_FAILURE() << warning;
    expect_same_curve(contour, d.curves[0].pieces, factor);
  }
}

TEST(LandXmlWrite, FilesFollowTheSchemaAndAreSmoothInEveryUnit) {
  SKIP_WITHOUT_PROGRAM("python3");
  for (const Written& one : contours_to_write()) {
    SCOPED_TRACE(std::string(one.contour.units.name) + " in " + one.unit);
    auto text = landxml_text(one.contour, {"a <name> & \"more\"", "2024-02-29", "12:00:00"});
    ASSERT_TRUE(text.has_value());
    EXPECT_EQ(judged("check_landxml.py", *text), "");
  }
}

TEST(LandXmlWrite, TheJudgeSeesATurnToTheOtherSideAndAUnitOfTheOtherSystem) {
  SKIP_WITHOUT_PROGRAM("python3");
  std::set<bool> systems;
  for (const Written& one : contours_to_write()) {
    const auto text = landxml_text(one.contour);
    ASSERT_TRUE(text.has_value());
    const bool metric = text->find("<Metric ") != std::string::npos;
    if (!systems.insert(metric).second) continue;
    SCOPED_TRACE(one.unit);
    std::string turned = *text;
    const std::size_t rotation = turned.find("rot=\"c") + 6;
    const bool left = turned.compare(rotation, 2, "cc") == 0;
    turned.replace(rotation, left ? 1 : 0, left ? "" : "c");
    EXPECT_NE(judged("check_landxml.py", turned), "");
    std::string mixed = *text;
    mixed.replace(mixed.find(metric ? "<Metric " : "<Imperial ") + 1, metric ? 6 : 8,
                  metric ? "Imperial" : "Metric");
    EXPECT_NE(judged("check_landxml.py", mixed), "");
  }
  EXPECT_EQ(systems.size(), 2U);
}

/// Heights of polygons through PVIs, and of a parabola in one corner: by hand, at every station.
TEST(LandXmlWrite, ProfilesWithCornersComeBackTheSame) {
  struct Case {
    std::string places;
    std::vector<Vec2> heights;
  };
  const std::vector<Case> cases = {
      {"<PVI>0 10</PVI><PVI>200 14</PVI><PVI>450 -1</PVI><PVI>600 6</PVI>",
       {{0, 10}, {100, 12}, {200, 14}, {325, 6.5}, {450, -1}, {525, 2.5}, {600, 6}}},
      // a parabola from 150 to 250, a corner behind it, a corner at its end and one before it
      {"<PVI>0 10</PVI><ParaCurve length='100'>200 14</ParaCurve><PVI>400 10</PVI><PVI>600 "
       "30</PVI>",
       {{0, 10}, {150, 13}, {200, 13.5}, {250, 13}, {400, 10}, {500, 20}, {600, 30}}},
      {"<PVI>0 10</PVI><ParaCurve length='100'>200 14</ParaCurve><PVI>250 13</PVI><PVI>600 30.5"
       "</PVI>",
       {{0, 10}, {200, 13.5}, {250, 13}, {350, 18}, {600, 30.5}}},
      {"<PVI>0 0</PVI><PVI>150 13</PVI><ParaCurve length='100'>200 14</ParaCurve><PVI>600 6</PVI>",
       {{0, 0}, {75, 6.5}, {150, 13}, {200, 13.5}, {250, 13}, {600, 6}}}};
  const Contour road = Road({{0.0, 0.0}, 0.0, 0.0}).add(0.0, 0.0, 600.0).take();
  for (const Case& one : cases) {
    SCOPED_TRACE(one.places);
    const Drawing read = read_landxml_text(file_with_profile(one.places));
    ASSERT_TRUE(read.curves[0].profile);
    LandXmlOptions options;
    options.profile = read.curves[0].profile;
    Contour metres = road;
    metres.units = "m";
    const auto text = landxml_text(metres, options);
    ASSERT_TRUE(text.has_value()) << text.error().what;
    const Drawing again = read_landxml_text(*text);
    ASSERT_TRUE(again.curves[0].profile);
    for (const Vec2 at : one.heights) {
      EXPECT_NEAR(profile_at(*read.curves[0].profile, at.x).height, at.y, 1e-12) << at.x;
      EXPECT_NEAR(profile_at(*again.curves[0].profile, at.x).height, at.y, 1e-12) << at.x;
    }
    EXPECT_NEAR(again.curves[0].profile->end_height, one.heights.back().y, 1e-12);
  }
}

/// Without the names by which reading knows parts of one element.
std::string without_names(std::string text) {
  const std::string name = " name=\"1\"";
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name)) {
    text.erase(at, name.size());
  }
  return text;
}

TEST(LandXmlWrite, SpiralsThroughAnInflectionAndLargeTurnsAreCut) {
  const Contour wave = Road({{0.0, 0.0}, 0.0, 0.0}).add(0.01, -0.02, 60.0).take();
  const auto text = landxml_text(wave);
  ASSERT_TRUE(text.has_value());
  const Drawing d = read_landxml_text(without_names(*text));
  ASSERT_EQ(d.curves[0].pieces.size(), 2U);
  const auto& first = std::get<ClothoidPiece>(d.curves[0].pieces[0]);
  const auto& second = std::get<ClothoidPiece>(d.curves[0].pieces[1]);
  EXPECT_NEAR(first.length, 20.0, 1e-12);
  EXPECT_EQ(first.kappa1, 0.0);
  EXPECT_EQ(second.kappa0, 0.0);
  const Drawing whole = read_landxml_text(*text);
  ASSERT_EQ(whole.curves[0].pieces.size(), 1U);
  const auto& one = std::get<ClothoidPiece>(whole.curves[0].pieces[0]);
  EXPECT_NEAR(one.length, 60.0, 1e-12);
  EXPECT_NEAR(one.kappa0, 0.01, 1e-15);
  EXPECT_NEAR(one.kappa1, -0.02, 1e-15);
  const Contour round = Road({{0.0, 0.0}, 0.0, 0.0}).add(0.1, 0.1, 60.0).take();
  const auto again = read_landxml_text(without_names(*landxml_text(round)));  // outlives the loop
  EXPECT_EQ(again.curves[0].pieces.size(), 2U);                               // six radians
  for (const Piece& piece : again.curves[0].pieces) {
    const auto& arc = std::get<ArcPiece>(piece);
    EXPECT_NEAR(arc.kappa * arc.length, 3.0, 1e-12);
  }
}

TEST(LandXmlWrite, ASpiralIsOneUpToAHundredAndFiftyDegrees) {
  // (k0 + k1) / 2 * length: how far it turns
  const auto parts = [](double k0, double k1, double degrees) {
    const double length = degrees * std::numbers::pi / 180.0 / std::abs(0.5 * (k0 + k1));
    const auto text = landxml_text(Road({{7.0, -3.0}, 0.4, k0}).add(k0, k1, length).take());
    EXPECT_EQ(read_landxml_text(*text).curves[0].pieces.size(), 1U);  // one again when read
    std::vector<double> turns;
    const Drawing cut = read_landxml_text(without_names(*text));
    for (const Piece& piece : cut.curves[0].pieces) {
      const auto& one = std::get<ClothoidPiece>(piece);
      turns.push_back(0.5 * (one.kappa0 + one.kappa1) * one.length * 180.0 / std::numbers::pi);
    }
    return turns;
  };
  EXPECT_EQ(parts(0.0, 0.02, 50.0).size(), 1U);
  EXPECT_EQ(parts(0.02, 0.0, 100.0).size(), 1U);
  EXPECT_EQ(parts(-0.01, -0.05, 149.0).size(), 1U);
  for (const auto& [k0, k1] : {std::pair{0.0, 0.02}, std::pair{0.05, 0.01}}) {
    const std::vector<double> turns = parts(k0, k1, 200.0);
    ASSERT_EQ(turns.size(), 2U);
    EXPECT_NEAR(turns[0], 100.0, 1e-6);
    EXPECT_NEAR(turns[1], 100.0, 1e-6);
  }
}

TEST(LandXmlWrite, OtherContoursAreRefusedWithTheWayOut) {
  Contour contour;
  contour.units = "m";
  RationalBezier bezier;
  bezier.degree = 1;
  contour.pieces.emplace_back(bezier);
  const auto refused = landxml_text(contour);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(refused.error().hint.find("fit --carrier clothoids"), std::string::npos);
}

}  // namespace
}  // namespace obvid
