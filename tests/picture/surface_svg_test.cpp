// SPDX-License-Identifier: Apache-2.0
// Pictures of surfaces: outlines and colours of known shapes, what is hidden, sizes, errors.
#include "obvid/picture/surface_svg.h"
#include "../common/programs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "page_judge.h"
#include "surface_samples.h"

namespace obvid {
namespace {

std::string picture(const SurfaceModel& model, const SurfacePictureOptions& options = {}) {
  const auto svg = surface_svg(model, options);
  EXPECT_TRUE(svg) << (svg ? "" : to_line(svg.error()));
  return svg.value_or("");
}

ErrorCode picture_error(const SurfaceModel& model, const SurfacePictureOptions& options = {}) {
  const auto svg = surface_svg(model, options);
  EXPECT_FALSE(svg);
  return svg ? ErrorCode::kInternal : svg.error().code;
}

/// A picture as XML.
struct DrawnPicture {
  explicit DrawnPicture(const std::string& svg) {
    EXPECT_TRUE(xml.load_string(svg.c_str(), pugi::parse_full)) << svg.substr(0, 300);
  }
  /// Data of the path of a class; "" where there is none.
  std::string path(const std::string& css) const {
    return xml.select_node(("//*[@class='" + css + "']").c_str()).node().attribute("d").value();
  }
  bool says(const std::string& text) const {
    for (const auto& node : xml.select_nodes("//*[local-name()='text']")) {
      if (std::string(node.node().child_value()).find(text) != std::string::npos) return true;
    }
    return false;
  }
  /// Colours of the facets in the order of their paths.
  std::vector<std::string> colours() const {
    std::vector<std::string> out;
    for (const auto& node : xml.select_nodes("//*[@stroke-width='9']/*")) {
      out.emplace_back(node.node().attribute("fill").value());
    }
    return out;
  }
  pugi::xml_document xml;
};

/// Corners of the path in px: M and l with whole tenths, as the drawing writes them.
std::vector<Vec2> corners(const std::string& data) {
  std::vector<Vec2> out;
  Vec2 at;
  bool relative = false;
  const char* s = data.c_str();
  while (*s != '\0') {
    if (*s == 'M' || *s == 'l' || *s == 'z') {
      relative = *s == 'l';
      ++s;
      continue;
    }
    char* end = nullptr;
    const double x = std::strtod(s, &end);
    const double y = std::strtod(end, &end);
    if (end == s) return out;
    s = end;
    at = relative ? at + Vec2{x, y} : Vec2{x, y};
    out.push_back(at / 10.0);
    while (*s == ' ') ++s;
  }
  return out;
}

struct SheetExtent {
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  explicit SheetExtent(const std::vector<Vec2>& points) {
    for (const Vec2 p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  Vec2 size() const { return high - low; }
  Vec2 middle() const { return 0.5 * (low + high); }
};

SurfacePictureOptions picture_with(SurfaceColouring colouring,
                                   SurfaceView view = SurfaceView::kIso) {
  SurfacePictureOptions options;
  options.colouring = colouring;
  options.view = view;
  return options;
}

constexpr SurfaceColouring kAll[] = {SurfaceColouring::kShaded,   SurfaceColouring::kIsolines,
                                     SurfaceColouring::kGaussian, SurfaceColouring::kMean,
                                     SurfaceColouring::kK1,       SurfaceColouring::kK2,
                                     SurfaceColouring::kZebra};

SurfaceModel parts() {
  return model_of({{"ring", torus(40, 10)},
                   {"ball", sphere(18, {0, 0, 5})},
                   {"plate", rectangle(60, 60)},
                   {"saddle", saddle(30, 20)}});
}

TEST(SurfacePicture, IsSmallGoodXmlInEveryColouringAndView) {
  for (const SurfaceColouring c : kAll) {
    for (const auto view : {SurfaceView::kIso, SurfaceView::kTop, SurfaceView::kSide}) {
      const std::string svg = picture(parts(), picture_with(c, view));
      const DrawnPicture drawing(svg);
      EXPECT_EQ(svg.find("nan"), std::string::npos);
      EXPECT_EQ(svg.find("inf"), std::string::npos);
      EXPECT_LT(svg.size(), 1'500'000U);
      EXPECT_GT(drawing.colours().size(), 1U);
    }
    EXPECT_EQ(picture(parts(), picture_with(c)), picture(parts(), picture_with(c)));
  }
}

TEST(SurfacePicture, OutlineOfASphereIsItsCircleFromEverywhere) {
  for (const auto& [azimuth, elevation] : {std::pair{35.0, 28.0}, {0.0, 0.0}, {200.0, -60.0}}) {
    SurfacePictureOptions options;
    options.azimuth_deg = azimuth;
    options.elevation_deg = elevation;
    const DrawnPicture drawing(picture(model_of({{"ball", sphere(25)}}), options));
    const auto outline = corners(drawing.path("outline"));
    ASSERT_GT(outline.size(), 50U);
    const SheetExtent extent(outline);
    // the sheet is 900 x 620 with 24 px beside, 64 above and 76 + 24 below: the height decides
    const double radius = 0.5 * (620.0 - 64.0 - 76.0 - 24.0);
    for (const Vec2 p : outline) EXPECT_NEAR(norm(p - extent.middle()), radius, 0.7);
    EXPECT_TRUE(drawing.path("border").empty()) << "a seam is no border";
  }
}

TEST(SurfacePicture, PlaneFromAboveKeepsItsProportions) {
  const DrawnPicture drawing(picture(model_of({{"plate", rectangle(60, 20)}}),
                                     picture_with(SurfaceColouring::kIsolines, SurfaceView::kTop)));
  const SheetExtent border(corners(drawing.path("border")));
  EXPECT_NEAR(border.size().x, 852.0, 0.2);  // 900 without both margins
  EXPECT_NEAR(border.size().y, 284.0, 0.2);
  const SheetExtent u(
      corners(drawing.path("iso u")));  // 7 lines inside, the outermost at 1/8 and 7/8
  EXPECT_NEAR(u.size().x, 852.0 * 6.0 / 8.0, 0.2);
  EXPECT_NEAR(u.size().y, 284.0, 0.2);
  EXPECT_TRUE(drawing.says("60 × 20 × 0 mm"));
  EXPECT_TRUE(drawing.says("5 mm")) << "the longest round bar within 130 px of 14.2 px/mm";
  SurfaceModel unknown = model_of({{"plate", rectangle(60, 20)}});
  unknown.units = {};
  EXPECT_TRUE(
      DrawnPicture(picture(unknown, picture_with(SurfaceColouring::kIsolines, SurfaceView::kTop)))
          .says("60 × 20 × 0 units"));
}

TEST(SurfacePicture, ViewsLookFromWhereTheirNamesSay) {
  // a roof: rises with x, lies at y = 0 ... 10
  NurbsSurface roof = rectangle(30, 10);
  for (Vec3& p : roof.points) p.z = p.x / 3.0;
  const auto width_and_rise = [&](SurfaceView view) {
    const auto points = corners(DrawnPicture(picture(model_of({{"roof", roof}}),
                                                     picture_with(SurfaceColouring::kShaded, view)))
                                    .path("border"));
    const auto [left, right] =
        std::minmax_element(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    return Vec2{right->x - left->x, left->y - right->y};
  };
  const Vec2 front = width_and_rise(SurfaceView::kFront);
  EXPECT_NEAR(front.y / front.x, 1.0 / 3.0, 0.01) << "rises to the right from the front";
  const Vec2 back = width_and_rise(SurfaceView::kBack);
  EXPECT_NEAR(back.y / back.x, -1.0 / 3.0, 0.01) << "and to the left from behind";
}

TEST(SurfacePicture, WhatIsInsideIsHidden) {
  const auto plate = [](double z) {
    NurbsSurface s = rectangle(10, 10);
    for (Vec3& p : s.points) p = p + Vec3{-5, -5, z};
    return s;
  };
  for (const SurfaceView view : {SurfaceView::kIso, SurfaceView::kTop}) {
    const auto inside = model_of({{"ball", sphere(30)}, {"plate", plate(0)}});
    EXPECT_TRUE(DrawnPicture(picture(inside, picture_with(SurfaceColouring::kShaded, view)))
                    .path("border")
                    .empty());
    const auto above = model_of({{"ball", sphere(30)}, {"plate", plate(40)}});
    EXPECT_FALSE(DrawnPicture(picture(above, picture_with(SurfaceColouring::kShaded, view)))
                     .path("border")
                     .empty());
  }
}

TEST(SurfacePicture, IsolinesOfTheFarSideAreNotDrawn) {
  const auto model = model_of({{"tube", turned(line_between({20, 0, 50}, {20, 0, 0}))}});
  SurfacePictureOptions options = picture_with(SurfaceColouring::kIsolines, SurfaceView::kFront);
  options.isolines_u = 1;
  options.isolines_v = 8;  // one each 45 degrees: three of seven are in front, not at the sides
  const std::string v = DrawnPicture(picture(model, options)).path("iso v");
  // of the eight places 0, 45, ... the seam at 0 is none; the front has 225, 270 and 315 degrees,
  // and the outlines at 180 (and 0) degrees may count as seen
  const auto lines = std::count(v.begin(), v.end(), 'M');
  EXPECT_GE(lines, 3);
  EXPECT_LE(lines, 4);
}

TEST(SurfacePicture, CurvatureLegendsHaveTheNumbersOfClosedForms) {
  const DrawnPicture ring(
      picture(model_of({{"ring", torus(40, 14)}}), picture_with(SurfaceColouring::kGaussian)));
  // -1 / (14 * 26) and 1 / (14 * 54)
  EXPECT_TRUE(ring.says("from −0.00275 to 0.00132 in all"));
  EXPECT_TRUE(ring.says("Gaussian curvature, 1/mm²"));
  const DrawnPicture ball(
      picture(model_of({{"ball", sphere(25)}}), picture_with(SurfaceColouring::kGaussian)));
  EXPECT_TRUE(ball.says("0.0016 everywhere"));
  EXPECT_EQ(ball.colours(), std::vector<std::string>(ball.colours().size(), ball.colours()[0]));
  const DrawnPicture plate(
      picture(model_of({{"plate", rectangle(3, 2)}}), picture_with(SurfaceColouring::kK1)));
  EXPECT_TRUE(plate.says("0 everywhere"));
  SurfacePictureOptions fixed = picture_with(SurfaceColouring::kGaussian);
  fixed.range = Range{0.0, 0.004};
  const DrawnPicture same(picture(model_of({{"ball", sphere(25)}}), fixed));
  EXPECT_TRUE(same.says("0.004"));
}

TEST(SurfacePicture, ZebraOfAPlaneHasOneColourAndOfASphereTwo) {
  const auto zebra = picture_with(SurfaceColouring::kZebra);
  const auto different = [](std::vector<std::string> c) {
    std::sort(c.begin(), c.end());
    return std::unique(c.begin(), c.end()) - c.begin();
  };
  EXPECT_EQ(different(DrawnPicture(picture(model_of({{"p", rectangle(3, 2)}}), zebra)).colours()),
            1);
  EXPECT_EQ(different(DrawnPicture(picture(model_of({{"b", sphere(3)}}), zebra)).colours()), 2);
}

TEST(SurfacePicture, LinesStandOverTheSurfaceAndBehindIt) {
  SurfacePictureOptions options = picture_with(SurfaceColouring::kShaded, SurfaceView::kFront);
  ScenePolyline ring{{}, "section"};
  for (int k = 0; k <= 200; ++k) {
    const double a = 2.0 * std::numbers::pi * k / 200;
    ring.points.push_back({25.0 * std::cos(a), 25.0 * std::sin(a), 0.0});
  }
  ScenePolyline path = ring, unknown = ring;
  path.role = "toolpath";
  unknown.role = "\"><script>";
  options.lines = {ring, path, unknown};
  const DrawnPicture drawing(picture(model_of({{"ball", sphere(25)}}), options));
  // the equator from the front: one half before the ball, one behind
  EXPECT_NEAR(SheetExtent(corners(drawing.path("section"))).size().x, 456.0, 3.0);
  EXPECT_NEAR(SheetExtent(corners(drawing.path("section behind"))).size().x, 456.0, 12.0);
  EXPECT_FALSE(drawing.path("toolpath").empty());
  EXPECT_FALSE(drawing.path("other").empty());
  EXPECT_TRUE(drawing.path("rapid").empty());
}

TEST(SurfacePicture, LongToolPathsStaySmall) {
  SurfacePictureOptions options = picture_with(SurfaceColouring::kShaded);
  ScenePolyline path{{}, "toolpath"};
  for (int row = 0; row < 400; ++row) {
    for (int k = 0; k <= 500; ++k) {
      const double x = row % 2 == 0 ? k / 5.0 : 100.0 - k / 5.0;
      path.points.push_back({x, row / 4.0, 3.0 * std::sin(3.0 * x)});
    }
  }
  options.lines = {path};
  const std::string svg = picture(model_of({{"plate", rectangle(100, 100)}}), options);
  EXPECT_LT(svg.size(), 1'500'000U);
  EXPECT_FALSE(DrawnPicture(svg).path("toolpath").empty());
}

TEST(SurfacePicture, DoesNotCareWhereTheSurfaceLies) {
  const auto outline = [](Vec3 centre) {
    return SheetExtent(
        corners(DrawnPicture(picture(model_of({{"b", sphere(2, centre)}}))).path("outline")));
  };
  const SheetExtent here = outline({}), far = outline({5e6, -4e6, 100});
  EXPECT_NEAR(here.size().x, far.size().x, 0.2);
  EXPECT_NEAR(here.middle().y, far.middle().y, 0.2);
}

TEST(SurfacePicture, HostileNamesAreText) {
  for (const std::string name :
       {"</title><script>alert(1)</script>", "\xff\xc3( & \"x\" <b>", "\x01\x1b[0m"}) {
    auto model = model_of({{name, rectangle(3, 2)}}, name);
    model.units = name;
    const DrawnPicture drawing(picture(model, picture_with(SurfaceColouring::kMean)));
    EXPECT_FALSE(drawing.xml.select_node("//*[local-name()='script']"));
    EXPECT_FALSE(drawing.xml.select_node("//*[local-name()='b']"));
  }
}

TEST(SurfacePicture, RefusesWhatItCannotDraw) {
  const auto model = model_of({{"plate", rectangle(1, 1)}});
  EXPECT_EQ(picture_error({}), ErrorCode::kNothingThere);
  auto broken = model;
  broken.patches[0].surface.points.pop_back();
  EXPECT_EQ(picture_error(broken), ErrorCode::kBadOption);
  auto point = model;
  for (Vec3& p : point.patches[0].surface.points) p = {1, 2, 3};
  EXPECT_EQ(picture_error(point), ErrorCode::kSizeOutOfRange);
  SurfacePictureOptions options;
  options.width = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(picture_error(model, options), ErrorCode::kBadOption);
  options = {};
  options.isolines_u = 0;
  EXPECT_EQ(picture_error(model, options), ErrorCode::kBadOption);
  options = {};
  options.range = Range{1.0, 1.0};
  EXPECT_EQ(picture_error(model, options), ErrorCode::kBadOption);
  options = {};
  options.colouring = SurfaceColouring::kDeviation;
  EXPECT_EQ(picture_error(model, options), ErrorCode::kBadOption);
  options.deviation = ShownDeviation{};  // of nothing
  EXPECT_EQ(picture_error(model, options), ErrorCode::kBadOption);
  options.deviation->dots = {{{0, 0, 1}, std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(picture_error(model, options), ErrorCode::kNotFinite);
  options = {};
  options.lines = {{{{0, 0, std::numeric_limits<double>::quiet_NaN()}}, "section"}};
  EXPECT_EQ(picture_error(model, options), ErrorCode::kNotFinite);
  options.lines = {{{}, "section"}};
  EXPECT_TRUE(surface_svg(model, options)) << "a line without points is no harm";
}

/// A tube of radius 1 along z from 0 on.
NurbsSurface tube(double length) { return turned(line_between({1, 0, length}, {1, 0, 0})); }

/// The strips of a picture of a thin body, each an svg of its own: extents of their outlines.
std::vector<SheetExtent> strips(const DrawnPicture& drawn) {
  std::vector<SheetExtent> out;
  for (const auto& strip : drawn.xml.select_nodes("/*/*[local-name()='svg']")) {
    std::vector<Vec2> all;
    for (const char* css : {"outline", "border"}) {
      const auto path =
          strip.node().select_node((std::string(".//*[@class='") + css + "']").c_str());
      for (const Vec2 p : corners(path.node().attribute("d").value())) all.push_back(p);
    }
    out.emplace_back(all);
  }
  return out;
}

TEST(SurfacePicture, ThinBodiesLieLevelWithTheirPartsLarger) {
  for (const char* along : {"x", "y", "z"}) {
    NurbsSurface body = tube(60.0);
    for (Vec3& p : body.points) {
      if (*along == 'x') p = {p.z, p.x, p.y};
      if (*along == 'y') p = {p.y, p.z, p.x};
    }
    auto options = picture_with(SurfaceColouring::kShaded,
                                *along == 'y' ? SurfaceView::kSide : SurfaceView::kFront);
    const DrawnPicture drawn(picture(model_of({{"tube", body}}), options));
    const auto sheet = drawn.xml.document_element();
    EXPECT_EQ(sheet.attribute("width").as_double(), 1260.0);
    // 30 times as long as wide: four parts
    const auto found = strips(drawn);
    ASSERT_EQ(found.size(), 5U) << along;
    const double wide = 1260.0 - 48.0;
    EXPECT_NEAR(found[0].size().x, wide, 1.0) << along;
    EXPECT_NEAR(found[0].size().y, wide / 30.0, 1.0) << along;
    double heights = 0.0;
    for (std::size_t k = 1; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].size().y, 4.0 * wide / 30.0, 1.5) << along << k;
      // a part, with some of its neighbours in the margins and nothing beyond the sheet
      EXPECT_GT(found[k].size().x, wide);
      EXPECT_GT(found[k].low.x, -60.0);
      EXPECT_LT(found[k].high.x, 1320.0);
      heights += found[k].size().y;
    }
    EXPECT_GT(sheet.attribute("height").as_double(), heights + found[0].size().y);
    for (const char* place : {"1: ", "2: ", "3: ", "4: "}) EXPECT_TRUE(drawn.says(place)) << place;
    EXPECT_TRUE(drawn.says(std::string("1: ") + along + " from 0 to 15 mm")) << along;
    EXPECT_TRUE(drawn.says(std::string("4: ") + along + " from 45 to 60 mm")) << along;
  }
}

TEST(SurfacePicture, ThinBodiesThatRunAslantAreToldFromTheirLeftEnd) {
  NurbsSurface body = tube(60.0);
  const Vec3 a = unit(Vec3{1, -1, 0}), b = unit(Vec3{1, 1, 0.5}), c = cross(a, b);
  for (Vec3& p : body.points) p = p.z * a + p.x * b + p.y * c;
  const DrawnPicture drawn(
      picture(model_of({{"tube", body}}), picture_with(SurfaceColouring::kMean)));
  EXPECT_GE(strips(drawn).size(), 4U);
  EXPECT_TRUE(drawn.says("1: 0 to ")) << "from the left end";
  EXPECT_TRUE(drawn.says("from the left end"));
}

TEST(SurfacePicture, LongBodiesGetAWideSheetAndPlatesFromTheirEdgeDoNot) {
  const DrawnPicture longer(picture(model_of({{"tube", tube(18.0)}}),
                                    picture_with(SurfaceColouring::kShaded, SurfaceView::kFront)));
  EXPECT_TRUE(strips(longer).empty());
  const auto sheet = longer.xml.document_element();
  EXPECT_EQ(sheet.attribute("width").as_double(), 1260.0);
  EXPECT_LT(sheet.attribute("height").as_double(), 400.0);
  const SheetExtent border(corners(longer.path("border")));
  EXPECT_NEAR(border.size().x, 1212.0, 1.0);
  for (const auto& [surface, view] : {std::pair{rectangle(60, 60), SurfaceView::kFront},
                                      {tube(60.0), SurfaceView::kTop},
                                      {tube(6.0), SurfaceView::kFront}}) {
    const DrawnPicture other(
        picture(model_of({{"other", surface}}), picture_with(SurfaceColouring::kShaded, view)));
    EXPECT_TRUE(strips(other).empty());
    EXPECT_EQ(other.xml.document_element().attribute("width").as_double(), 900.0);
    EXPECT_EQ(other.xml.document_element().attribute("height").as_double(), 620.0);
  }
}

TEST(SurfacePicture, DegenerateSurfacesAreNoHarm) {
  NurbsSurface line = rectangle(5, 1);
  for (Vec3& p : line.points) p.y = 0.0;
  NurbsSurface vast = rectangle(1, 1);
  for (Vec3& p : vast.points) p = 1.7e308 * (p - Vec3{0.5, 0.5, 0});
  for (const SurfaceColouring c : kAll) {
    for (const SurfaceView view : {SurfaceView::kTop, SurfaceView::kSide}) {  // and from its end
      const DrawnPicture drawing(picture(model_of({{"line", line}}), picture_with(c, view)));
    }
    const auto svg = surface_svg(model_of({{"vast", vast}}), picture_with(c));
    ASSERT_FALSE(svg);
  }
}

class SurfacePictureByRsvg : public Judged {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_PROGRAM("rsvg-convert");
    Judged::SetUp();
  }
  std::string rendered(const std::string& svg) const {
    write("a.svg", svg);
    EXPECT_EQ(std::system(("rsvg-convert " + file("a.svg") + " -o " + file("a.png")).c_str()), 0);
    return file("a.png");
  }
};

TEST_F(SurfacePictureByRsvg, SphereIsADiscWithoutHoles) {
  const std::string png =
      rendered(picture(model_of({{"b", sphere(25)}}), picture_with(SurfaceColouring::kGaussian)));
  const Spot disc = spot(png, "ink", "100,62,800,530");
  EXPECT_NEAR(disc.width(), 456.0, 4.0);
  EXPECT_NEAR(disc.height(), 456.0, 4.0);
  EXPECT_NEAR(disc.count / (std::numbers::pi * 229.0 * 229.0), 1.0, 0.01);
}

TEST_F(SurfacePictureByRsvg, NearPartsCoverFarOnes) {
  // from the front a small ball stands in the middle of a wide plate: before it, then behind it
  NurbsSurface wall = rectangle(100, 60);
  for (Vec3& p : wall.points) p = {p.x - 50.0, 0.0, p.y - 30.0};
  SurfacePictureOptions options = picture_with(SurfaceColouring::kGaussian, SurfaceView::kFront);
  options.range =
      Range{0.0, 0.008};  // the ball: 1/20^2 = 0.0025, blue or green; the wall: dark blue
  options.isolines_u = options.isolines_v = 1;
  const auto seen = [&](double y) {
    const auto model = model_of({{"wall", wall}, {"ball", sphere(20, {0, y, 0})}});
    return spot(rendered(picture(model, options)), "dark", "250,120,650,480").count;
  };
  EXPECT_GT(seen(-100.0), 0.0);
  // 456 px for 60 units; the outline of 1.2 px is dark too
  const double disc = std::numbers::pi * std::pow(20.0 * 456.0 / 60.0 - 0.6, 2.0);
  const double before = seen(-100.0);
  EXPECT_NEAR(seen(100.0) - before, disc, 0.02 * disc);
  EXPECT_NEAR(seen(0.0) - before, 0.0, 0.02 * disc) << "the wall cuts through the ball";
}

TEST_F(SurfacePictureByRsvg, PlatesThatCrossShareTheirPlace) {
  // few and large cells: no order of drawing is right along the line where the plates cross
  NurbsSurface up = rectangle(60, 40), down = rectangle(60, 40);
  for (Vec3& p : up.points) p.z = 0.2 * (p.x - 24.0);
  for (Vec3& p : down.points) p = {p.x, 40.0 - p.y, -0.2 * (p.x - 24.0)};  // shows its brown back
  SurfacePictureOptions options = picture_with(SurfaceColouring::kShaded, SurfaceView::kTop);
  options.most_facets = 16;
  const auto model = model_of({{"up", up}, {"down", down}});
  const Spot brown = spot(rendered(picture(model, options)), "brown", "20,62,880,530");
  // the lower one is seen up to 24 of 60: 456 px are 40 units
  const double scale = 456.0 / 40.0;
  EXPECT_NEAR(brown.count / (scale * scale), 24.0 * 40.0, 0.02 * 24.0 * 40.0);
  EXPECT_NEAR(brown.width() / scale, 24.0, 0.5);
}

}  // namespace
}  // namespace obvid
