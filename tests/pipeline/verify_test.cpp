// SPDX-License-Identifier: Apache-2.0
// A stored contour is proved again from its file alone, and every doctored file is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "../common/ten_points.h"
#include "../common/text.h"
#include "obvid/certify/certify.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/series/analysis.h"

namespace obvid {
namespace {

using nlohmann::json;

/// How far a doctored number is moved, relative to its own size or the contour's.
constexpr double kDoctored = 1e-6;
/// How far a claimed figure is moved.
constexpr double kClaimed = 1e-3;

std::vector<Vec2> moved(std::vector<Vec2> points, Vec2 by) {
  for (Vec2& p : points) p = p + by;
  return points;
}

/// One period and a half of a sine: several runs, inflections and vertices.
std::vector<Vec2> waves() {
  std::vector<Vec2> points;
  for (int i = 0; i <= 30; ++i) points.push_back({0.3 * i, std::sin(0.3 * i)});
  return points;
}

/// A line, a clothoid-like cubic beginning on it, a circle: stretches beside spirals.
std::vector<Vec2> line_spiral_arc() {
  std::vector<Vec2> points;
  for (int i = -6; i <= 0; ++i) points.push_back({static_cast<double>(i), 0.0});
  // theta = s^2/20, by the midpoint rule: any smooth transition will do
  double x = 0.0, y = 0.0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < 5 * kSteps; ++i) {
    const double s = (i + 0.5) / kSteps;
    x += std::cos(s * s / 20.0) / kSteps;
    y += std::sin(s * s / 20.0) / kSteps;
    if ((i + 1) % kSteps == 0) points.push_back({x, y});
  }
  const double theta = 25.0 / 20.0, radius = 2.0;  // kappa = s/10 = 1/2 at s = 5
  const Vec2 centre = {x - radius * std::sin(theta), y + radius * std::cos(theta)};
  for (int i = 1; i <= 6; ++i) {
    const double a = theta + 0.3 * i;
    points.push_back({centre.x + radius * std::sin(a), centre.y - radius * std::cos(a)});
  }
  return points;
}

/// A quarter of a circle of radius 10 as measured: in and out by at most `noise`.
std::vector<Vec2> measured_quarter(double noise) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 24; ++i) {
    points.push_back((10.0 + noise * std::sin(2.3 * i * i)) * unit_at(0.065 * i));
  }
  return points;
}

/// An upright rectangle with bulging sides: four corners, the first point repeated at the end.
std::vector<Vec2> bulging_rectangle() {
  const Vec2 corner[] = {{0, 0}, {8, 0}, {8, 4}, {0, 4}};
  std::vector<Vec2> points;
  for (std::size_t side = 0; side < 4; ++side) {
    const Vec2 from = corner[side], along = corner[(side + 1) % 4] - from;
    for (int i = 0; i < 8; ++i) {
      const double t = i / 8.0;
      points.push_back(from + t * along - 0.25 * t * (1.0 - t) * left_normal(along));
    }
  }
  points.push_back(corner[0]);
  return points;
}

/// x^2/36 + y^2/9 = 1, from inside a quarter.
std::vector<Vec2> closed_ellipse() {
  std::vector<Vec2> points;
  for (int i = 0; i <= 32; ++i) {
    const double a = 0.4 + 2.0 * std::numbers::pi * (i % 32) / 32.0;
    points.push_back({6.0 * std::cos(a), 3.0 * std::sin(a)});
  }
  return points;
}

struct Case {
  const char* name;
  std::vector<Vec2> points;
  Carrier carrier;
  double noise = 0.0;  ///< how far points may move, units
};

std::vector<Case> cases() {
  return {{"ten points", kTenPoints, Carrier::kSpiral},
          {"ten points of arcs", kTenPoints, Carrier::kArcs},
          {"ten points far away", moved(kTenPoints, {1e6, -3e6}), Carrier::kSpiral},
          {"waves", waves(), Carrier::kSpiral},
          {"waves of arcs", waves(), Carrier::kArcs},
          {"line, spiral, arc", line_spiral_arc(), Carrier::kSpiral},
          {"measured quarter", measured_quarter(0.01), Carrier::kSpiral, 0.01},
          {"bulging rectangle", bulging_rectangle(), Carrier::kSpiral},
          {"ellipse", closed_ellipse(), Carrier::kSpiral},
          {"ellipse of arcs", closed_ellipse(), Carrier::kArcs}};
}

StoredContour form(const Case& c) {
  PointSeries series;
  series.points = c.points;
  FitJob job;
  job.carrier = c.carrier;
  if (c.noise > 0.0) job.noise = c.noise;
  constexpr double kCoarse = 1e-3;  // of the size: few arcs, so that all can be doctored
  if (c.carrier == Carrier::kArcs) job.tolerance = kCoarse * analyse(c.points)->size;
  auto f = fit(series, job);
  if (!f) {
    ADD_FAILURE() << c.name << ": " << to_line(f.error());
    return {};
  }
  EXPECT_TRUE(f->certificate.proved) << c.name << ": " << f->certificate.reason;
  return {f->contour, f->report, f->certificate};
}

/// Empty when the file is accepted, else why not. A file that cannot be read is refused too.
std::string refusal(const std::string& text) {
  const auto stored = contour_from_json(text, "doctored");
  if (!stored) return "not read: " + stored.error().what;
  const Verification v = verify(*stored);
  if (v.false_claim) return v.false_claim->what;
  return v.certificate.proved ? std::string() : "not proved: " + v.certificate.reason;
}

TEST(VerifyStored, EveryFileOfTheTestContoursIsAsItClaims) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(OBVID_TEST_DATA) + "/contours")) {
    EXPECT_EQ(refusal(text_of_file(entry.path())), "") << entry.path().filename();
    ++files;
  }
  EXPECT_GT(files, 0U);
}

std::string refusal(const StoredContour& stored) { return refusal(contour_to_json(stored)); }

Case named(const std::string& name) {
  for (const Case& c : cases()) {
    if (c.name == name) return c;
  }
  ADD_FAILURE() << "no case " << name;
  return cases().front();
}

double size_by_analysis(const Contour& contour) { return analyse(contour.points)->size; }

TEST(Verify, AcceptsWhatFitWrote) {
  for (const Case& c : cases()) EXPECT_EQ(refusal(form(c)), "") << c.name;
}

TEST(Verify, RefusesAMovedControlPoint) {
  int doctored = 0;
  for (const Case& c : cases()) {
    const StoredContour good = form(c);
    const double step = kDoctored * size_by_analysis(good.contour);
    for (std::size_t i = 0; i < good.contour.pieces.size(); ++i) {
      const auto* piece = std::get_if<RationalBezier>(&good.contour.pieces[i]);
      if (piece == nullptr) continue;
      for (std::size_t j = 0; j <= static_cast<std::size_t>(piece->degree); ++j) {
        for (const Vec2 by : {Vec2{step, 0.0}, Vec2{0.0, step}, Vec2{-step, step}}) {
          StoredContour bad = good;
          Vec2& p = std::get<RationalBezier>(bad.contour.pieces[i]).offset[j];
          p = p + by;
          EXPECT_NE(refusal(bad), "") << c.name << ": piece " << i << ", point " << j;
          ++doctored;
        }
      }
    }
  }
  std::printf("%d control points moved\n", doctored);
  EXPECT_GT(doctored, 500);
}

TEST(Verify, RefusesAChangedWeight) {
  int doctored = 0;
  for (const Case& c : cases()) {
    const StoredContour good = form(c);
    for (std::size_t i = 0; i < good.contour.pieces.size(); ++i) {
      const auto* piece = std::get_if<RationalBezier>(&good.contour.pieces[i]);
      if (piece == nullptr) continue;
      for (std::size_t j = 0; j <= static_cast<std::size_t>(piece->degree); ++j) {
        StoredContour bad = good;
        std::get<RationalBezier>(bad.contour.pieces[i]).weight[j] *= 1.0 + kDoctored;
        EXPECT_NE(refusal(bad), "") << c.name << ": piece " << i << ", weight " << j;
        ++doctored;
      }
    }
  }
  std::printf("%d weights changed\n", doctored);
  EXPECT_GT(doctored, 200);
}

TEST(Verify, RefusesAChangedArc) {
  using Change = std::function<void(ArcPiece&, double)>;  // arc, size
  const std::vector<std::pair<const char*, Change>> changes = {
      {"kappa", [](ArcPiece& a, double) { a.kappa *= 1.0 + kDoctored; }},
      {"length", [](ArcPiece& a, double) { a.length *= 1.0 + kDoctored; }},
      {"theta0", [](ArcPiece& a, double) { a.theta0 += kDoctored; }},
      {"start", [](ArcPiece& a, double size) { a.start.x += kDoctored * size; }},
      {"end", [](ArcPiece& a, double size) { a.end.y += kDoctored * size; }}};
  int doctored = 0;
  for (const Case& c : cases()) {
    const StoredContour good = form(c);
    const double size = size_by_analysis(good.contour);
    for (std::size_t i = 0; i < good.contour.pieces.size(); ++i) {
      if (!std::holds_alternative<ArcPiece>(good.contour.pieces[i])) continue;
      for (const auto& [name, change] : changes) {
        StoredContour bad = good;
        change(std::get<ArcPiece>(bad.contour.pieces[i]), size);
        EXPECT_NE(refusal(bad), "") << c.name << ": " << name << " of piece " << i;
        ++doctored;
      }
    }
  }
  std::printf("%d numbers of arcs changed\n", doctored);
  EXPECT_GT(doctored, 100);
}

TEST(Verify, RefusesAMovedLine) {
  const StoredContour good = form(named("line, spiral, arc"));
  const double step = kDoctored * size_by_analysis(good.contour);
  int doctored = 0;
  for (std::size_t i = 0; i < good.contour.pieces.size(); ++i) {
    if (!std::holds_alternative<LinePiece>(good.contour.pieces[i])) continue;
    for (const Vec2 by : {Vec2{step, 0.0}, Vec2{0.0, step}}) {
      StoredContour bad = good;
      auto& line = std::get<LinePiece>(bad.contour.pieces[i]);
      line.end = line.end + by;
      EXPECT_NE(refusal(bad), "") << "piece " << i;
      ++doctored;
    }
  }
  EXPECT_GE(doctored, 12);
}

/// The arcs that meet at a joint have two curvatures; the element's may be any one between them.
bool between_two_arcs(const Contour& contour, std::size_t joint) {
  return contour.carrier == Carrier::kArcs && joint > 0 && joint < contour.pieces.size();
}

TEST(Verify, RefusesAChangedElement) {
  int doctored = 0;
  for (const Case& c : cases()) {
    const StoredContour good = form(c);
    const double size = size_by_analysis(good.contour);
    for (std::size_t i = 0; i < good.contour.joints.size(); ++i) {
      const auto refused = [&](const char* name, auto change) {
        StoredContour bad = good;
        change(bad.contour.joints[i]);
        EXPECT_NE(refusal(bad), "") << c.name << ": " << name << " of element " << i;
        ++doctored;
      };
      refused("heading", [](Joint& j) { j.element.theta += kDoctored; });
      refused("point", [&](Joint& j) { j.element.point.x += kDoctored * size; });
      refused("curvature", [&](Joint& j) {
        constexpr double kBeyondBothArcs = 1e6;  // over the size: no arc here bends like that
        const bool two = between_two_arcs(good.contour, i);
        const double flat = j.element.kappa == 0.0 ? 1.0 / size : 0.0;
        j.element.kappa = two ? kBeyondBothArcs / size : j.element.kappa * (1.0 + kDoctored) + flat;
      });
      if (good.contour.joints[i].source) {
        refused("source", [](Joint& j) { j.source.reset(); });
      }
    }
    for (std::size_t i = 0; i < good.contour.points.size(); ++i) {
      StoredContour bad = good;
      bad.contour.points[i].y += kDoctored * size;
      EXPECT_NE(refusal(bad), "") << c.name << ": point " << i;
      ++doctored;
    }
  }
  std::printf("%d elements and points changed\n", doctored);
  EXPECT_GT(doctored, 200);
}

/// Every number and every boolean below a place of the file.
void collect(const json& value, const std::string& path, std::vector<std::string>& out) {
  if (value.is_number() || value.is_boolean()) out.push_back(path);
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) collect(inner, path + "/" + key, out);
  }
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      collect(value[i], path + "/" + std::to_string(i), out);
  }
}

/// Numbers that say nothing about the contour, or whose change makes a weaker claim that is still
/// true:
/// - how long the computation took, and how the chain was solved: the file cannot show it;
/// - the tolerance made a little larger: the widths still keep it;
/// - gaps of the joints made larger: a gap is claimed to be *at most* this;
/// - whether exact arithmetic was needed: how a verdict was found, not what it says;
/// - distances from the spirals, which are not in the file.
/// The waviness is told to a thousandth: a test of its own changes it.
bool no_claim(const std::string& path) {
  return path == "/report/seconds" || path == "/report/tolerance" || path == "/report/waviness" ||
         path == "/report/carrier_deviation" || path == "/report/outside_spirals_region" ||
         path.rfind("/report/chain/", 0) == 0 || path.rfind("/certificate/joint_gaps/", 0) == 0 ||
         (path.size() > 17 && path.find("exact_arithmetic") != std::string::npos);
}

json doctored_value(const json& value, double size) {
  if (value.is_boolean()) return !value.get<bool>();
  // The writer marks counts: they have no fraction and are parsed as integers. A figure of 0 is
  // written like a count; moving it by 1 is a doctored figure too.
  if (value.is_number_integer()) return value.get<long long>() + 1;
  const double number = value.get<double>();
  constexpr double kNothing = 1e-13;  // of the size: differences of coordinates say no more
  return std::abs(number) < kNothing * size ? kClaimed * size : number * (1.0 + kClaimed);
}

TEST(Verify, RefusesEveryChangedNumberOfReportAndCertificate) {
  int doctored = 0;
  for (const Case& c : cases()) {
    const StoredContour good = form(c);
    const double size = size_by_analysis(good.contour);
    const json document = json::parse(contour_to_json(good));
    ASSERT_EQ(refusal(document.dump()), "") << c.name;
    std::vector<std::string> paths;
    for (const char* part : {"/report", "/certificate", "/runs"})
      collect(document[json::json_pointer(part)], part, paths);
    for (const std::string& path : paths) {
      if (no_claim(path)) continue;
      json bad = document;
      json& value = bad[json::json_pointer(path)];
      value = doctored_value(value, size);
      EXPECT_NE(refusal(bad.dump()), "") << c.name << ": " << path << " = " << value;
      ++doctored;
    }
  }
  std::printf("%d claims changed\n", doctored);
  EXPECT_GT(doctored, 400);
}

TEST(Verify, RefusesAnotherWaviness) {
  int doctored = 0;
  for (const Case& c : cases()) {
    const StoredContour good = form(c);
    json document = json::parse(contour_to_json(good));
    json& value = document["report"]["waviness"];
    const json stated = value;
    if (stated.is_null()) {
      value = 1.0;
      EXPECT_NE(refusal(document.dump()), "") << c.name << ": a waviness that nothing has";
      continue;
    }
    for (const double factor : {0.99, 1.01}) {
      value = factor * stated.get<double>();
      EXPECT_NE(refusal(document.dump()), "") << c.name << ": " << stated << " times " << factor;
      ++doctored;
    }
  }
  EXPECT_GT(doctored, 4);
}

TEST(Verify, RefusesFiguresMadeSmallerOrLeftOut) {
  const StoredContour good = form(cases().front());
  const json document = json::parse(contour_to_json(good));
  std::vector<std::string> paths;
  collect(document["report"]["segments"], "/report/segments", paths);
  for (const std::string& path : paths) {
    for (const json& other : {json(nullptr), json(0)}) {
      json bad = document;
      json& value = bad[json::json_pointer(path)];
      if (value == other) continue;
      value = other;
      EXPECT_NE(refusal(bad.dump()), "") << path << " = " << other;
    }
  }
  json narrow = document;
  narrow["report"]["tolerance"] = 0.5 * good.report->largest_width;
  EXPECT_NE(refusal(narrow.dump()), "") << "a tolerance below the widths";
}

TEST(Verify, RefusesVerdictsThatTheCurveDoesNotHave) {
  const StoredContour good = form(cases().front());
  const json document = json::parse(contour_to_json(good));
  for (std::size_t i = 0; i < good.contour.pieces.size(); ++i) {
    for (const char* verdict :
         {"increasing", "decreasing", "constant", "has-vertex", "undecided"}) {
      json bad = document;
      json& value = bad["certificate"]["monotone"][i]["verdict"];
      if (value == verdict) continue;
      value = verdict;
      EXPECT_NE(refusal(bad.dump()), "") << "piece " << i << " " << verdict;
    }
  }
}

TEST(Verify, RefusesAGapThatTheFileHides) {
  // a heading gap of 1e-10 rad is below the bound of what is called continuous, but not zero
  StoredContour stored = form(cases().front());
  auto& piece = std::get<RationalBezier>(stored.contour.pieces[4]);
  const Vec2 leg = piece.offset[1] - piece.offset[0];
  piece.offset[1] = piece.offset[1] + 1e-10 * left_normal(leg);
  const Verification v = verify(stored);
  EXPECT_GT(v.certificate.gaps.heading, 0.9e-10);
  EXPECT_TRUE(v.false_claim.has_value());
}

TEST(Verify, RefusesAnotherSeriesReport) {
  StoredContour stored = form(cases().front());
  const StoredContour other = form(cases()[3]);
  stored.report = other.report;
  EXPECT_NE(refusal(stored), "");
  stored = form(cases().front());
  stored.certificate = other.certificate;
  EXPECT_NE(refusal(stored), "");
}

TEST(Verify, RefusesAToleranceBelowTheMoveOfItsPoint) {
  const StoredContour good = form(named("measured quarter"));
  const std::vector<double>& moves = good.report->moves;
  ASSERT_EQ(moves.size(), good.contour.points.size());
  int doctored = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    EXPECT_LE(moves[i], good.contour.point_tolerance[i]) << i;
    if (moves[i] == 0.0) continue;
    StoredContour bad = good;
    bad.contour.point_tolerance[i] = (1.0 - kDoctored) * moves[i];
    // a joint may stand farther from its point than its neighbourhood does: refused or proved anew
    // with a smaller move, which then contradicts the file
    EXPECT_NE(refusal(bad), "") << "point " << i;
    ++doctored;
  }
  EXPECT_GT(doctored, 15);
}

TEST(Verify, RefusesMovesThatAreMissingOrOfAnotherPoint) {
  const StoredContour good = form(named("measured quarter"));
  StoredContour bad = good;
  bad.report->moves.pop_back();
  EXPECT_NE(refusal(bad), "") << "one missing";
  bad = good;
  std::reverse(bad.report->moves.begin(), bad.report->moves.end());
  EXPECT_NE(refusal(bad), "") << "in another order";
  bad = good;
  bad.contour.point_tolerance.clear();
  EXPECT_NE(refusal(bad), "") << "exact, with moves";
}

TEST(Verify, RefusesACornerThatIsNotMarkedAndASmoothJointThatIs) {
  const StoredContour good = form(named("bulging rectangle"));
  EXPECT_TRUE(good.contour.closed);
  ASSERT_EQ(good.certificate->corners, 4);
  for (std::size_t i = 0; i < good.contour.joints.size(); ++i) {
    StoredContour bad = good;
    Joint& joint = bad.contour.joints[i];
    if (joint.leaving) {
      joint.leaving.reset();
    } else {
      joint.leaving = joint.element;  // a weaker claim, but the file counts four corners
    }
    EXPECT_NE(refusal(bad), "") << "joint " << i;
  }
}

TEST(Verify, RefusesEitherSideOfACornerThatIsNotItsPieces) {
  const StoredContour good = form(named("bulging rectangle"));
  int doctored = 0;
  for (std::size_t i = 0; i < good.contour.joints.size(); ++i) {
    if (!good.contour.joints[i].leaving) continue;
    StoredContour turned = good, bent = good;
    turned.contour.joints[i].leaving->theta += kDoctored;
    bent.contour.joints[i].leaving->kappa += kDoctored / size_by_analysis(good.contour);
    EXPECT_NE(refusal(turned), "") << "heading behind corner " << i;
    EXPECT_NE(refusal(bent), "") << "curvature behind corner " << i;
    doctored += 2;
  }
  EXPECT_EQ(doctored, 8);
}

TEST(Verify, RefusesAClosedContourCalledOpenAndTheOtherWayRound) {
  StoredContour closed = form(named("ellipse"));
  EXPECT_TRUE(closed.contour.closed);
  EXPECT_EQ(closed.certificate->vertices, 4) << "of an ellipse";
  closed.contour.closed = false;
  EXPECT_NE(refusal(closed), "");
  StoredContour open = form(named("measured quarter"));
  open.contour.closed = true;
  EXPECT_NE(refusal(open), "");
}

TEST(Verify, WithoutClaimsProvesTheCurveAlone) {
  StoredContour stored = form(cases().front());
  stored.report.reset();
  stored.certificate.reset();
  EXPECT_EQ(refusal(stored), "");
}

TEST(Verify, ATooWideRegionThatTheFileTellsIsNoFalseClaim) {
  StoredContour stored{{}, FitReport{}, Certificate{}};
  stored.report->largest_width = 2.0;
  stored.report->tolerance = 1.0;
  Verification found;
  found.certificate.proved = true;
  const auto broken = broken_promise(stored, found);
  ASSERT_TRUE(broken);
  EXPECT_EQ(broken->code, ErrorCode::kToleranceNotReached);
  stored.report->tolerance = 3.0;
  EXPECT_FALSE(broken_promise(stored, found));
}

TEST(Verify, AJointThatNamesAnotherPointThanItStandsOnIsRefused) {
  PointSeries series;
  for (int i = 0; i < 14; ++i) {
    const double t = 0.25 * i, off = i % 2 == 0 ? 0.001 : -0.001;
    series.points.push_back({(3.0 + off) * std::cos(t), 2.0 * std::sin(t)});
  }
  FitJob job;
  job.noise = 0.005;
  const auto made = fit(series, job);
  ASSERT_TRUE(made && made->certificate.proved);
  Contour contour = made->contour;
  ASSERT_GT(contour.joints.size(), 2U);
  ASSERT_TRUE(certify(contour).proved);
  // the last but one joint that stands on a point names the one behind it, where no other does
  std::size_t at = contour.joints.size() - 2;
  while (at > 0 && !contour.joints[at].source) --at;
  ASSERT_TRUE(contour.joints[at].source);
  const std::size_t named = *contour.joints[at].source + 1;
  ASSERT_LT(named, series.points.size());
  for (std::size_t k = at + 1; k < contour.joints.size(); ++k) {
    if (contour.joints[k].source == named) contour.joints[k].source.reset();
  }
  contour.joints[at].source = named;
  const Certificate c = obvid::certify(contour);
  EXPECT_FALSE(c.proved);
  EXPECT_FALSE(c.through_points);
}

TEST(Verify, PointsInAnotherOrderAreTheReasonAndNotTheFiguresBesideThem) {
  StoredContour stored = form(cases().front());
  std::reverse(stored.contour.points.begin(), stored.contour.points.end());
  const Verification reversed = verify(stored);
  ASSERT_TRUE(reversed.false_claim);
  EXPECT_EQ(reversed.false_claim->where, "/points");
  EXPECT_EQ(reversed.false_claim->what,
            "the file claims through_points, but joint 1 does not stand on point 1");
}

TEST(Verify, AGivenCornerStandsWhereTheFileSays) {
  PointSeries series;
  series.points = {{0, 0}, {10, 1}, {20, 3}, {30, 7}, {30, 17}, {31, 27}, {34, 37}, {40, 46}};
  FitJob job;
  job.constraints = {{3, {}, {}, true}};
  auto made = fit(series, job);
  ASSERT_TRUE(made);
  ASSERT_TRUE(made->certificate.proved);
  StoredContour stored{made->contour, made->report, made->certificate};
  ASSERT_FALSE(verify(stored).false_claim);
  ASSERT_EQ(stored.contour.given.size(), 1U);
  for (const std::size_t elsewhere : {1, 2, 4, 5}) {
    stored.contour.given[0].point = elsewhere;
    EXPECT_TRUE(verify(stored).false_claim) << elsewhere;
  }
}

}  // namespace
}  // namespace obvid
