// SPDX-License-Identifier: Apache-2.0
// Printed sentences, files of other formats, given data, known truth: each doctored once.
#include <algorithm>
#include <cmath>

#include "doctored.h"
#include "drawing.h"
#include "input.h"
#include "sentences.h"
#include "series.h"

namespace judge {
namespace {

struct Case {
  ReadContour read = read_contour(data("judge/series10.json"));
  Course course{read.contour};
};

Sheet of_fit(const std::string& text) {
  const Case one;
  judge::Run run;
  run.input_name = "points.csv";
  run.out = text;
  Sheet sheet;
  check_fit_text(one.course, run, sheet);
  return sheet;
}

TEST(JudgeTexts, ComparesFiguresToTheDigitsPrinted) {
  EXPECT_TRUE(prints("0.6047", 0.60474));
  EXPECT_TRUE(prints("0.6048", 0.60474));  // a bound may be rounded up
  EXPECT_FALSE(prints("0.6046", 0.60474));
  EXPECT_FALSE(prints("0.6049", 0.60474));
  EXPECT_TRUE(prints("-5.1e-05", -5.12e-5));
  EXPECT_TRUE(prints("279001977.0926", 279001977.09265));  // a tie, the double below it
  EXPECT_FALSE(prints("279001977.0925", 279001977.09265));
  EXPECT_FALSE(prints("5.1e-05", -5.12e-5));
  EXPECT_TRUE(prints("-", std::nullopt));
  EXPECT_FALSE(prints("0", std::nullopt));
  EXPECT_FALSE(prints("-", 0.0));
  EXPECT_FALSE(prints("0", 1e-12));
  EXPECT_TRUE(prints("3", 3.0));
  EXPECT_FALSE(prints("3", 2.0));  // one vertex more is no rounding
}

TEST(JudgeTexts, BoundsAreNeverRoundedDown) {
  EXPECT_TRUE(bounds("0.011", 0.0105));
  EXPECT_TRUE(bounds("0.0105", 0.0105));
  EXPECT_FALSE(bounds("0.010", 0.0103));
  EXPECT_FALSE(bounds("0.012", 0.0105));
}

TEST(JudgeTexts, TakesTheFiguresOutOfASentence) {
  const Sentence s = sentence_of("1.885 mm from the points alone (points 4-5)", "mm");
  EXPECT_EQ(s.shape, "# U from the point alone (point #-#)");
  EXPECT_EQ(s.figures, (std::vector<std::string>{"1.885", "4", "5"}));
}

/// A line of 3, then half a circle of radius 2 to the left; one point of each stands off by 0.002
/// and 0.003. The figures are those of this drawing.
TEST(JudgeTexts, FindsEveryDoctoredFigureOfLinesAndArcs) {
  ContourFile file;
  file.units = "mm";
  file.units_source = "given";
  file.carrier = "spiral";
  file.pieces = {Line{{0, 0}, {3, 0}}, Arc{{3, 0}, {3, 4}, 0.0, 0.5, 2.0 * std::acos(-1.0)}};
  const double side = std::sqrt(2.0);
  file.points = {{0, 0},     {1, 0.001},           {2, -0.002}, {3, 0}, {3 + side, 2 - side},
                 {5.003, 2}, {3 + side, 2 + side}, {3, 4}};
  file.elements.resize(3);
  for (const auto& [at, source] : {std::pair{0U, 0U}, std::pair{1U, 3U}, std::pair{2U, 7U}}) {
    file.elements[at].point = file.points[source];
    file.elements[at].source = source;
  }
  const Course course(file);
  const auto found = [&](const std::string& table) {
    Sheet sheet;
    LinesAndArcsTable rows(course, sheet);
    for (const std::string& line : lines_of(table)) {
      const std::vector<std::string> words = words_of(line);
      words[0].find('-') == std::string::npos ? rows.header(line) : rows.row(words);
    }
    rows.end();
    EXPECT_EQ(std::count_if(sheet.findings().begin(), sheet.findings().end(),
                            [](const Finding& f) { return f.kind == Finding::Kind::kUnjudged; }),
              0);
    return sheet;
  };
  const std::string sound =
      "line or arc              centre           heading            farthest\n"
      "points         radius       x        y   at start    length     point\n"
      "1-4          straight       -        -          0    3.0000  0.002000\n"
      "4-8            2.0000  3.0000   2.0000          0    6.2832  0.003000\n";
  EXPECT_EQ(all_false(found(sound)), "");
  const struct {
    const char *what, *by;
  } kDoctored[] = {{"straight       -", "straight       1"},
                   {"straight", "1000"},
                   {"3.0000  0.002000", "3.0002  0.002000"},
                   {"0.002000", "0.001000"},
                   {" 2.0000  3.0000", "-2.0000  3.0000"},
                   {"2.0000  3.0000", "2.0000  3.0002"},
                   {"  2.0000          0", "  2.0002          0"},
                   {"0    6.2832", "180.00    6.2832"},
                   {"6.2832", "6.2834"},
                   {"0.003000", "0.003003"},
                   {"4-8 ", "4-7 "},
                   {"1-4          straight       -        -          0    3.0000  0.002000\n", ""}};
  for (const auto& one : kDoctored) {
    EXPECT_GT(found(changed(sound, one.what, one.by)).wrong(), 0) << one.what;
  }
}

/// Pages of series10's own contour file; the figures are those of the file.
TEST(JudgeTexts, FindsEveryDoctoredFigureOfAPage) {
  const Case one;
  const auto found = [&](const std::string& page) {
    Sheet sheet;
    check_page(one.course, page, sheet);
    return sheet;
  };
  const auto figure_row = [](const char* label, const char* value) {
    return std::string("<tr><th scope=\"row\">") + label + "</th><td>" + value + "</td></tr>\n";
  };
  std::string page =
      "<!DOCTYPE html>\n<p id=\"verdict\" class=\"kept\">proved: monotone curvature on every run, "
      "G2 "
      "joints, inside the region</p>\n<svg>"
      "<text x=\"9\" class=\"fact\" text-anchor=\"end\">0 vertices (at least 0 unless a curve "
      "winds) · 0 inflections · "
      "region "
      "width 8.3·10⁻⁴ mm</text><text class=\"verdict good\">✓ proved</text></svg>"
      "<table id=\"figures\"><caption>Figures</caption>\n<tbody>\n";
  page += figure_row("contour", "9 pieces through 10 points in 1 run");
  page += figure_row("carrier", "spiral") + figure_row("lengths in", "mm");
  page += figure_row("vertices", "0 (curvature extrema, at least 0 unless a curve winds)");
  page += figure_row("inflections", "0");
  page += figure_row("largest width of the region", "0.0008333 mm (tolerance 0.0008398)");
  page += figure_row("bound needed", "52 inserted elements");
  page +=
      "</tbody></table>\n<table id=\"segments\" class=\"numbers\"><caption>Segments</caption>\n"
      "<thead><tr><th>points</th><th>chord</th><th>points-only error</th><th>region width</th>"
      "<th>largest error</th><th>inserted elements</th></tr></thead>\n<tbody>\n";
  const Json& rows = member(one.read.contour.report, "segments");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    page += "<tr><td>" + std::to_string(k + 1) + "-" + std::to_string(k + 2) + "</td>";
    for (const char* name : {"chord", "points_only_error", "width", "deviation", "inserted"}) {
      const Figure value = figure(rows[k], name);
      page += "<td>" + (value.value ? shown(*value.value) : std::string("-")) + "</td>";
    }
    page += "</tr>\n";
  }
  page += "</tbody></table>\n";
  EXPECT_EQ(all_false(found(page)), "");
  const struct {
    const char *what, *by;
  } kDoctored[] = {{"proved: monotone", "NOT proved: monotone"},
                   {"0 vertices (at", "1 vertex (at"},
                   {"winds) · 0 inflections", "winds) · 1 inflection"},
                   {"8.3·10⁻⁴", "8.1·10⁻⁴"},
                   {"8.3·10⁻⁴", "8.3·10⁻³"},
                   {"✓", "✗"},
                   {"9 pieces through", "8 pieces through"},
                   {"10 points", "11 points"},
                   {"<td>mm<", "<td>in<"},
                   {"<td>spiral<", "<td>arcs<"},
                   {"<td>0 (curv", "<td>2 (curv"},
                   {"0.0008333 mm", "0.0008303 mm"},
                   {"0.0008398", "0.0008390"},
                   {"52 inserted", "51 inserted"},
                   {"<td>3-4</td><td>", "<td>3-4</td><td>1"}};
  for (const auto& each : kDoctored) {
    EXPECT_GT(found(changed(page, each.what, each.by)).wrong(), 0) << each.what;
  }
}

TEST(JudgeTexts, FindsEveryDoctoredFigureOfTheReport) {
  const std::string sound = data("judge/series10.txt");
  EXPECT_EQ(all_false(of_fit(sound)), "");
  const struct {
    const char *what, *by;
  } kDoctored[] = {{"9 pieces", "8 pieces"},
                   {"10 points in", "11 points in"},
                   {"1 run\n", "2 runs\n"},
                   {"0 vertices (", "1 vertices ("},
                   {"at least 0 unless", "at least 1 unless"},
                   {"), 0 inflections", "), 2 inflections"},
                   {"1.885 mm from", "1.883 mm from"},
                   {"(points 4-5, ", "(points 3-4, "},
                   {"unknown over 2 segments", "unknown over 1 segment"},
                   {"0.5912 mm with", "0.5900 mm with"},
                   {"0.0008333 mm", "0.0008331 mm"},
                   {"(tolerance 0.0008398)", "(tolerance 0.0008390)"},
                   {"52 inserted", "50 inserted"},
                   {"heading 6.7e-16", "heading 6.2e-16"},
                   {"curvature 1.1e-14", "curvature 1.1e-15"},
                   {"-6.9602", "-6.9600"},
                   {"0.9426", "0.9422"},
                   {"15.569", "15.566"},
                   {"0.0006424         5", "0.0006424         4"},
                   {"lengths in mm", "lengths in in"},
                   {"proved: monotone", "NOT proved: monotone"},
                   {"G2 joints", "G1 joints"}};
  for (const auto& one : kDoctored) {
    EXPECT_GT(of_fit(changed(sound, one.what, one.by)).wrong(), 0) << one.what;
  }
}

/// What is false about the joints in a verdict on pieces that are a proved G3 contour otherwise.
std::string joints_of_verdict(ContourFile file, const std::string& joints) {
  file.carrier = "spiral";
  file.continuity = "G3";
  file.certificate = read_json(R"({"proved": true, "joint_gaps": {"slope": 0}})").value;
  file.points = {{0, 0}, {4, 4}};
  const Course course(file);
  judge::Run run;
  run.out = "proved: monotone curvature on every run, " + joints + ", inside the region\n";
  Sheet sheet;
  check_fit_text(course, run, sheet);
  return all_false(sheet);
}

// The parabola y = x^2 from 0 to 1 to 2 to 3 in Bernstein form: one curve, whatever is said of it.
ContourFile parabola() {
  ContourFile file;
  for (const double x : {0.0, 1.0, 2.0}) {
    const std::vector<Point> points = {
        {x, x * x}, {x + 0.5, x * x + x}, {x + 1.0, (x + 1.0) * (x + 1.0)}};
    file.pieces.emplace_back(Bezier{{}, points, {1, 1, 1}, points});
  }
  file.elements.resize(4);
  return file;
}

TEST(JudgeTexts, JointsAreCalledAsTheMostContinuousOfThem) {
  ContourFile file = parabola();
  EXPECT_EQ(joints_of_verdict(file, "G3 joints"), "");
  for (const char* wrong : {"G2 joints", "G1 joints", "no joints", "corners alone",
                            "G3 joints but for 1 that is G2", "G3 joints between 2 corners",
                            "G3 joints but for 1 that is G1 with a step of the curvature"}) {
    EXPECT_NE(joints_of_verdict(file, wrong), "") << wrong;
  }
  file.elements[1].slope_step = true;
  EXPECT_EQ(joints_of_verdict(file, "G3 joints but for 1 that is G2"), "");
  EXPECT_NE(joints_of_verdict(file, "G3 joints but for 2 that are G2"), "");
  EXPECT_NE(joints_of_verdict(file, "G3 joints"), "");
  file.elements[2].slope_step = true;
  EXPECT_EQ(joints_of_verdict(file, "G2 joints"), "");
  EXPECT_NE(joints_of_verdict(file, "G3 joints but for 2 that are G2"), "");
  file.elements[2].slope_step = false;
  file.elements[2].step = true;
  EXPECT_EQ(joints_of_verdict(file, "G2 joints but for 1 that is G1 with a step of the curvature"),
            "");
  file.elements[1].step = true;
  EXPECT_EQ(joints_of_verdict(file, "G1 joints with steps of the curvature"), "");
  file.elements[1].corner = file.elements[2].corner = true;
  EXPECT_EQ(joints_of_verdict(file, "corners alone"), "");
  EXPECT_NE(joints_of_verdict(file, "G3 joints between 2 corners"), "");
  file.pieces.resize(1);
  file.elements.resize(2);
  EXPECT_EQ(joints_of_verdict(file, "no joints"), "");
  EXPECT_NE(joints_of_verdict(file, "G3 joints"), "");
}

/// An end whose slope differs is no G3 joint, whatever the file says: a line goes on as y = x^3,
/// whose slope of the curvature begins with 6.
TEST(JudgeTexts, JointsAreOfTheOrderThatTheirGapsSay) {
  ContourFile file;
  const std::vector<Point> cubic = {{0, 0}, {1.0 / 3.0, 0}, {2.0 / 3.0, 0}, {1, 1}};
  file.pieces = {Line{{-1, 0}, {0, 0}}, Bezier{{}, cubic, {1, 1, 1, 1}, cubic}};
  file.elements.resize(3);
  EXPECT_EQ(joints_of_verdict(file, "G2 joints"), "");
  EXPECT_NE(joints_of_verdict(file, "G3 joints"), "");
}

TEST(JudgeTexts, TellsSentencesThatItDoesNotKnow) {
  const std::string sound = data("judge/series10.txt");
  const auto unjudged = [](const Sheet& sheet) {
    long sum = 0;
    for (const auto& [claim, n] : sheet.counts()) sum += n.unjudged;
    return sum;
  };
  EXPECT_EQ(unjudged(of_fit(sound)), 0);
  EXPECT_EQ(unjudged(of_fit(sound + "smoothness  7 of 10\n")), 1);
}

TEST(JudgeTexts, FindsDoctoredSentencesOfVerify) {
  const Case one;
  const auto of = [&](const std::string& text) {
    judge::Run run;
    run.out = text;
    Sheet sheet;
    check_verify_text(one.course, run, sheet);
    return sheet;
  };
  const std::string sound = data("judge/series10.verify.txt");
  EXPECT_EQ(all_false(of(sound)), "");
  EXPECT_GT(of(changed(sound, "inside the region   yes", "inside the region   no")).wrong(), 0);
  EXPECT_GT(of(changed(sound, "9 increasing", "8 increasing")).wrong(), 0);
  EXPECT_GT(of(changed(sound, "bezier  increasing", "bezier  decreasing")).wrong(), 0);
  EXPECT_GT(of(changed(sound, "self-intersections  0", "self-intersections  1")).wrong(), 0);
}

TEST(JudgeTexts, ExitCodesMustFitTheReport) {
  const Case one;
  Sheet sheet;
  judge::Run run;
  run.code = 0;
  check_exit(&one.course, run, sheet);
  EXPECT_EQ(sheet.wrong(), 0);
  run.code = 5;
  check_exit(&one.course, run, sheet);
  EXPECT_EQ(sheet.wrong(), 1);
  run.code = 4;
  run.err.clear();
  check_exit(nullptr, run, sheet);
  EXPECT_EQ(sheet.wrong(), 2);  // a refusal without a word
}

Sheet of_export(const std::string& name, const std::string& text, const std::string& note) {
  const Case one;
  Sheet sheet;
  check_export(one.course, name, text, {note}, sheet);
  return sheet;
}

TEST(JudgeTexts, FindsStepFilesOfAnotherCurveOrUnit) {
  const std::string step = data("judge/series10.step");
  const std::string note = "one NURBS curve of degree 6, 47 control points";
  EXPECT_EQ(all_false(of_export("a.step", step, note)), "");
  EXPECT_GT(
      of_export("a.step", changed(step, "-5.829641661304633", "-5.829651661304633"), note).wrong(),
      0);
  EXPECT_GT(
      of_export("a.step", changed(step, "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"), note)
          .wrong(),
      0);
  EXPECT_GT(of_export("a.step", changed(step, "DATA;", "NOTHING;"), note).wrong(), 0);
}

// A line of 2, a quarter of a circle of radius 1 to the left, and a whole circle of radius 5 that
// runs to the right, by the definitions of ISO 10303-42.
TEST(JudgeTexts, ReadsCompositeCurvesAndWholeCirclesOfStep) {
  const std::string head =
      "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=DIRECTION('',(0.,0.,1.));\n"
      "#2=DIRECTION('',(1.,0.,0.));\n#3=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
      "#4=CARTESIAN_POINT('',(0.,0.,0.));\n#5=VECTOR('',#2,1.);\n#6=LINE('',#4,#5);\n"
      "#7=TRIMMED_CURVE('',#6,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(2.)),.T.,.PARAMETER.);\n"
      "#8=CARTESIAN_POINT('',(2.,1.,0.));\n#9=DIRECTION('',(0.,-1.,0.));\n"
      "#10=AXIS2_PLACEMENT_3D('',#8,#1,#9);\n#11=CIRCLE('',#10,1.);\n"
      "#12=TRIMMED_CURVE('',#11,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.5707963267948966)),.T.,"
      ".PARAMETER.);\n#13=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#7);\n"
      "#14=COMPOSITE_CURVE_SEGMENT(.DISCONTINUOUS.,.T.,#12);\n"
      "#15=COMPOSITE_CURVE('',(#13,#14),.U.);\n#16=DIRECTION('',(0.,0.,-1.));\n"
      "#17=AXIS2_PLACEMENT_3D('',#4,#16,#2);\n#18=CIRCLE('',#17,5.);\n";
  const auto drawn = [&](const std::string& curve) {
    return judge::read_step(
        head + "#19=GEOMETRIC_CURVE_SET('',(" + curve + "));\nENDSEC;\nEND-ISO-10303-21;\n", {0, 0},
        "mm");
  };
  const judge::Drawing joined = drawn("#15");
  ASSERT_EQ(joined.fault, "");
  ASSERT_EQ(joined.spans.size(), 2U);
  EXPECT_NEAR(static_cast<double>(joined.spans[0].point(1.0L).x), 2.0, 1e-15);
  EXPECT_NEAR(static_cast<double>(joined.spans[1].point(1.0L).x), 3.0, 1e-15);
  EXPECT_NEAR(static_cast<double>(joined.spans[1].point(1.0L).y), 1.0, 1e-15);
  const judge::Drawing whole = drawn("#18");
  ASSERT_EQ(whole.fault, "");
  ASSERT_EQ(whole.spans.size(), 1U);
  EXPECT_NEAR(static_cast<double>(whole.spans[0].point(0.25L).y), -5.0, 1e-14);
  EXPECT_NEAR(static_cast<double>(whole.spans[0].point(1.0L).x), 5.0, 1e-14);
}

TEST(JudgeTexts, FindsGcodeThatLeavesTheContourOrMiscounts) {
  const std::string nc = data("judge/series10.nc");
  const std::string note = "30 blocks, 30 of them arcs, at most 0.00473 mm from the contour";
  EXPECT_EQ(all_false(of_export("a.nc", nc, note)), "");
  const auto found = [&](const std::string& text, const std::string& told) {
    return of_export("a.nc", text, told).wrong() > 0;
  };
  EXPECT_TRUE(found(changed(nc, "X-20.1438", "X-20.1638"), note));
  EXPECT_TRUE(found(changed(nc, "G21", "G20"), note));
  EXPECT_TRUE(found(changed(nc, "G2 X227", "G3 X227"), note));
  EXPECT_TRUE(found(nc, "31 blocks, 30 of them arcs, at most 0.00473 mm from the contour"));
  EXPECT_TRUE(found(nc, "30 blocks, 29 of them arcs, at most 0.00473 mm from the contour"));
  EXPECT_TRUE(found(nc, "30 blocks, 30 of them arcs, at most 0.00373 mm from the contour"));
}

TEST(JudgeTexts, FindsDxfOfAnotherCurve) {
  const std::string dxf = data("judge/series10.dxf");
  EXPECT_EQ(all_false(of_export("a.dxf", dxf, "1 entity, exact")), "");
  EXPECT_GT(of_export("a.dxf", changed(dxf, "-5.829641661304633", "-5.829651661304633"),
                      "1 entity, exact")
                .wrong(),
            0);
}

/// The sound contour, with a unit that nobody stated.
struct AssumedUnit {
  ReadContour read = read_contour(changed(
      data("judge/series10.json"), "\"units_source\": \"given\"", "\"units_source\": \"assumed\""));
  Course course{read.contour};
};

TEST(JudgeTexts, AUnitThatNobodyStatedIsNotPrinted) {
  const AssumedUnit one;
  const Course& course = one.course;
  judge::Run run;
  run.input_name = "points.csv";
  run.out = "lengths in units\nlargest move  0 units\n";
  Sheet right;
  check_fit_text(course, run, right);
  EXPECT_EQ(all_false(right), "");
  EXPECT_EQ(right.counts().at("text: largest move").judged, 1);
  run.out = "lengths in mm\n";
  Sheet wrong;
  check_fit_text(course, run, wrong);
  EXPECT_TRUE(wrong.has("text: unit"));
}

TEST(JudgeTexts, DxfStatesNoUnitThatNobodyStated) {
  const AssumedUnit one;
  const Course& course = one.course;
  const std::string sound = data("judge/series10.dxf");
  Sheet stated, none, note;
  check_export(course, "c.dxf", sound, {"1 entity, exact"}, stated);
  EXPECT_TRUE(stated.has("export dxf unit"));
  check_export(course, "c.dxf", changed(sound, "$INSUNITS", "$NOTHING"),
               {"1 entity, exact", "no unit is stated in the DXF file"}, none);
  EXPECT_EQ(all_false(none), "");
  const Case known;
  check_export(known.course, "c.dxf", sound, {"no unit is stated in the DXF file"}, note);
  EXPECT_TRUE(note.has("export dxf unit note"));
}

TEST(JudgeTexts, WithoutAFileTheExitCodeAndTheMessageSayWhy) {
  const auto of_exit = [](int code, const std::string& err) {
    judge::Run run;
    run.code = code;
    run.err = err;
    Sheet sheet;
    check_exit(nullptr, run, sheet);
    return sheet.has("exit code");
  };
  EXPECT_FALSE(of_exit(4, "obvid: error E401: no"));
  EXPECT_FALSE(of_exit(5, "obvid: error E502: no program with 4 decimals"));
  EXPECT_TRUE(of_exit(5, "obvid: error E501: not proved"));
  EXPECT_TRUE(of_exit(0, ""));
  EXPECT_TRUE(of_exit(4, ""));
}

Sheet of_input(const std::string& points, const std::vector<std::string>& options) {
  const Case one;
  Sheet sheet;
  check_input(one.course, read_input(points, options), sheet);
  return sheet;
}

TEST(JudgeTexts, FindsGivenDataThatAreNotKept) {
  const std::string points = data("judge/points.csv");
  EXPECT_EQ(all_false(of_input(points, {"--units", "mm"})), "");
  EXPECT_TRUE(of_input(points, {"--units", "in"}).has("units"));
  EXPECT_TRUE(of_input(points, {}).has("units_source"));  // nobody said mm
  const std::string named = changed(points, "x,y", "x_mm,y [mm]");
  EXPECT_FALSE(of_input(named, {}).has("units"));
  EXPECT_TRUE(of_input(named, {}).has("units_source"));  // the file says that the user gave mm
  EXPECT_TRUE(of_input(changed(points, "x,y", "x_in,y_in"), {}).has("units"));
  EXPECT_TRUE(of_input(points, {"--closed"}).has("closed"));
  EXPECT_TRUE(of_input(points, {"--carrier", "arcs"}).has("carrier"));
  EXPECT_TRUE(of_input(points, {"--tolerance", "0.01"}).has("report.tolerance"));
  EXPECT_TRUE(of_input(points, {"--heading-at", "5=90"}).has("given.heading"));
  EXPECT_TRUE(of_input(points, {"--start-radius=-5"}).has("given.curvature"));
  EXPECT_TRUE(of_input(points, {"--kappa-at=10=0"}).has("given.curvature"));
  EXPECT_TRUE(of_input(points, {"--heading-at", "5=85..90"}).has("given.heading_range"));
  EXPECT_FALSE(of_input(points, {"--heading-at", "5=75..90"}).has("given.heading_range"));
  EXPECT_TRUE(of_input(points, {"--start-radius=-5..-4"}).has("given.kappa_range"));
  EXPECT_FALSE(of_input(points, {"--start-radius=-6..-5"}).has("given.kappa_range"));
  EXPECT_FALSE(of_input(points, {"--start-radius=..-5"}).has("given.kappa_range"));
  EXPECT_TRUE(of_input(points, {"--kappa-at=10=-1..-0.1"}).has("given.kappa_range"));
  EXPECT_FALSE(of_input(points, {"--kappa-at=10=..0"}).has("given.kappa_range"));
  EXPECT_TRUE(of_input(points + "240,-60\n", {}).has("points"));
  EXPECT_TRUE(of_input(changed(points, "-20.48", "-20.49"), {}).has("points"));
}

TEST(JudgeTexts, AValueAndRangesOfOnePointHoldTogether) {
  const Input input = read_input(
      "0,0\n1,0\n2,1\n", {"--end-heading=10..60", "--heading-at=3=45", "--heading-at", "3=40..90"});
  const GivenPoint& last = input.points.back();
  ASSERT_TRUE(last.heading && last.headings);
  EXPECT_NEAR(*last.heading, 0.25 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(last.headings->least, std::numbers::pi * 2.0 / 9.0, 1e-15);
  EXPECT_NEAR(last.headings->greatest, std::numbers::pi / 3.0, 1e-15);
}

TEST(JudgeTexts, FindsMovesAndCountsThatTheAdvisedContourHasNot) {
  ContourFile advised;
  advised.points = {{0.0, 0.0}, {1.0, 2.0}, {3.0, 1.0}};
  advised.report =
      read_json(R"({"vertices": 2, "inflections": 1, "moves": [0.125, 0, 0.25]})").value;
  judge::Run refused;
  refused.err = "no point is in the way: with 2 vertices and 1 inflection there is one: --noise 1";
  refused.out =
      "points that would have to move, the farthest first; lengths in mm\n\n"
      "point  x  y  move\n    3  3.000  1.000  0.25000\n    1  0  0  0.1250\n";
  const auto judged = [&] {
    Sheet sheet;
    check_advised(refused, advised, sheet);
    return all_false(sheet);
  };
  EXPECT_EQ(judged(), "");
  const judge::Run sound = refused;
  refused.out = changed(sound.out, "0.25000", "0.26000");
  EXPECT_NE(judged(), "");
  refused.out = changed(sound.out, "3.000  1.000", "3.000  1.010");
  EXPECT_NE(judged(), "");
  refused.out =
      changed(sound.out, "1  0  0  0.1250\n", "1  0  0  0.1250\n    3  3.000  1.000  0.2500\n");
  EXPECT_NE(judged(), "");
  refused = sound;
  refused.err = changed(sound.err, "2 vertices", "3 vertices");
  EXPECT_NE(judged(), "");
}

TEST(JudgeTexts, FindsAnErrorThatTheTrueCurveExceeds) {
  const Case one;
  Input input = read_input(data("judge/points.csv"), {});
  Truth truth;
  truth.monotone = true;
  truth.at = [&](Real t) {  // the polygon of the points, far from every fair curve
    const auto i = static_cast<std::size_t>(std::min(t, 8.999L));
    const Point a = input.points[i].point, b = input.points[i + 1].point;
    const Real u = t - static_cast<Real>(i);
    return Vec{a.x + u * (static_cast<Real>(b.x) - a.x), a.y + u * (static_cast<Real>(b.y) - a.y)};
  };
  for (int i = 0; i < 10; ++i) truth.parameters.push_back(i);
  input.truth = truth;
  Sheet sheet;
  check_truth(one.course, input, sheet);
  EXPECT_TRUE(sheet.has("segments.points_only_error truth"));
}

TEST(JudgeTexts, TakesTheDatumOfOnePointOutOfTheOptions) {
  using Words = std::vector<std::string>;
  // a point that is there twice is one: the end is point 2
  const Input input = read_input("x,y\n0,0\n1,1\n1,1\n", {});
  const Words options = {"--primitives", "--end-radius=inf", "--start-radius", "3",
                         "--heading-at=2=40"};
  EXPECT_EQ(without_datum(options, false, 2, input.points.size()),
            (Words{"--primitives", "--start-radius", "3", "--heading-at=2=40"}));
  EXPECT_EQ(without_datum(options, false, 1, input.points.size()),
            (Words{"--primitives", "--end-radius=inf", "--heading-at=2=40"}));
  EXPECT_EQ(without_datum(options, true, 2, input.points.size()),
            (Words{"--primitives", "--end-radius=inf", "--start-radius", "3"}));
}

/// Mirrored across x, doubled, turned by a quarter, moved: (x, y) goes to (2 y + 5, 2 x + 6), a
/// heading h to 90 - h, a left turn becomes a right turn of twice the radius.
TEST(JudgeTexts, PlacesPointsAndTheirDataButNotThoseOfOptions) {
  const Input input = read_input(
      "x,y,heading_deg,kappa,tol\n1,0,30,0.5,0.1\n3,4,,,\n",
      {"--move=5,6", "--rotate=90", "--scale", "2", "--mirror", "x", "--end-radius", "8"});
  const GivenPoint &a = input.points[0], &b = input.points[1];
  EXPECT_TRUE(input.placed);
  EXPECT_NEAR(a.point.x, 5.0, 1e-15);
  EXPECT_NEAR(a.point.y, 8.0, 1e-15);
  EXPECT_NEAR(b.point.x, 13.0, 1e-14);
  EXPECT_NEAR(b.point.y, 12.0, 1e-14);
  EXPECT_NEAR(*a.heading, std::acos(-1.0) / 3.0, 1e-15);
  EXPECT_NEAR(*a.kappa, -0.25, 1e-15);
  EXPECT_NEAR(*a.tolerance, 0.2, 1e-15);
  EXPECT_EQ(*b.kappa, 0.125);
  EXPECT_EQ(without_placement({"--move=5,6", "--units", "mm", "--scale", "2"}),
            (std::vector<std::string>{"--units", "mm"}));
}

/// Points beside a line by 1 and -1 in turn: the weights of even spacing are -1/6, 4/6, 4/6, -1/6,
/// so the cubic through the neighbours of a point at 1 runs at -1/6 - 4/6 - 4/6 - 1/6 = -5/3, which
/// is 8/3 away. Every second point has no residual: sigma^2 = 256/255 sigma_1^2.
TEST(JudgeTexts, KnowsHowFarPointsMayMoveThatScatterKnownly) {
  std::vector<Vec> points;
  for (int i = 0; i < 41; ++i) points.push_back({static_cast<Real>(i), i % 2 == 0 ? 1.0L : -1.0L});
  const double residual = (8.0 / 3.0) / std::sqrt(35.0 / 18.0);
  const double sigma = std::sqrt(256.0 / 255.0) * residual / 0.6744897501960817;
  const double reach = std::sqrt(2.0 * std::log(41.0 / 0.05)) * sigma;
  const auto found = reach_of_scatter(points, 0.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->least, reach, 1e-9 * reach);
  EXPECT_NEAR(found->greatest, reach, 1e-9 * reach);
}

/// A square of points, each of which turns by a quarter: corners that nobody marked need no more
/// than the least angle that was asked for, and none where none was to be searched.
TEST(JudgeTexts, CornersTurnByTheLeastAngle) {
  ContourFile file;
  file.units = "mm";
  file.units_source = "assumed";
  file.carrier = "spiral";
  file.points = {{0, 0}, {1, 0}, {1, 1}};
  file.pieces = {Line{{0, 0}, {1, 0}}, Line{{1, 0}, {1, 1}}};
  file.elements.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    file.elements[i].point = file.points[i];
    file.elements[i].source = i;
  }
  file.elements[1].corner = true;
  const Course course(file);
  const auto corners = [&](const std::vector<std::string>& options) {
    Sheet sheet;
    check_input(course, read_input("0,0\n1,0\n1,1\n", options), sheet);
    return sheet.has("corners");
  };
  EXPECT_FALSE(corners({}));
  EXPECT_FALSE(corners({"--corner-angle", "89"}));
  EXPECT_TRUE(corners({"--corner-angle", "91"}));
  EXPECT_TRUE(corners({"--no-corners"}));
  EXPECT_FALSE(corners({"--no-corners", "--corner-at", "2"}));
}

/// What is no unit of length is stated by no DXF.
TEST(JudgeTexts, PixelsAreNoUnitOfADrawing) {
  const ReadContour read =
      read_contour(changed(data("judge/series10.json"), "\"units\": \"mm\"", "\"units\": \"px\""));
  const Course course(read.contour);
  Sheet sheet;
  const std::string dxf =
      changed(data("judge/series10.dxf"), "$INSUNITS\n 70\n4", "$INSUNITS\n 70\n0");
  check_export(course, "a.dxf", dxf, {"1 entity, exact", "no unit is stated in the DXF file"},
               sheet);
  EXPECT_EQ(all_false(sheet), "");
  check_export(course, "a.dxf", data("judge/series10.dxf"), {"1 entity, exact"}, sheet);
  EXPECT_TRUE(sheet.has("export dxf unit"));
}

TEST(JudgeTexts, MakesTheSameSeriesFromTheSameSeed) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    EXPECT_EQ(make_series(7, i).text, make_series(7, i).text);
    EXPECT_EQ(make_series(7, i).options, make_series(7, i).options);
  }
  EXPECT_NE(make_series(7, 1).text, make_series(8, 1).text);
}

}  // namespace
}  // namespace judge
