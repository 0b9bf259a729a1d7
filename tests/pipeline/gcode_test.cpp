// SPDX-License-Identifier: Apache-2.0
// G-code through an interpreter that checks arcs like controllers do and measures the path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "obvid/exchange/gcode.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;
constexpr double kPi = std::numbers::pi;

/// What a controller does with a program: ends absolute, centres from the start.
class Interpreter {
 public:
  explicit Interpreter(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    while (std::getline(lines, line)) read(line);
  }

  std::vector<Vec2> path;    ///< dense
  std::vector<Vec2> places;  ///< some of each block
  std::vector<std::string> faults;
  std::size_t moves = 0;
  bool ended = false;

 private:
  void read(const std::string& line) {
    if (line.empty() || line[0] == '(' || line[0] == '%' || line[0] == 'O') return;
    std::map<char, double> words;
    std::istringstream in(line);
    std::string word;
    std::vector<double> g;
    while (in >> word) {
      const double value = std::stod(word.substr(1));
      if (word[0] == 'G') {
        g.push_back(value);
      } else if (word[0] == 'M') {
        ended = ended || value == 2.0 || value == 30.0;
      } else {
        words[word[0]] = value;
      }
    }
    for (const double code : g) {
      if (code <= 5.0) motion_ = static_cast<int>(code);
      if (code == 20.0) inches_ = true;
      if (code == 90.0) absolute_ = true;
      if (code == 17.0) plane_ = true;
    }
    if (words.count('F') != 0) feed_ = words['F'];
    if (words.count('X') == 0) return;
    move(words);
  }

  void move(std::map<char, double>& w) {
    const Vec2 end = {w['X'], w['Y']};
    if (!absolute_ || !plane_) faults.push_back("no G90 or G17 before the first move");
    if (motion_ == 0) {
      at_ = end;
      path = {end};
      return;
    }
    ++moves;
    const std::size_t before = path.size();
    if (!(feed_ > 0.0)) faults.push_back("a move without feed");
    if (motion_ == 1) line(end);
    if (motion_ == 2 || motion_ == 3) arc(end, {w['I'], w['J']});
    if (motion_ == 5) cubic(end, {w['I'], w['J']}, {w['P'], w['Q']});
    at_ = end;
    const std::size_t added = path.size() - before;
    for (std::size_t k = 1; k <= 8; ++k) places.push_back(path[before - 1 + added * k / 8]);
  }

  void line(Vec2 end) {
    if (end == at_) faults.push_back("a line of no length");
    path.push_back(end);
  }

  void arc(Vec2 end, Vec2 to_centre) {
    const Vec2 centre = at_ + to_centre;
    const double r0 = norm(to_centre), r1 = norm(end - centre), mismatch = std::abs(r0 - r1);
    const double millimetre = inches_ ? 1.0 / 25.4 : 1.0;
    // grbl (gcode.c): more than 0.5 mm, or more than 0.005 mm and 0.1 % of the radius
    if (mismatch > 0.5 * millimetre || (mismatch > 0.005 * millimetre && mismatch > 0.001 * r0)) {
      faults.push_back("grbl error 33");
    }
    // LinuxCNC (interp_arc): 0.00254 mm * 5 and a part of the radius
    if (mismatch > 0.0127 * millimetre) faults.push_back("LinuxCNC: radii differ");
    if (mismatch > 0.0005 * millimetre) faults.push_back("mismatch above 0.0005 mm");
    if (end == at_) faults.push_back("an arc that ends where it starts is a full circle");
    const double from = std::atan2(-to_centre.y, -to_centre.x);
    const Vec2 v = end - centre;
    double turn = std::remainder(std::atan2(v.y, v.x) - from, 2.0 * kPi);
    if (motion_ == 3 && turn <= 0.0) turn += 2.0 * kPi;
    if (motion_ == 2 && turn >= 0.0) turn -= 2.0 * kPi;
    if (std::abs(turn) > 0.6 * kPi) faults.push_back("an arc turns too far");
    constexpr int kSteps = 64;
    for (int k = 1; k <= kSteps; ++k) {
      const double a = from + turn * k / kSteps;
      path.push_back(centre + (r0 + (r1 - r0) * k / kSteps) * unit_at(a));
    }
  }

  void cubic(Vec2 end, Vec2 first, Vec2 second) {
    const Vec2 p[] = {at_, at_ + first, end + second, end};
    constexpr int kSteps = 64;
    for (int k = 1; k <= kSteps; ++k) {
      const double t = static_cast<double>(k) / kSteps, s = 1.0 - t;
      path.push_back((s * s * s) * p[0] + (3.0 * s * s * t) * p[1] + (3.0 * s * t * t) * p[2] +
                     (t * t * t) * p[3]);
    }
  }

  Vec2 at_;
  int motion_ = 0;
  bool inches_ = false, absolute_ = false, plane_ = false;
  double feed_ = 0.0;
};

/// Largest distance of points from a polyline that runs along with them.
double farthest(const std::vector<Vec2>& points, const std::vector<Vec2>& path) {
  double most = 0.0;
  std::size_t at = 0;
  const auto distance = [&](Vec2 p, std::size_t i) {
    const Vec2 along = path[i + 1] - path[i], v = p - path[i];
    const double length2 = dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(dot(v, along) / length2, 0.0, 1.0) : 0.0;
    return norm(v - t * along);
  };
  for (const Vec2 p : points) {
    double least = HUGE_VAL;
    std::size_t best = at;
    for (std::size_t i = at; i + 1 < path.size() && i < at + 8000; ++i) {
      const double d = distance(p, i);
      if (d < least) {
        least = d;
        best = i;
      }
    }
    at = best > 2 ? best - 2 : 0;
    most = std::max(most, least);
  }
  return most;
}

std::vector<Vec2> dense(const Contour& contour, int each) {
  std::vector<Vec2> out;
  for (const Piece& piece : contour.pieces) {
    for (int k = 0; k <= each; ++k) {
      out.push_back(evaluate(piece, static_cast<double>(k) / each).point);
    }
  }
  return out;
}

struct Made {
  std::size_t blocks = 0, line_blocks = 0;
};

/// Arcs and lines within the tolerance, both interpreted and measured.
Made check(const Contour& contour, double tolerance, const std::string& what) {
  Made made;
  for (const GcodeMotion motion : {GcodeMotion::kArcs, GcodeMotion::kLines}) {
    GcodeOptions options;
    options.motion = motion;
    options.tolerance = tolerance;
    const auto text = gcode_text(contour, options);
    EXPECT_TRUE(text) << what << to_line(text.error());
    if (!text) return made;
    const Interpreter run(text->text);
    EXPECT_TRUE(run.ended) << what;
    EXPECT_TRUE(run.faults.empty())
        << what << ": " << run.faults.size() << " " << run.faults.front();
    EXPECT_EQ(run.moves, text->blocks) << what;
    EXPECT_LE(text->deviation, tolerance) << what;
    EXPECT_LE(farthest(dense(contour, 60), run.path), tolerance) << what;
    const int each = std::max(10, 6000 / static_cast<int>(contour.pieces.size()));
    EXPECT_LE(farthest(run.places, dense(contour, each)), tolerance) << what;
    (motion == GcodeMotion::kArcs ? made.blocks : made.line_blocks) = text->blocks;
  }
  return made;
}

Contour fitted(PointSeries series, double scale, bool rounding) {
  for (Vec2& p : series.points) p = scale * p;
  series.rounding = scale * series.rounding;
  FitJob job;
  job.noise_from_rounding = rounding;
  auto f = fit(series, job);
  EXPECT_TRUE(f) << to_line(f.error());
  return f ? f->contour : Contour{};
}

const std::vector<Vec2> kReference = {
    {0, 0},          {0.21, -5.28},  {-5.11, -10.13}, {-20.48, -7.65}, {-28.68, 16.23},
    {-13.87, 40.95}, {17.95, 55.28}, {54.24, 53.04},  {100.94, 36.19}, {230.38, -50.82}};

Contour reference() {
  PointSeries series;
  series.points = kReference;
  return fitted(series, 1.0, false);
}

TEST(Gcode, ReferenceSeriesKeepsToleranceAndRulesOfControllers) {
  for (const double tolerance : {0.01, 0.001}) {
    const Made made = check(reference(), tolerance, "series10");
    EXPECT_LT(made.blocks * 4, made.line_blocks);
  }
}

TEST(Gcode, AirfoilsAndRailsNeedFiveTimesFewerBlocksThanLines) {
  const fs::path data = OBVID_SHARED_DATA;
  if (!fs::exists(data / "airfoils_uiuc_selig")) GTEST_SKIP() << "the public data are not there";
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(data / "airfoils_uiuc_selig")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const double tolerance : {0.01, 0.001}) {
    std::size_t arcs = 0, lines = 0;
    int count = 0;
    for (std::size_t i = 0; i < files.size() && count < 10; i += 80) {
      const auto series = read_points(files[i].string());
      if (!series) continue;
      const Contour contour = fitted(*series, 100.0, true);  // a chord of 100 mm
      const Made made = check(contour, tolerance, files[i].filename().string());
      arcs += made.blocks;
      lines += made.line_blocks;
      ++count;
    }
    EXPECT_EQ(count, 10);
    for (const auto& entry : fs::directory_iterator(data / "rail_wheel_profiles")) {
      const auto series = read_points(entry.path().string());
      if (!series) continue;
      const Contour contour = fitted(*series, 1.0, true);
      const Made made = check(contour, tolerance, entry.path().filename().string());
      arcs += made.blocks;
      lines += made.line_blocks;
    }
    const Made made = check(reference(), tolerance, "series10");
    arcs += made.blocks;
    lines += made.line_blocks;
    std::printf("tolerance %g mm: %zu blocks with arcs, %zu lines, ratio %.2f\n", tolerance, arcs,
                lines, static_cast<double>(lines) / static_cast<double>(arcs));
    EXPECT_GE(lines, 3 * arcs) << tolerance;
  }
}

TEST(Gcode, SplinesFollowTheContourOnLinuxCnc) {
  GcodeOptions options;
  options.motion = GcodeMotion::kSplines;
  options.controller = GcodeController::kLinuxCnc;
  const Contour contour = reference();
  const auto text = gcode_text(contour, options);
  ASSERT_TRUE(text);
  const Interpreter run(text->text);
  EXPECT_TRUE(run.faults.empty());
  EXPECT_LE(farthest(dense(contour, 60), run.path), options.tolerance);
  options.controller = GcodeController::kGrbl;
  EXPECT_EQ(gcode_text(contour, options).error().code, ErrorCode::kBadOption);
}

TEST(Gcode, InchesStayInchesAndMetresBecomeMillimetres) {
  Contour contour = reference();
  contour.units = "in";
  auto text = gcode_text(contour, {});
  ASSERT_TRUE(text);
  EXPECT_NE(text->text.find("G20"), std::string::npos);
  EXPECT_NE(text->text.find("X230.38000 Y-50.82000"), std::string::npos);
  contour.units = "m";
  text = gcode_text(contour, {});
  ASSERT_TRUE(text);
  EXPECT_NE(text->text.find("G21"), std::string::npos);
  EXPECT_NE(text->text.find("X230380.0000 Y-50820.0000"), std::string::npos);
}

TEST(Gcode, CirclesAreCutAtQuarters) {
  Contour c;
  c.units = "mm";
  c.pieces.emplace_back(ArcPiece{{5, 0}, {0, -5}, 0.5 * kPi, 0.2, 1.5 * kPi * 5.0});
  c.joints = {{{{5, 0}, 0.5 * kPi, 0.2}, std::nullopt, {}},
              {{{0, -5}, 2.0 * kPi, 0.2}, std::nullopt, {}}};
  c.points = {{5, 0}, {0, -5}};
  const auto text = gcode_text(c, {});
  ASSERT_TRUE(text);
  EXPECT_GE(text->arc_blocks, 3U);
  const Interpreter run(text->text);
  EXPECT_TRUE(run.faults.empty());
  for (const Vec2 p : run.path) EXPECT_NEAR(norm(p), 5.0, 2e-4);
}

TEST(Gcode, RefusesATolerancesBelowItsDigits) {
  GcodeOptions options;
  options.tolerance = 1e-6;
  EXPECT_EQ(gcode_text(reference(), options).error().code, ErrorCode::kBadOption);
  options.tolerance = 0.0;
  EXPECT_EQ(gcode_text(reference(), options).error().code, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace obvid
