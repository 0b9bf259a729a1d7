// SPDX-License-Identifier: Apache-2.0
// Pages of surfaces: their numbers against closed forms, their structure, hostile names, errors.
// What a browser makes of them: surface_page_browser_test.cpp.
#include "obvid/picture/internal/surface_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "page/values.h"
#include "page_judge.h"
#include "surface_samples.h"

namespace obvid {
namespace {

using nlohmann::json;

std::string page_of(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                    const PageOptions& options = {}) {
  const auto page = surface_page(model, meshes, options);
  EXPECT_TRUE(page) << (page ? "" : to_line(page.error()));
  return page.value_or("");
}

ErrorCode error_of(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                   const PageOptions& options = {}) {
  const auto page = surface_page(model, meshes, options);
  EXPECT_FALSE(page);
  return page ? ErrorCode::kInternal : page.error().code;
}

/// What stands in the script element of this id.
std::string element(const std::string& page, const std::string& id) {
  const std::string mark = "id=\"" + id + "\">";
  const std::size_t from = page.find(mark);
  if (from == std::string::npos) return {};
  const std::size_t begin = from + mark.size();
  return page.substr(begin, page.find('<', begin) - begin);
}

std::string from_base64(const std::string& text) {
  std::string out;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (digit < 0) break;
    group = (group << 6U) | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      out += static_cast<char>((group >> static_cast<unsigned>(bits)) & 255U);
    }
  }
  return out;
}

/// The raster of values of a patch.
struct ReadRaster {
  std::size_t spans[2] = {}, cells[2] = {};
  std::vector<float> breaks[2], k, off;
  std::vector<std::int16_t> normals;
  [[nodiscard]] std::size_t nodes(int side) const { return spans[side] * (cells[side] + 1); }
  [[nodiscard]] std::size_t nodes() const { return nodes(0) * nodes(1); }
  /// Part of the domain of a node.
  [[nodiscard]] double at(int side, std::size_t node) const {
    const std::size_t span = node / (cells[side] + 1), within = node % (cells[side] + 1);
    return breaks[side][span] + (breaks[side][span + 1] - breaks[side][span]) *
                                    static_cast<double>(within) / static_cast<double>(cells[side]);
  }
};

/// The numbers of a page as its script reads them (on a little-endian machine).
struct Read {
  explicit Read(const std::string& page)
      : header(json::parse(element(page, "model"))), bytes(from_base64(element(page, "data"))) {}

  template <class T>
  std::vector<T> take(std::size_t count) {
    std::vector<T> out(count);
    EXPECT_LE(at + count * sizeof(T), bytes.size());
    if (at + count * sizeof(T) <= bytes.size()) {
      std::memcpy(out.data(), bytes.data() + at, count * sizeof(T));
    }
    at += (count * sizeof(T) + 3) / 4 * 4;
    return out;
  }
  ReadRaster raster(std::size_t patch = 0) {
    ReadRaster out;
    const json& sides = header["patches"][patch]["raster"];
    for (int side = 0; side < 2; ++side) {
      out.spans[side] = sides[static_cast<std::size_t>(side)][0];
      out.cells[side] = sides[static_cast<std::size_t>(side)][1];
      out.breaks[side] = take<float>(out.spans[side] + 1);
    }
    out.k = take<float>(2 * out.nodes());
    out.normals = take<std::int16_t>(2 * out.nodes());
    if (header["off"] == 1) out.off = take<float>(out.nodes());
    return out;
  }
  Vec3 centre() const {
    const auto& c = header["centre"];
    return {c[0], c[1], c[2]};
  }

  json header;
  std::string bytes;
  std::size_t at = 0;
};

Vec3 third(const std::vector<float>& numbers, std::size_t i) {
  return {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
}

/// A direction out of the unfolded octahedron.
Vec3 unfolded(const std::vector<std::int16_t>& folded, std::size_t i) {
  double x = folded[2 * i] / 32767.0, y = folded[2 * i + 1] / 32767.0;
  const double z = 1.0 - std::abs(x) - std::abs(y);
  if (z < 0.0) {
    const double kept = x;
    x = (1.0 - std::abs(y)) * (x < 0.0 ? -1.0 : 1.0);
    y = (1.0 - std::abs(kept)) * (y < 0.0 ? -1.0 : 1.0);
  }
  return unit(Vec3{x, y, z});
}

TEST(SurfacePage, HasTheLookOfTheStudio) {
  const auto model = model_of({{"ball", sphere(25.0)}});
  const std::string page = page_of(model, meshes_of(model, 20));
  for (const char* name :
       {"web/look/look.css", "web/surface/page.css", "web/surface/controls.js"}) {
    std::ifstream file(std::string(OBVID_SOURCE_DIR) + "/" + name);
    std::string licence, text;
    std::getline(file, licence);
    std::getline(file, text, '\0');
    ASSERT_GT(text.size(), 500U) << name;
    EXPECT_NE(page.find(text), std::string::npos) << name;
  }
}

TEST(SurfacePage, HoldsTheSphereItWasGiven) {
  const double radius = 25.0;
  const auto model = model_of({{"ball", sphere(radius)}});
  const auto meshes = meshes_of(model, 20);
  Read read(page_of(model, meshes));
  const std::size_t n = meshes[0].vertices.size();
  ASSERT_EQ(read.header["patches"][0]["vertices"], n);
  const auto points = read.take<float>(3 * n);
  const auto folded = read.take<std::int16_t>(2 * n);
  const auto parameters = read.take<float>(2 * n);
  const auto raster = read.raster();
  const auto corners = read.take<std::uint16_t>(3 * meshes[0].triangles.size());
  EXPECT_EQ(read.at, read.bytes.size());
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(norm(third(points, i)), radius, 1e-5);
    EXPECT_GE(parameters[2 * i], 0.0F);
    EXPECT_LE(parameters[2 * i], 1.0F);
    // the normal of a sphere is its place
    EXPECT_LT(norm(unfolded(folded, i) - third(points, i) / radius), 2e-4) << i;
  }
  // two quarters along the half circle, four around, at least six cells in each
  EXPECT_EQ(raster.spans[0] * raster.spans[1], 8U);
  EXPECT_GE(raster.cells[0], 6U);
  EXPECT_GE(raster.cells[1], 6U);
  const Range us = domain_u(sphere(radius)), vs = domain_v(sphere(radius));
  for (std::size_t i = 0; i < raster.nodes(); ++i) {
    EXPECT_NEAR(raster.k[2 * i], -1.0 / radius, 1e-6) << "node " << i << ", poles too";
    EXPECT_NEAR(raster.k[2 * i + 1], -1.0 / radius, 1e-6);
    const double u = raster.at(0, i % raster.nodes(0)), v = raster.at(1, i / raster.nodes(0));
    const Vec3 place = evaluate(sphere(radius), us.at(u), vs.at(v)).point;
    EXPECT_LT(norm(unfolded(raster.normals, i) - place / radius), 5e-4)
        << i << ", poles within 1e-4";
  }
  for (std::size_t t = 0; t < meshes[0].triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(corners[3 * t + k], meshes[0].triangles[t][k]);
  }
}

TEST(SurfacePage, KeepsItsDigitsFarFromTheOrigin) {
  const Vec3 far{4.5e6, -5.4e6, 1.2e5};
  const auto model = model_of({{"ball", sphere(0.5, far)}});
  const auto meshes = meshes_of(model, 12);
  Read read(page_of(model, meshes));
  const auto points = read.take<float>(3 * meshes[0].vertices.size());
  for (std::size_t i = 0; i < meshes[0].vertices.size(); ++i) {
    const Vec3 back = read.centre() + third(points, i);
    EXPECT_LT(norm(back - meshes[0].vertices[i].point), 1e-7) << i;
  }
}

TEST(SurfacePage, WritesWideIndicesOnlyWhereTheyAreNeeded) {
  for (const std::size_t side : {254U, 256U}) {  // 255^2 and 257^2 vertices
    const auto model = model_of({{"plate", rectangle(2, 1)}});
    const auto meshes = meshes_of(model, side);
    Read read(page_of(model, meshes));
    const std::size_t n = meshes[0].vertices.size();
    const std::size_t bytes = side == 256U ? 4 : 2;
    (void)read.take<char>(n * 24);
    (void)read.raster();
    EXPECT_EQ(read.bytes.size(), read.at + 3 * bytes * meshes[0].triangles.size());
  }
}

TEST(SurfacePage, CurvatureScalesAreThoseOfClosedForms) {
  const double large = 40.0, small = 14.0;
  const auto model = model_of({{"ring", torus(large, small)}});
  const Read read(page_of(model, meshes_of(model, 64)));
  const json& gaussian = read.header["scales"]["gaussian"];
  EXPECT_NEAR(gaussian["least"], -1.0 / (small * (large - small)), 1e-9);
  EXPECT_NEAR(gaussian["most"], 1.0 / (small * (large + small)), 1e-9);
  EXPECT_TRUE(gaussian["diverging"]);
  EXPECT_EQ(gaussian["low"], -gaussian["high"].get<double>());
  EXPECT_EQ(gaussian["unit"], "1/mm²");
  // around the tube, everywhere the same and the smaller of both
  const json& k2 = read.header["scales"]["k2"];
  EXPECT_NEAR(k2["low"], -1.0 / small, 1e-9);
  EXPECT_EQ(k2["low"], k2["high"]);
}

TEST(SurfacePage, ShowsRipplesThatItsTrianglesDoNotMeet) {
  const auto model = model_of({{"plate", rippled_plate()}});
  const auto meshes = meshes_of(model, 1);  // two triangles, flat
  Read read(page_of(model, meshes));
  (void)read.take<char>(4 * 24);
  const auto raster = read.raster();
  ASSERT_EQ(raster.spans[0], 20U);
  EXPECT_GE(raster.cells[0], 6U);
  // z = 0.02 - 0.0032 t^2 and its like, t from the middle of each span
  for (std::size_t i = 0; i < raster.nodes(); ++i) {
    const double x = 100.0 * raster.at(0, i % raster.nodes(0));
    const std::size_t span = (i % raster.nodes(0)) / (raster.cells[0] + 1);
    const double t = x - 5.0 * (static_cast<double>(span) + 0.5);
    const double slope = 0.0064 * t;
    const double k = (span % 2 == 0 ? -1.0 : 1.0) * 0.0064 / std::pow(1.0 + slope * slope, 1.5);
    EXPECT_NEAR(raster.k[2 * i] + raster.k[2 * i + 1], k, 1e-6) << i << " at " << x;
    const Vec3 normal = unit(Vec3{(span % 2 == 0 ? 1.0 : -1.0) * slope, 0.0, 1.0});
    EXPECT_LT(norm(unfolded(raster.normals, i) - normal), 3e-4) << i << " at " << x;
  }
  const json& mean = read.header["scales"]["mean"];
  EXPECT_NEAR(mean["least"], -0.0032, 1e-7);
  EXPECT_NEAR(mean["most"], 0.0032, 1e-7);
  EXPECT_NEAR(mean["low"], -0.0032, 1e-5);
  EXPECT_NEAR(mean["high"], 0.0032, 1e-5);
}

TEST(SurfacePage, ShowsDeviationsFinerThanItsTriangles) {
  const auto model = model_of({{"plate", rectangle(100, 100)}});
  for (const double waves : {12.0, 50.0, 64.0}) {
    const auto off = [waves](double x) {
      return 0.02 * std::sin(2.0 * std::numbers::pi * waves * x / 100.0);
    };
    PageOptions options;
    options.deviation = ShownDeviation{};
    options.deviation->title = "ripples";
    options.deviation->told = {-0.02, 0.02};
    options.deviation->of_place = [&](Vec3 p) { return off(p.x); };
    Read read(page_of(model, meshes_of(model, 1), options));
    (void)read.take<char>(4 * 24);
    const auto raster = read.raster();
    double least = 0.0, most = 0.0;
    for (std::size_t i = 0; i < raster.nodes(); ++i) {
      const double x = 100.0 * raster.at(0, i % raster.nodes(0));
      EXPECT_NEAR(raster.off[i], off(x), 1e-6) << i;
      least = std::min(least, static_cast<double>(raster.off[i]));
      most = std::max(most, static_cast<double>(raster.off[i]));
    }
    EXPECT_NEAR(most, 0.02, 0.001) << waves;
    EXPECT_NEAR(least, -0.02, 0.001) << waves;
    const json& scale = read.header["scales"]["deviation"];
    EXPECT_NEAR(scale["high"], 0.02, 0.001);
    EXPECT_NEAR(scale["low"], -0.02, 0.001);
    EXPECT_TRUE(scale["diverging"]);
    EXPECT_LT(read.bytes.size(), 16U * 61'000U);
  }
}

TEST(SurfacePage, ScalesAreThoseOfWhatIsInsideTheTrims) {
  // of a plate of 100 x 100 with the deviation x the half up to x = 50 is there
  auto model = model_of({{"plate", rectangle(100, 100)}});
  model.patches[0].trims.emplace_back();
  auto meshes = meshes_of(model, 1);
  for (MeshVertex& v : meshes[0].vertices) {
    v.point.x *= 0.5;
    v.u *= 0.5;
  }
  PageOptions options;
  options.deviation = ShownDeviation{};
  options.deviation->told = {0.0, 50.0};
  options.deviation->of_place = [](Vec3 p) { return p.x; };
  const Read read(page_of(model, meshes, options));
  const json& scale = read.header["scales"]["deviation"];
  EXPECT_NEAR(scale["high"], 49.0, 0.6);  // 98 % of the area
  EXPECT_NEAR(scale["low"], 1.0, 0.6);
}

TEST(SurfacePage, OfManySpansStaysSmall) {
  // 400 x 500 spans: 200,000 control points and more
  NurbsSurface fine = rectangle(1, 1);
  fine.points.clear();
  for (auto [knots, spans] : {std::pair{&fine.knots_u, 400}, {&fine.knots_v, 500}}) {
    *knots = {0.0};
    for (int i = 0; i <= spans; ++i) knots->push_back(i);
    knots->push_back(spans);
  }
  for (int j = 0; j <= 500; ++j) {
    for (int i = 0; i <= 400; ++i) {
      fine.points.push_back({1.0 * i, 1.0 * j, 0.01 * ((i * 7 + j * 3) % 5)});
    }
  }
  const auto model = model_of({{"fine", fine}});
  Read read(page_of(model, meshes_of(model, 1)));
  (void)read.take<char>(4 * 24);
  EXPECT_LE(read.raster().nodes(), 300'000U);
}

TEST(SurfacePage, FlatIsZeroAndNotNoise) {
  const auto model = model_of({{"plate", rectangle(3, 2)}});
  const Read read(page_of(model, meshes_of(model, 8)));
  for (const auto& [name, scale] : read.header["scales"].items()) {
    EXPECT_EQ(scale["low"], 0.0) << name;
    EXPECT_EQ(scale["high"], 0.0) << name;
  }
}

TEST(SurfacePage, OneHotSpotDoesNotFlattenTheColours) {
  std::vector<picture::WeighedValue> values;
  for (int i = 0; i < 100; ++i) values.push_back({1.0 + i / 100.0, 1.0});
  // many vertices of nearly no area, as an adaptive mesh has them at an edge
  for (int i = 0; i < 1000; ++i) values.push_back({1e4, 1e-3});
  const auto scale = picture::value_scale(values, 1e-9);
  EXPECT_LE(scale.high, 2.0);
  EXPECT_NEAR(scale.high, 1.98, 0.02);
  EXPECT_NEAR(scale.low, 1.02, 0.02);
  EXPECT_EQ(scale.most, 1e4);
  EXPECT_FALSE(scale.diverging);
}

TEST(SurfacePage, SeamsAndPolesAreNoBordersButEdgesAre) {
  using Borders = std::array<bool, 4>;
  const auto real_borders = [](const NurbsSurface& surface) {
    return picture::real_borders(model_of({{"one", surface}})).front();
  };
  EXPECT_EQ(real_borders(sphere(3)), (Borders{false, false, false, false}));
  EXPECT_EQ(real_borders(torus(5, 1)), (Borders{false, false, false, false}));
  EXPECT_EQ(real_borders(rectangle(5, 1)), (Borders{true, true, true, true}));
  const NurbsSurface tube = turned(line_between({2, 0, 5}, {2, 0, 0}));
  EXPECT_EQ(real_borders(tube), (Borders{true, true, false, false}));
  const NurbsSurface cone = turned(line_between({0, 0, 5}, {2, 0, 0}));
  EXPECT_EQ(real_borders(cone), (Borders{false, true, false, false}));
  // a drop: closed, with an edge along its seam
  NurbsSurface drop = rectangle(1, 1);
  drop.degree_u = 3;
  drop.knots_u = {0, 0, 0, 0, 1, 1, 1, 1};
  drop.points = {{0, 0, 0}, {4, 0, 3}, {4, 0, -3}, {0, 0, 0},
                 {0, 4, 0}, {4, 4, 3}, {4, 4, -3}, {0, 4, 0}};
  EXPECT_EQ(real_borders(drop), (Borders{true, true, true, true}));
}

TEST(SurfacePage, LinesFollowThePatches) {
  const auto model = model_of({{"plate", rectangle(3, 2)}});
  PageOptions options;
  options.lines = {{{{0, 0, 1}, {3, 2, 1}}, "toolpath"}, {{{0, 0, 5}}, "__proto__"}};
  Read read(page_of(model, meshes_of(model, 1), options));
  const auto& lines = read.header["lines"];
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]["count"], 2);
  EXPECT_EQ(lines[1]["role"], "__proto__");
  (void)read.take<char>(4 * 24);  // four vertices
  (void)read.raster();
  (void)read.take<char>(2 * 3 * 2);  // two triangles
  const auto points = read.take<float>(9);
  EXPECT_EQ(read.at, read.bytes.size());
  EXPECT_EQ(read.centre() + third(points, 1), (Vec3{3, 2, 1}));
  EXPECT_EQ(read.centre() + third(points, 2), (Vec3{0, 0, 5}));
}

const char* const kHostile[] = {"</script><img src=x onerror=alert(1)>",
                                "<!--<script>",
                                "\"><svg onload=alert(1)>",
                                "' onmouseover='x",
                                "\xff\xfe broken \xc3",
                                "line\nbreak\0tab\t",
                                "@FACTS@ @TITLE@ ${alert(1)} `",
                                "\xe2\x80\xa8 separator",
                                "Обвід 面"};

class HostileSurfaceNames : public Judged {};

TEST_F(HostileSurfaceNames, ArriveAsTextAndNothingElse) {
  for (const std::string name : kHostile) {
    SurfaceModel model = model_of({{name, rectangle(1, 1)}, {name, rectangle(2, 1)}}, name);
    model.units = name;
    PageOptions options;
    options.lines = {{{{0, 0, 0}, {1, 1, 1}}, name}};
    const std::string page = page_of(model, meshes_of(model, 2), options);
    EXPECT_EQ(judge({"html", write("page.html", page)}), "") << name;
    const json header = json::parse(element(page, "model"));
    EXPECT_EQ(header["patches"][1]["name"], picture::plain_text(name));
    EXPECT_EQ(header["name"], picture::plain_text(name));
  }
  EXPECT_EQ(picture::plain_text("Обвід 面"), "Обвід 面");
  EXPECT_EQ(picture::plain_text("a\xff\xc3z\n"), "a\xEF\xBF\xBD\xEF\xBF\xBDz ");
}

TEST_F(HostileSurfaceNames, PageIsGoodHtmlThatFetchesNothing) {
  const auto model = model_of({{"ring", torus(4, 1)}, {"", sphere(1)}});
  const std::string page = page_of(model, meshes_of(model, 8));
  EXPECT_EQ(judge({"html", write("page.html", page)}), "");
  EXPECT_NE(judge({"html", write("bad.html", page + "<img src=http://a.b>")}), "");
}

TEST(SurfacePage, IsTheSameEveryTimeAndSaysHowMuchThereIs) {
  const auto model = model_of({{"ring", torus(40, 10)}}, "Ring");
  auto meshes = meshes_of(model, 60);
  meshes[0].deviation = 0.0125;
  const std::string page = page_of(model, meshes);
  EXPECT_EQ(page, page_of(model, meshes));
  EXPECT_NE(page.find("<title>Ring</title>"), std::string::npos);
  EXPECT_NE(
      page.find("100 × 100 × 20 mm · 7\u202F200 triangles, at most 0.013 mm off where measured"),
      std::string::npos);
  EXPECT_LT(page.size(), 61U * 61U * 24U * 4U / 3U + 7200U * 8U + 120'000U);
}

TEST(SurfacePage, RefusesWhatItCannotShow) {
  const auto model = model_of({{"plate", rectangle(1, 1)}});
  const auto meshes = meshes_of(model, 2);
  EXPECT_EQ(error_of(model, {}), ErrorCode::kBadCount);
  EXPECT_EQ(error_of(model, {Mesh{}}), ErrorCode::kNothingThere);
  EXPECT_EQ(error_of({}, {}), ErrorCode::kNothingThere);
  auto broken = meshes;
  broken[0].vertices[3].point.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(model, broken), ErrorCode::kNotFinite);
  broken = meshes;
  broken[0].triangles[1][2] = 9;
  EXPECT_EQ(error_of(model, broken), ErrorCode::kBadCount);
  PageOptions few;
  few.most_triangles = 7;
  EXPECT_EQ(error_of(model, meshes, few), ErrorCode::kToleranceNotReached);
  PageOptions line;
  line.lines = {{{{0, 0, std::numeric_limits<double>::infinity()}}, "rapid"}};
  EXPECT_EQ(error_of(model, meshes, line), ErrorCode::kNotFinite);
  PageOptions stripes;
  stripes.zebra_stripes = 0;
  EXPECT_EQ(error_of(model, meshes, stripes), ErrorCode::kBadOption);
  PageOptions deviation;
  deviation.deviation = ShownDeviation{};  // of nothing
  EXPECT_EQ(error_of(model, meshes, deviation), ErrorCode::kBadOption);
  deviation.deviation->dots = {{{0, 0, std::numeric_limits<double>::infinity()}, 1.0}};
  EXPECT_EQ(error_of(model, meshes, deviation), ErrorCode::kNotFinite);
  auto wrong = model;
  wrong.patches[0].surface.points.pop_back();
  EXPECT_EQ(error_of(wrong, meshes), ErrorCode::kBadOption);
  const auto vast = model_of({{"plate", rectangle(1e200, 1)}});
  EXPECT_EQ(error_of(vast, meshes_of(vast, 1)), ErrorCode::kSizeOutOfRange);
}

TEST(SurfacePage, NamesOfViewsAndColouringsAreReadBack) {
  for (const char* name : {"shaded", "isolines", "gaussian", "mean", "k1", "k2", "zebra"}) {
    ASSERT_TRUE(colouring_named(name)) << name;
    EXPECT_EQ(name_of(*colouring_named(name)), name);
  }
  for (const char* name : {"iso", "front", "top", "side", "back", "bottom"}) {
    ASSERT_TRUE(surface_view_named(name)) << name;
    EXPECT_EQ(name_of(*surface_view_named(name)), name);
  }
  EXPECT_FALSE(colouring_named("pink"));
  EXPECT_FALSE(surface_view_named(""));
}

TEST(SurfacePage, NumbersAreWrittenForReading) {
  using picture::readable;
  EXPECT_EQ(readable(0.0, 3), "0");
  EXPECT_EQ(readable(-12.5, 3), "−12.5");
  EXPECT_EQ(readable(1234.5678, 6), "1234.57");
  EXPECT_EQ(readable(0.99996, 4), "1");
  EXPECT_EQ(readable(2.5e-7, 3), "2.5·10⁻⁷");
  EXPECT_EQ(readable(-3e12, 3), "−3·10¹²");
  EXPECT_EQ(readable(200.0, 3), "200");
}

}  // namespace
}  // namespace obvid
