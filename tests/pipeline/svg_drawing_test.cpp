// SPDX-License-Identifier: Apache-2.0
// Drawings in true scale, read back by the project's own reader and rendered by others.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "../common/programs.h"
#include "../common/ten_points.h"
#include "../common/text.h"
#include "obvid/exchange/internal/svg/drawing.h"
#include "obvid/exchange/internal/svg/read.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

Contour drawn_contour(Carrier carrier) {
  PointSeries series;
  series.points = kTenPoints;
  FitJob job;
  job.carrier = carrier;
  auto f = fit(series, job);
  EXPECT_TRUE(f);
  return f ? f->contour : Contour{};
}

/// Largest distance of dense points of one list of pieces from dense chords of the other.
double farthest_from_chords(const std::vector<Piece>& from, const std::vector<Piece>& to) {
  std::vector<Vec2> chain;
  for (const Piece& piece : to) {
    for (int k = 0; k <= 200; ++k) chain.push_back(evaluate(piece, k / 200.0).point);
  }
  double most = 0.0;
  for (const Piece& piece : from) {
    for (int k = 0; k <= 20; ++k) {
      const Vec2 p = evaluate(piece, k / 20.0).point;
      double least = HUGE_VAL;
      for (std::size_t i = 1; i < chain.size(); ++i) {
        const Vec2 along = chain[i] - chain[i - 1], v = p - chain[i - 1];
        const double t = std::clamp(dot(v, along) / std::max(dot(along, along), 1e-300), 0.0, 1.0);
        least = std::min(least, norm(v - t * along));
      }
      most = std::max(most, least);
    }
  }
  return most;
}

TEST(SvgDrawing, ReadsBackInTrueScaleWithinItsTolerance) {
  for (const Carrier carrier : kAllCarriers) {
    const Contour contour = drawn_contour(carrier);
    SvgDrawingOptions options;
    options.tolerance = 1e-3;
    const auto made = svg_drawing(contour, options);
    ASSERT_TRUE(made) << to_string(carrier) << to_line(made.error());
    EXPECT_LE(made->deviation, options.tolerance);
    auto read = parse_svg(made->text, "test.svg");
    ASSERT_TRUE(read) << to_line(read.error());
    ASSERT_EQ(read->curves.size(), 1U) << to_string(carrier);
    EXPECT_EQ(read->units, "mm");
    // the reader's origin is the sheet's corner: the start tells by how much all is moved
    std::vector<Piece> moved;
    const Vec2 shift = start_point(read->curves[0].pieces.front()) - kTenPoints.front();
    Contour back = contour;
    double most = 0.0;
    for (const Piece& piece : read->curves[0].pieces) {
      if (const auto* b = std::get_if<RationalBezier>(&piece)) {
        RationalBezier other = *b;
        other.origin = other.origin - shift;
        moved.emplace_back(other);
      } else if (const auto* a = std::get_if<ArcPiece>(&piece)) {
        moved.emplace_back(
            ArcPiece{a->start - shift, a->end - shift, a->theta0, a->kappa, a->length});
      } else {
        const auto& l = std::get<LinePiece>(piece);
        moved.emplace_back(LinePiece{l.start - shift, l.end - shift});
      }
    }
    most = std::max(farthest_from_chords(contour.pieces, moved),
                    farthest_from_chords(moved, contour.pieces));
    EXPECT_LE(most, options.tolerance * 1.1 + 1e-4) << to_string(carrier);  // chords of the test
  }
}

TEST(SvgDrawing, TheSheetHasTheContoursSizeInMillimetres) {
  Contour c;
  c.units = "in";
  c.pieces = {LinePiece{{0, 0}, {2, 0}}, LinePiece{{2, 0}, {2, 1}}};
  SvgDrawingOptions options;
  options.margin = 0.0;
  const auto made = svg_drawing(c, options);
  ASSERT_TRUE(made);
  EXPECT_NE(made->text.find("width=\"50.8mm\" height=\"25.4mm\" viewBox=\"0 0 2 1\""),
            std::string::npos)
      << made->text;
  EXPECT_NE(made->text.find("d=\"M0 0L2 0L2 1\""), std::string::npos);
  EXPECT_EQ(made->deviation, 0.0);
}

class Rendered : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    const auto made = svg_drawing(drawn_contour(Carrier::kSpiral), {});
    ASSERT_TRUE(made);
    std::ofstream(folder_ / "d.svg") << made->text;
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string png() const { return text_of_file(folder_ / "d.png"); }
  fs::path folder_;
};

TEST_F(Rendered, ByRsvg) {
  SKIP_WITHOUT_PROGRAM("rsvg-convert");
  const std::string d = folder_.string();
  EXPECT_EQ(std::system(("rsvg-convert -w 400 " + d + "/d.svg -o " + d + "/d.png").c_str()), 0);
  EXPECT_GT(png().size(), 1500U);  // an empty sheet of this size takes some 700 bytes
}

TEST_F(Rendered, ByChromium) {
  SKIP_WITHOUT_PROGRAM("chromium");
  const std::string d = folder_.string();
  const std::string command =
      "timeout 60 chromium --headless --no-sandbox --disable-gpu --disable-background-networking "
      "--no-first-run --user-data-dir=" +
      d + "/profile --screenshot=" + d + "/d.png --window-size=900,500 file://" + d +
      "/d.svg >/dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_GT(png().size(), 4000U);
}

}  // namespace
}  // namespace obvid
