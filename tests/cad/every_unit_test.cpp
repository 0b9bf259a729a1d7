// SPDX-License-Identifier: Apache-2.0
// Every format in every unit: written, read back, compared in metres. Formats without a reader here
// are read by the few lines that this needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <type_traits>

#include "../common/drawn_files.h"
#include "built_cad.h"
#include "obvid/curve/internal/path_distance.h"
#include "obvid/exchange/internal/svg/drawing.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"
#include "obvid/toolpath/toolpath.h"

namespace obvid {
namespace {

using namespace testing_files;

struct LengthOfUnit {
  const char* name;
  double metres;  // by definition
};
constexpr LengthOfUnit kLengthUnits[] = {{"nm", 1e-9},
                                         {"um", 1e-6},
                                         {"mm", 1e-3},
                                         {"cm", 1e-2},
                                         {"dm", 1e-1},
                                         {"m", 1.0},
                                         {"km", 1e3},
                                         {"mil", 2.54e-5},
                                         {"in", 0.0254},
                                         {"ft", 0.3048},
                                         {"yd", 0.9144},
                                         {"mi", 1609.344},
                                         {"usft", 1200.0 / 3937.0}};

/// Line, clothoid, arc and, behind a corner, a line: about 130 units long.
Contour road(const Units& units) {
  const auto series = [&] {
    PointSeries out;
    out.units = units;
    out.points = {{0, 0}, {30, 0}, {60, 5}, {80, 20}};
    return out;
  }();
  FitJob job;
  job.carrier = Carrier::kClothoids;
  const auto made = fit(series, job);
  EXPECT_TRUE(made) << to_line(made.error());
  return made->contour;
}

Contour outline(const Units& units) {
  PointSeries series;
  series.units = units;
  series.points = {{0, 0}, {40, 0}, {40, 30}, {0, 30}, {0, 0}};
  const Piece pieces[] = {
      LinePiece{{0, 0}, {40, 0}}, LinePiece{{40, 0}, {40, 30}},
      ArcPiece{{40, 30}, {0, 30}, 0.5 * std::numbers::pi, 0.05, 20.0 * std::numbers::pi * 0.999999},
      LinePiece{{0, 30}, {0, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    if (i != 2) series.kept.push_back({i, pieces[i]});
  }
  const auto made = fit(series, {});
  EXPECT_TRUE(made) << to_line(made.error());
  return made->contour;
}

std::vector<Piece> in_metres(std::vector<Piece> pieces, double metres) {
  for (Piece& piece : pieces) {
    if (auto* line = std::get_if<LinePiece>(&piece)) {
      piece = LinePiece{metres * line->start, metres * line->end};
    } else if (auto* arc = std::get_if<ArcPiece>(&piece)) {
      piece = ArcPiece{metres * arc->start, metres * arc->end, arc->theta0, arc->kappa / metres,
                       arc->length * metres};
    } else if (auto* c = std::get_if<ClothoidPiece>(&piece)) {
      piece = ClothoidPiece{metres * c->start,  metres * c->end,    c->theta0,
                            c->kappa0 / metres, c->kappa1 / metres, c->length * metres};
    } else {
      auto& b = std::get<RationalBezier>(piece);
      b.origin = metres * b.origin;
      for (Vec2& offset : b.offset) offset = metres * offset;
    }
  }
  return pieces;
}

/// Edges between points.
std::vector<Piece> chain_of(const std::vector<Vec2>& points) {
  std::vector<Piece> out;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i] != points[i - 1]) out.emplace_back(LinePiece{points[i - 1], points[i]});
  }
  return out;
}

/// Ends of the blocks of a program, in metres.
std::vector<Vec2> places_in_gcode(const std::string& text) {
  std::vector<Vec2> out;
  double unit = 0.0;
  Vec2 at;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("G20")) unit = 0.0254;
    if (line.starts_with("G21")) unit = 1e-3;
    if (line.starts_with("(")) continue;
    const std::size_t x = line.find('X'), y = line.find('Y');
    if (x != std::string::npos) at.x = std::atof(line.c_str() + x + 1);
    if (y != std::string::npos) at.y = std::atof(line.c_str() + y + 1);
    if (x != std::string::npos || y != std::string::npos) out.push_back(unit * at);
  }
  return out;
}

/// Places of CreateLine, CreateArc and spline points, which are metres.
std::vector<Vec2> places_in_macro(const std::string& text) {
  std::vector<Vec2> out;
  for (std::size_t at = text.find("CreateLine("); at != std::string::npos;
       at = text.find("CreateLine(", at + 1)) {
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
    if (std::sscanf(text.c_str() + at, "CreateLine(%lf, %lf, 0#, %lf, %lf", &x0, &y0, &x1, &y1) ==
        4) {
      out.push_back({x0, y0});
      out.push_back({x1, y1});
    }
  }
  return out;
}

class EveryUnit : public ::testing::Test {
 protected:
  static std::string written(const Contour& contour, FileFormat format, const char* name,
                             const ExportOptions& options = {}) {
    const auto out = export_contour({contour, std::nullopt, std::nullopt}, format, options);
    EXPECT_TRUE(out) << name << " " << contour.units.name << " " << to_line(out.error());
    if (!out) return {};
    EXPECT_TRUE(out->warnings.empty()) << name << out->warnings.front();
    return out->files.front().text;
  }

  /// Readers may begin a closed curve with another piece.
  static std::vector<Piece> from_the_start(std::vector<Piece> pieces, Vec2 start) {
    const auto away = [&](const Piece& piece) { return norm(start_point(piece) - start); };
    const auto first =
        std::min_element(pieces.begin(), pieces.end(),
                         [&](const Piece& a, const Piece& b) { return away(a) < away(b); });
    std::rotate(pieces.begin(), first, pieces.end());
    return pieces;
  }

  /// Compares what a reader of the program makes of a file, by both directions of the distance.
  /// Sheets have an origin of their own: `origin` is that of the contour there, metres.
  static void expect_back(const Contour& contour, double metres, const std::string& path,
                          double tolerance, const std::string& what, Vec2 origin = {}) {
    const auto drawing = read_drawing(path);
    ASSERT_TRUE(drawing) << what << to_line(drawing.error());
    ASSERT_EQ(drawing->curves.size(), 1U) << what;
    EXPECT_TRUE(drawing->units.known()) << what;
    const auto unit = metres_in(drawing->units.name);
    ASSERT_TRUE(unit) << what;
    const double size = metres * 80.0;
    const std::vector<Piece> drawn = moved_by(in_metres(contour.pieces, metres), origin);
    std::vector<Piece> read = in_metres(drawing->curves[0].pieces, *unit);
    if (contour.closed) read = from_the_start(std::move(read), start_point(drawn.front()));
    EXPECT_LE(path_distance(drawn, read), tolerance * size) << what;
  }

  static std::vector<Piece> moved_by(std::vector<Piece> pieces, Vec2 by) {
    for (Piece& piece : pieces) {
      if (auto* bezier = std::get_if<RationalBezier>(&piece)) {
        bezier->origin = bezier->origin + by;
        continue;
      }
      std::visit(
          [&](auto& one) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(one)>, RationalBezier>) {
              one.start = one.start + by;
              one.end = one.end + by;
            }
          },
          piece);
    }
    return pieces;
  }
};

TEST_F(EveryUnit, OfADrawingComesBackAsTheSameCurve) {
  struct Row {
    const char* name;
    FileFormat format;
    double tolerance;  ///< of the size: digits of the format, or what is asked of approximations
    DxfProfile dxf = DxfProfile::kExact;
    Vec2 origin{};
  };
  const double margin = 1e-3 * SvgDrawingOptions{}.margin;  // the box of the outline is at 0, 0
  const Row rows[] = {{"a.json", FileFormat::kContour, 1e-13},
                      {"a.dxf", FileFormat::kDxf, 1e-9},
                      {"b.dxf", FileFormat::kDxf, 3e-5, DxfProfile::kArcs},
                      {"c.dxf", FileFormat::kDxf, 3e-5, DxfProfile::kArcsR12},
                      {"a.svg", FileFormat::kPicture, 3e-5, DxfProfile::kExact, {margin, margin}},
                      {"a.step", FileFormat::kStep, 1e-9},
                      {"a.iges", FileFormat::kIges, 1e-9}};
  int compared = 0;
  for (const LengthOfUnit& unit : kLengthUnits) {
    const Contour contour = outline(unit.name);
    for (const Row& row : rows) {
      const bool kernel = row.format == FileFormat::kStep || row.format == FileFormat::kIges;
      // the kernel takes points nearer than 1e-7 mm for one
      if (kernel && unit.metres < 1e-6) continue;
      ExportOptions options;
      options.drawing = true;
      options.dxf = row.dxf;
      const auto out = export_contour({contour, std::nullopt, std::nullopt}, row.format, options);
      if (kernel && kCadIsMissing) continue;  // nobody reads it
      ASSERT_TRUE(out) << row.name << unit.name << to_line(out.error());
      EXPECT_TRUE(out->warnings.empty()) << row.name << unit.name << out->warnings.front();
      expect_back(contour, unit.metres, file_with(row.name, out->files.front().text), row.tolerance,
                  std::string(row.name) + " in " + unit.name, row.origin);
      ++compared;
    }
  }
  EXPECT_GE(compared, 13 * 5);
}

TEST_F(EveryUnit, OfARoadComesBackAsTheSameCurve) {
  for (const LengthOfUnit& unit : kLengthUnits) {
    const Contour contour = road(unit.name);
    for (const auto& [name, format] :
         {std::pair{"a.xodr", FileFormat::kOpenDrive}, {"a.xml", FileFormat::kLandXml}}) {
      expect_back(contour, unit.metres, file_with(name, written(contour, format, name)), 1e-9,
                  std::string(name) + " in " + unit.name);
    }
  }
}

TEST_F(EveryUnit, FeetOfLandXmlStayFeet) {
  for (const char* unit : {"ft", "usft", "m", "mm", "in", "mi", "km", "cm"}) {
    const auto drawing =
        read_drawing(file_with("a.xml", written(road(unit), FileFormat::kLandXml, unit)));
    ASSERT_TRUE(drawing);
    EXPECT_EQ(drawing->units.name, unit);
  }
}

TEST_F(EveryUnit, OfSamplesComesBackAsPointsOfTheSameCurve) {
  for (const LengthOfUnit& unit : kLengthUnits) {
    const Contour contour = outline(unit.name);
    const auto series =
        read_series(file_with("a.csv", written(contour, FileFormat::kSamples, "csv")));
    ASSERT_TRUE(series) << to_line(series.error());
    EXPECT_EQ(series->units.name, unit.name);
    EXPECT_TRUE(series->units.known());
    EXPECT_TRUE(std::none_of(series->fixed.begin(), series->fixed.end(),
                             [](const FixedData& f) { return f.theta || f.kappa; }));
    EXPECT_LE(path_distance(in_metres(contour.pieces, unit.metres),
                            in_metres(chain_of(series->points), unit.metres)),
              3e-5 * 80.0 * unit.metres)
        << unit.name;
    const auto again = fit(*series, {});
    ASSERT_TRUE(again) << unit.name << to_line(again.error());
    EXPECT_EQ(again->certificate.corners, 4) << unit.name;
    EXPECT_LE(path_distance(contour.pieces, again->contour.pieces), 3e-5 * 80.0) << unit.name;
  }
}

TEST_F(EveryUnit, OfAProgramIsMillimetresOrInches) {
  for (const LengthOfUnit& unit : kLengthUnits) {
    const Contour contour = outline(unit.name);
    ExportOptions options;
    options.motion = GcodeMotion::kLines;
    // decimals: at least 1e-6 mm or in
    if (80.0 * unit.metres < 1e-3) continue;
    options.tolerance = std::max(1e-4 * 80.0, 1e-5 / unit.metres * 1e-3 * 10.0);
    const auto out =
        export_contour({contour, std::nullopt, std::nullopt}, FileFormat::kGcode, options);
    ASSERT_TRUE(out) << unit.name << to_line(out.error());
    const std::string& text = out->files.front().text;
    EXPECT_EQ(text.find("G20") != std::string::npos, std::string(unit.name) == "in") << unit.name;
    EXPECT_LE(
        path_distance(in_metres(contour.pieces, unit.metres), chain_of(places_in_gcode(text))),
        1.1 * *options.tolerance * unit.metres)
        << unit.name;
  }
}

/// A pass of a tool: 40 units along x, 30 along y.
Toolpath pass_in(const Units& units) {
  Toolpath path;
  path.units = units;
  path.tolerance = 0.01;
  path.print_within = 0.005;
  path.feeds = default_feeds(units);
  path.moves.push_back({ToolMove::kRapid, PassPlane::kNone, {{0, 0, 5}, {0, 0, 0}}});
  path.moves.push_back({ToolMove::kPass, PassPlane::kNone, {{0, 0, 0}, {40, 0, 0}, {40, 30, 0}}});
  return path;
}

TEST_F(EveryUnit, OfAToolPathIsMillimetresOrInchesAsOfOtherPrograms) {
  for (const LengthOfUnit& unit : kLengthUnits) {
    if (40.0 * unit.metres < 1e-3) continue;  // decimals: at least 1e-6 mm or in
    const Toolpath path = pass_in(unit.name);
    const auto program = toolpath_gcode(path);
    ASSERT_TRUE(program) << unit.name << to_line(program.error());
    const std::string& text = program->text;
    const std::string name = unit.name;
    EXPECT_EQ(text.find("G20") != std::string::npos, name == "in");
    EXPECT_EQ(text.find("(converted from " + name + ")") != std::string::npos,
              name != "in" && name != "mm");
    EXPECT_EQ(text.find("assumed"), std::string::npos);
    const std::vector<Vec2> places = places_in_gcode(text);
    ASSERT_GE(places.size(), 3U);
    EXPECT_LE(norm(places.back() - unit.metres * Vec2{40, 30}), path.print_within * unit.metres);
    EXPECT_LE(norm(places.front()), path.print_within * unit.metres);
  }
  const auto assumed = toolpath_gcode(pass_in(Units()));
  ASSERT_TRUE(assumed);
  EXPECT_NE(assumed->text.find("(the unit is assumed)"), std::string::npos);
}

TEST_F(EveryUnit, OfAMacroIsMetres) {
  for (const LengthOfUnit& unit : kLengthUnits) {
    const Contour contour = outline(unit.name);
    const std::vector<Vec2> places = places_in_macro(written(contour, FileFormat::kMacro, "macro"));
    ASSERT_EQ(places.size(), 8U);  // both ends of four sides
    for (const Vec2 p : places) {
      const Vec2 back = p / unit.metres;
      EXPECT_NEAR(back.x, std::round(back.x), 1e-9) << unit.name;
      EXPECT_NEAR(back.y, std::round(back.y), 1e-9) << unit.name;
    }
    double most = 0.0;
    for (const Vec2 p : places) most = std::max(most, p.x);
    EXPECT_NEAR(most, 40.0 * unit.metres, 1e-12 * unit.metres) << unit.name;
  }
}

// ---- units that are not known -------------------------------------------------------------------

constexpr FileFormat kTrueLengths[] = {FileFormat::kStep, FileFormat::kIges, FileFormat::kGcode,
                                       FileFormat::kMacro, FileFormat::kPicture};

TEST_F(EveryUnit, ThatIsAssumedIsWarnedOfOrRefused) {
  ExportOptions options;
  options.drawing = true;
  for (const FileFormat format : kTrueLengths) {
    const auto out =
        export_contour({outline(Units()), std::nullopt, std::nullopt}, format, options);
    if (format == FileFormat::kIges && kCadIsMissing) continue;
    ASSERT_TRUE(out) << to_line(out.error());
    ASSERT_EQ(out->warnings.size(), 1U);
    EXPECT_NE(out->warnings[0].find("mm assumed"), std::string::npos);
    EXPECT_NE(out->warnings[0].find("--units"), std::string::npos);
  }
  for (const FileFormat format : {FileFormat::kOpenDrive, FileFormat::kLandXml}) {
    const auto out = export_contour({road(Units()), std::nullopt, std::nullopt}, format, options);
    ASSERT_FALSE(out);
    EXPECT_EQ(out.error().code, ErrorCode::kBadOption);
    EXPECT_NE(out.error().hint.find("--units m"), std::string::npos);
  }
  const auto dxf = export_contour({outline(Units()), std::nullopt, std::nullopt}, FileFormat::kDxf);
  ASSERT_TRUE(dxf);
  const auto drawing = read_drawing(file_with("a.dxf", dxf->files.front().text));
  ASSERT_TRUE(drawing);
  EXPECT_FALSE(drawing->units.known());
  const auto csv =
      export_contour({outline(Units()), std::nullopt, std::nullopt}, FileFormat::kSamples);
  ASSERT_TRUE(csv);
  EXPECT_TRUE(csv->files.front().text.starts_with("s,x,y,"));
  EXPECT_FALSE(read_series(file_with("a.csv", csv->files.front().text))->units.known());
  const auto json =
      read_drawing(file_with("a.json", written(outline(Units()), FileFormat::kContour, "json")));
  ASSERT_TRUE(json);
  EXPECT_FALSE(json->units.known());
}

TEST_F(EveryUnit, WithoutALengthIsRefusedWhereLengthsAreTrue) {
  ExportOptions options;
  options.drawing = true;
  for (const char* unit : {"chord", "px", "furlong"}) {
    for (const FileFormat format : kTrueLengths) {
      const auto out = export_contour({outline(unit), std::nullopt, std::nullopt}, format, options);
      ASSERT_FALSE(out) << unit;
      EXPECT_EQ(out.error().code, ErrorCode::kBadOption) << unit;
    }
    const auto milled = toolpath_gcode(pass_in(unit));
    ASSERT_FALSE(milled) << unit;
    EXPECT_EQ(milled.error().code, ErrorCode::kBadOption) << unit;
    for (const FileFormat format : {FileFormat::kOpenDrive, FileFormat::kLandXml}) {
      const auto out = export_contour({road(unit), std::nullopt, std::nullopt}, format, options);
      ASSERT_FALSE(out) << unit;
      EXPECT_EQ(out.error().code, ErrorCode::kBadOption) << unit;
    }
    const auto dxf = export_contour({outline(unit), std::nullopt, std::nullopt}, FileFormat::kDxf);
    ASSERT_TRUE(dxf);
    EXPECT_NE(
        std::find(dxf->remarks.begin(), dxf->remarks.end(), "no unit is stated in the DXF file"),
        dxf->remarks.end());
  }
}

}  // namespace
}  // namespace obvid
