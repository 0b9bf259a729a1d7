// SPDX-License-Identifier: Apache-2.0
// G-code through an interpreter that checks arcs like controllers do and measures the path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "../common/angles.h"
#include "../common/long_runs.h"
#include "../common/shared_data.h"
#include "../common/ten_points.h"
#include "obvid/exchange/internal/gcode/gcode.h"
#include "obvid/exchange/internal/gcode/path.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

/// What docs/methods/gcode.md says of blocks before they are rounded, rad; the program keeps it.
constexpr double kMostPlannedTurn = 3.15;
static_assert(kMostPlannedTurn == exchange::kMostBlockTurn);

namespace fs = std::filesystem;

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
        const auto point = word.find('.');
        if (word[0] == 'X' && point != std::string::npos) {
          last_digit_ = std::pow(10.0, -static_cast<double>(word.size() - point - 1));
        }
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

  /// grbl 1.1 (gcode.c, motion_control.c) computes in 32 bits: error 33 for radii that differ by
  /// more than 0.5 mm, or by more than 0.005 mm and 0.1 %; an arc that turns by less than 5e-7 the
  /// wrong way becomes a full circle.
  void check_like_grbl(Vec2 end, Vec2 to_centre) {
    const auto in_mm = [&](double v) { return static_cast<float>(v) * (inches_ ? 25.4F : 1.0F); };
    const float i = in_mm(to_centre.x), j = in_mm(to_centre.y);
    const float x = in_mm(end.x) - in_mm(at_.x) - i, y = in_mm(end.y) - in_mm(at_.y) - j;
    const float radius = std::hypot(i, j), difference = std::abs(std::hypot(x, y) - radius);
    if (difference > 0.5F || (difference > 0.005F && difference > 0.001F * radius)) {
      faults.push_back("grbl error 33");
    }
    const float travel = std::atan2(-i * y + j * x, -i * x - j * y);
    if ((motion_ == 3 && travel <= 5e-7F) || (motion_ == 2 && travel >= -5e-7F)) {
      faults.push_back("grbl makes a full circle of it");
    }
  }

  /// LinuxCNC (interp_find.cc): radii below 0.00127 mm are none; they may differ by 0.1 %, or by
  /// 0.02 sqrt(2) mm (in inches by 0.002 sqrt(2) in), and never by 100 times that.
  void check_like_linuxcnc(double r0, double r1) {
    const double millimetre = inches_ ? 1.0 / 25.4 : 1.0;
    const double spiral = inches_ ? 0.002 * std::sqrt(2.0) : 0.02 * std::sqrt(2.0);
    const double mismatch = std::abs(r0 - r1);
    if (std::min(r0, r1) < 0.00127 * millimetre) faults.push_back("LinuxCNC: zero-radius arc");
    if (mismatch > 100.0 * spiral || (mismatch > 0.001 * std::max(r0, r1) && mismatch > spiral)) {
      faults.push_back("LinuxCNC: radius to end of arc differs from radius to start");
    }
  }

  void arc(Vec2 end, Vec2 to_centre) {
    const Vec2 centre = at_ + to_centre;
    const double r0 = norm(to_centre), r1 = norm(end - centre);
    check_like_grbl(end, to_centre);
    check_like_linuxcnc(r0, r1);
    const double millimetre = inches_ ? 1.0 / 25.4 : 1.0;
    if (std::abs(r0 - r1) > 0.0005 * millimetre) faults.push_back("mismatch above 0.0005 mm");
    if (end == at_) faults.push_back("an arc that ends where it starts is a full circle");
    const double from = std::atan2(-to_centre.y, -to_centre.x);
    const Vec2 v = end - centre;
    double turn = std::remainder(std::atan2(v.y, v.x) - from, 2.0 * kPi);
    if (motion_ == 3 && turn <= 0.0) turn += 2.0 * kPi;
    if (motion_ == 2 && turn >= 0.0) turn -= 2.0 * kPi;
    // half a turn and half a degree, and what rounding both ends by half a last digit of x and y
    // adds; a sliver that points the wrong way turns almost around
    const double rounded = std::sqrt(2.0) * last_digit_ / std::min(r0, r1);
    if (std::abs(turn) > kMostPlannedTurn + rounded) faults.push_back("an arc turns too far");
    constexpr int kSteps =
        256;  // chords that miss their arc by far less than the 1 % asked of the deviation
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
  double last_digit_ = 1.0;  // of ends
  bool inches_ = false, absolute_ = false, plane_ = false;
  double feed_ = 0.0;
};

/// Largest distance of points from a polyline that runs along with them.
double farthest_from_path(const std::vector<Vec2>& points, const std::vector<Vec2>& path) {
  std::vector<double> way{0.0};
  for (std::size_t i = 1; i < path.size(); ++i)
    way.push_back(way.back() + norm(path[i] - path[i - 1]));
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
    const std::size_t end = std::min(path.size() - 1, at + 8000);
    for (std::size_t i = at; i < end;) {
      const double d = distance(p, i);
      if (d < least) {
        least = d;
        best = i;
      }
      // no chord is nearer by more than the way to it
      const double free = way[i + 1] + (norm(p - path[i + 1]) - least);
      const auto next = std::upper_bound(way.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                         way.begin() + static_cast<std::ptrdiff_t>(end), free);
      i = std::max(i + 1, static_cast<std::size_t>(next - way.begin()) - 1);
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

/// Fewest equal steps of arc length whose chords stay within the tolerance: a plain polyline.
std::size_t equal_steps(const Contour& contour, double tolerance) {
  const std::vector<Vec2> curve =
      dense(contour, 4000 / static_cast<int>(contour.pieces.size()) + 50);
  std::vector<double> length(1, 0.0);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    length.push_back(length.back() + norm(curve[i] - curve[i - 1]));
  }
  const auto fits = [&](std::size_t n) {
    std::size_t first = 0;
    for (std::size_t k = 1; k <= n; ++k) {
      const double end = length.back() * static_cast<double>(k) / static_cast<double>(n);
      const auto last = static_cast<std::size_t>(
          std::lower_bound(length.begin(), length.end() - 1, end) - length.begin());
      const Vec2 chord = curve[last] - curve[first];
      for (std::size_t i = first + 1; i < last; ++i) {
        if (std::abs(cross(chord, curve[i] - curve[first])) > tolerance * norm(chord)) return false;
      }
      first = last;
    }
    return true;
  };
  std::size_t n = 8;
  while (!fits(n)) n += n / 8;
  return n;
}

struct Made {
  std::size_t blocks = 0, line_blocks = 0, equal_steps = 0;

  void add(const Made& other) {
    blocks += other.blocks;
    line_blocks += other.line_blocks;
    equal_steps += other.equal_steps;
  }
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
    const double there = farthest_from_path(dense(contour, 60), run.path);
    const int each = std::max(10, 6000 / static_cast<int>(contour.pieces.size()));
    const double back = farthest_from_path(run.places, dense(contour, each));
    EXPECT_LE(there, 1.01 * text->deviation) << what;
    EXPECT_LE(back, 1.01 * text->deviation + 1e-3 * tolerance) << what;
    EXPECT_GE(std::max(there, back), 0.9 * text->deviation) << what;
    (motion == GcodeMotion::kArcs ? made.blocks : made.line_blocks) = text->blocks;
  }
  made.equal_steps = equal_steps(contour, tolerance);
  std::printf("%-24s %6g mm %6zu with arcs %7zu longest chords %8zu equal steps\n", what.c_str(),
              tolerance, made.blocks, made.line_blocks, made.equal_steps);
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

Contour reference() {
  PointSeries series;
  series.points = kTenPoints;
  return fitted(series, 1.0, false);
}

TEST(Gcode, ReferenceSeriesKeepsToleranceAndRulesOfControllers) {
  for (const double tolerance : {0.01, 0.001}) {
    const Made made = check(reference(), tolerance, "series10");
    EXPECT_LT(made.blocks * (tolerance > 0.005 ? 4 : 6), made.line_blocks);
  }
}

TEST(Gcode, AirfoilsAndRailsNeedFiveTimesFewerBlocksThanLines) {
  SKIP_WITHOUT("airfoils_uiuc_selig");
  const fs::path data = shared_data();
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(data / "airfoils_uiuc_selig")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  Made total;
  for (const double tolerance : {0.01, 0.001}) {
    const int most = test::cases_of(10, 3);
    int count = 0;
    for (std::size_t i = 0; i < files.size() && count < most; i += 80) {
      const auto series = read_points(files[i].string());
      if (!series) continue;
      const Contour contour = fitted(*series, 100.0, true);  // a chord of 100 mm
      total.add(check(contour, tolerance, files[i].filename().string()));
      ++count;
    }
    EXPECT_EQ(count, most);
    int rails = 0;
    for (const auto& entry : fs::directory_iterator(data / "rail_wheel_profiles")) {
      const auto series = read_points(entry.path().string());
      if (!series) continue;
      const Contour contour = fitted(*series, 1.0, true);
      total.add(check(contour, tolerance, entry.path().filename().string()));
      ++rails;
    }
    EXPECT_GT(rails, 0);
    total.add(check(reference(), tolerance, "series10"));
  }
  std::printf("in total %zu blocks with arcs, %zu longest chords, %zu equal steps\n", total.blocks,
              total.line_blocks, total.equal_steps);
  EXPECT_GE(total.equal_steps, 5 * total.blocks);
  EXPECT_GE(total.line_blocks, 3 * total.blocks);
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
  EXPECT_LE(farthest_from_path(dense(contour, 60), run.path), options.tolerance);
  options.controller = GcodeController::kGrbl;
  EXPECT_EQ(gcode_text(contour, options).error().code, ErrorCode::kBadOption);
}

TEST(Gcode, InchesStayInchesAndMetresBecomeMillimetres) {
  Contour contour = reference();
  contour.units = "in";
  auto text = gcode_text(contour, {});
  ASSERT_TRUE(text);
  EXPECT_NE(text->text.find("G20"), std::string::npos);
  EXPECT_NE(text->text.find("X230.3800 Y-50.8200"), std::string::npos);
  contour.units = "m";
  text = gcode_text(contour, {});
  ASSERT_TRUE(text);
  EXPECT_NE(text->text.find("G21"), std::string::npos);
  EXPECT_NE(text->text.find("(converted from m)"), std::string::npos);
  EXPECT_NE(text->text.find("X230380.000 Y-50820.000"), std::string::npos);
}

Contour three_quarters(double radius) {
  Contour c;
  c.pieces.emplace_back(
      ArcPiece{{radius, 0}, {0, -radius}, 0.5 * kPi, 1.0 / radius, 1.5 * kPi * radius});
  c.joints = {{{{radius, 0}, 0.5 * kPi, 1.0 / radius}, std::nullopt, {}},
              {{{0, -radius}, 2.0 * kPi, 1.0 / radius}, std::nullopt, {}}};
  return c;
}

TEST(Gcode, ACircleInThreePartsIsTwoHalves) {
  Contour c;
  c.closed = true;
  const double radius = 5.0, part = 2.0 * kPi / 3.0;
  for (int k = 0; k < 3; ++k) {
    const double theta = k * part + 0.5 * kPi;
    const Vec2 from = radius * unit_at(k * part);
    const Vec2 to = k == 2 ? Vec2{radius, 0.0} : radius * unit_at((k + 1) * part);
    c.joints.push_back({{from, theta, 1.0 / radius}, std::nullopt, {}});
    c.pieces.emplace_back(
        ArcPiece{k == 0 ? Vec2{radius, 0.0} : from, to, theta, 1.0 / radius, part * radius});
  }
  const auto text = gcode_text(c, {});
  ASSERT_TRUE(text) << to_line(text.error());
  EXPECT_EQ(text->blocks, 2U);
  EXPECT_EQ(text->arc_blocks, 2U);
  const Interpreter run(text->text);
  EXPECT_TRUE(run.faults.empty());
  for (const Vec2 p : run.path) EXPECT_NEAR(norm(p), radius, 7.1e-4);
}

TEST(Gcode, CirclesAreCutInPartsOfHalfATurnAtMost) {
  const auto text = gcode_text(three_quarters(5.0), {});
  ASSERT_TRUE(text);
  EXPECT_EQ(text->arc_blocks, 2U);
  const Interpreter run(text->text);
  EXPECT_TRUE(run.faults.empty());
  for (const Vec2 p : run.path) EXPECT_NEAR(norm(p), 5.0, 7.1e-4);  // half of 0.001, both ways
}

/// Arcs of a circle in mm, each over 0.1 rad.
Contour far_circle(Vec2 centre, double radius) {
  Contour contour;
  contour.units = {"mm", UnitSource::kGiven};
  Vec2 at = centre + Vec2{radius, 0.0};
  for (int k = 0; k < 12; ++k) {
    const double from = 0.1 * k, to = 0.1 * (k + 1);
    const Vec2 end = centre + radius * unit_at(to);
    contour.joints.push_back({{at, from + 0.5 * kPi, 1.0 / radius}, std::nullopt});
    contour.pieces.emplace_back(ArcPiece{at, end, from + 0.5 * kPi, 1.0 / radius, 0.1 * radius});
    at = end;
  }
  contour.joints.push_back({{at, 1.2 + 0.5 * kPi, 1.0 / radius}, std::nullopt});
  return contour;
}

/// The radii at both ends of each arc: all coordinates as whole thousandths, all centres as whole
/// hundred thousandths.
void expect_equal_radii(const std::string& text) {
  std::istringstream lines(text);
  long double x = 0, y = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto word = [&line](char letter) {
      const std::size_t place = line.find(std::string(" ") + letter);
      return place == std::string::npos ? 0.0L : std::strtold(line.c_str() + place + 2, nullptr);
    };
    const bool arc = line.starts_with("G2 ") || line.starts_with("G3 ");
    if (!arc && !line.starts_with("G0 X") && !line.starts_with("G1 X")) continue;
    const long double to_x = word('X'), to_y = word('Y'), i = word('I'), j = word('J');
    const long double before = std::hypot(i, j), after = std::hypot(i - (to_x - x), j - (to_y - y));
    if (arc) {
      EXPECT_LT(std::abs(before - after), 5e-5L) << line;
    }
    x = to_x;
    y = to_y;
  }
}

TEST(Gcode, RadiiAgreeAsPrintedWhereDoublesDoNotHoldTheLastDigit) {
  GcodeOptions options;
  options.tolerance = 10.0;
  options.decimals = 3;
  // 1.6e13 mm from the origin a double holds 0.002 mm; 0.001 mm are printed
  const Contour far = far_circle({16432391099802.398, 14245241658702.629}, 3e6);
  // here chords have more digits than a double
  const Contour large = far_circle({0.123, 0.456}, 1.2e13);
  for (const Contour& contour : {far, large}) {
    const auto text = gcode_text(contour, options);
    ASSERT_TRUE(text) << to_line(text.error());
    EXPECT_GT(text->arc_blocks, 0U);
    expect_equal_radii(text->text);
  }
}

TEST(Gcode, CentresThatTheirDecimalsDoNotHoldAreRefused) {
  GcodeOptions options;
  options.tolerance = 10.0;
  options.decimals = 3;
  const auto text = gcode_text(far_circle({0.0, 0.0}, 5.4e13), options);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::kToleranceNotReached);
  EXPECT_NE(text.error().what.find("too large"), std::string::npos) << to_line(text.error());
}

TEST(Gcode, ArcsSmallerThanTheLastDigitsAreLinesOrLeftOut) {
  GcodeOptions options;
  options.decimals = 3;
  auto text = gcode_text(three_quarters(0.004), options);
  ASSERT_TRUE(text);
  EXPECT_EQ(text->arc_blocks, 0U);
  EXPECT_EQ(Interpreter(text->text).faults.size(), 0U);
  EXPECT_LE(text->deviation, options.tolerance);
}

TEST(Gcode, ManyPiecesBelowTheLastDigitDoNotDrift) {
  Contour c;  // 1,000 pieces of 0.0004 mm, steps of the last digit are 0.001 mm
  const Vec2 step = {0.00037, 0.00015};
  for (int i = 0; i <= 1000; ++i) {
    c.joints.push_back({{i * step, heading(step), 0.0}, std::nullopt, {}});
    if (i > 0) c.pieces.emplace_back(LinePiece{(i - 1) * step, i * step});
  }
  GcodeOptions options;
  options.decimals = 3;
  const auto text = gcode_text(c, options);
  ASSERT_TRUE(text);
  const Interpreter run(text->text);
  EXPECT_TRUE(run.faults.empty());
  EXPECT_LT(text->blocks, 500U);
  EXPECT_EQ(run.path.back(), (Vec2{0.37, 0.15}));
  EXPECT_LT(text->deviation, 7.1e-4);
}

TEST(Gcode, SplinesTurnAtCorners) {
  const Contour one = reference();
  Contour c = one;  // twice, the second part turned at its start
  const Vec2 end = end_point(c.pieces.back());
  c.joints.back().leaving = c.joints.back().element;
  c.pieces.emplace_back(LinePiece{end, end + Vec2{0.0, 50.0}});
  c.joints.back().leaving = Element{end, 0.5 * kPi, 0.0};
  c.joints.push_back({{end + Vec2{0.0, 50.0}, 0.5 * kPi, 0.0}, std::nullopt, {}});
  GcodeOptions options;
  options.motion = GcodeMotion::kSplines;
  options.controller = GcodeController::kLinuxCnc;
  const auto text = gcode_text(c, options);
  ASSERT_TRUE(text) << to_line(text.error());
  EXPECT_LE(farthest_from_path(dense(c, 60), Interpreter(text->text).path), options.tolerance);
}

TEST(Gcode, ProgramsHaveTheFormOfTheirControllers) {
  GcodeOptions options;
  options.feed = 1.5e6;
  options.safe_z = 5.0;
  options.name = "a (nested) 100% name\n\xC3\xA4";
  const std::string grbl = gcode_text(three_quarters(5.0), options)->text;
  EXPECT_NE(grbl.find("G21 G90 G91.1 G17 G94\nG0 Z5.000\nG0 X5.000 Y0.000\nF1500000.000\n"
                      "G1 Z0.000\nG3 X"),
            std::string::npos)
      << grbl;
  EXPECT_NE(grbl.find("G0 Z5.000\nM2\n"), std::string::npos);
  EXPECT_NE(grbl.find("a nested 100 nameae)"), std::string::npos);
  options.controller = GcodeController::kFanuc;
  const std::string fanuc = gcode_text(three_quarters(5.0), options)->text;
  EXPECT_EQ(fanuc.substr(0, 8), "%\nO0001\n");
  EXPECT_EQ(fanuc.find("G91"), std::string::npos);
  EXPECT_EQ(fanuc.substr(fanuc.size() - 6), "M30\n%\n");
  for (std::istringstream lines(grbl); lines;) {
    std::string line;
    std::getline(lines, line);
    EXPECT_LE(line.size(), 79U) << "grbl reads lines of 80 characters";
  }
}

TEST(Gcode, RefusesWhatCannotBePrinted) {
  GcodeOptions options;
  options.tolerance = 1e-6;
  EXPECT_EQ(gcode_text(reference(), options).error().code, ErrorCode::kToleranceNotReached);
  options.tolerance = 0.01;
  options.decimals = 2;
  EXPECT_EQ(gcode_text(reference(), options).error().code, ErrorCode::kToleranceNotReached);
  for (const int decimals : {0, 7}) {
    options.decimals = decimals;
    EXPECT_EQ(gcode_text(reference(), options).error().code, ErrorCode::kBadOption);
  }
  options.decimals.reset();
  for (const double tolerance : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    options.tolerance = tolerance;
    EXPECT_EQ(gcode_text(reference(), options).error().code, ErrorCode::kBadOption);
  }
  Contour c = reference();
  c.units = "parsec";
  EXPECT_EQ(gcode_text(c, {}).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(gcode_text(Contour{}, {}).error().code, ErrorCode::kNothingThere);
}

}  // namespace
}  // namespace obvid
