// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/contour_json.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace obvid {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool same_bits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(Vec2 a, Vec2 b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y); }

void expect_same(const LinePiece& a, const LinePiece& b) {
  EXPECT_TRUE(same_bits(a.start, b.start) && same_bits(a.end, b.end));
}

void expect_same(const ArcPiece& a, const ArcPiece& b) {
  EXPECT_TRUE(same_bits(a.start, b.start) && same_bits(a.end, b.end));
  EXPECT_TRUE(same_bits(a.theta0, b.theta0) && same_bits(a.kappa, b.kappa));
  EXPECT_TRUE(same_bits(a.length, b.length));
}

void expect_same(const ClothoidPiece& a, const ClothoidPiece& b) {
  EXPECT_TRUE(same_bits(a.start, b.start) && same_bits(a.end, b.end));
  EXPECT_TRUE(same_bits(a.theta0, b.theta0) && same_bits(a.length, b.length));
  EXPECT_TRUE(same_bits(a.kappa0, b.kappa0) && same_bits(a.kappa1, b.kappa1));
}

void expect_same(const RationalBezier& a, const RationalBezier& b) {
  ASSERT_EQ(a.degree, b.degree);
  EXPECT_TRUE(same_bits(a.origin, b.origin));
  for (std::size_t j = 0; j <= static_cast<std::size_t>(a.degree); ++j) {
    EXPECT_TRUE(same_bits(a.offset[j], b.offset[j]));
    EXPECT_TRUE(same_bits(a.weight[j], b.weight[j]));
  }
}

void expect_same(const Contour& a, const Contour& b) {
  EXPECT_EQ(a.units, b.units);
  EXPECT_EQ(a.closed, b.closed);
  EXPECT_EQ(a.carrier, b.carrier);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_TRUE(same_bits(a.points[i], b.points[i]));
  }
  ASSERT_EQ(a.point_tolerance.size(), b.point_tolerance.size());
  for (std::size_t i = 0; i < a.point_tolerance.size(); ++i) {
    EXPECT_TRUE(same_bits(a.point_tolerance[i], b.point_tolerance[i]));
  }
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    EXPECT_TRUE(same_bits(a.joints[i].element.point, b.joints[i].element.point));
    EXPECT_TRUE(same_bits(a.joints[i].element.theta, b.joints[i].element.theta));
    EXPECT_TRUE(same_bits(a.joints[i].element.kappa, b.joints[i].element.kappa));
    EXPECT_EQ(a.joints[i].source, b.joints[i].source);
    ASSERT_EQ(a.joints[i].leaving.has_value(), b.joints[i].leaving.has_value());
    if (!a.joints[i].leaving) continue;
    EXPECT_TRUE(same_bits(a.joints[i].leaving->point, b.joints[i].leaving->point));
    EXPECT_TRUE(same_bits(a.joints[i].leaving->theta, b.joints[i].leaving->theta));
    EXPECT_TRUE(same_bits(a.joints[i].leaving->kappa, b.joints[i].leaving->kappa));
  }
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    ASSERT_EQ(a.pieces[i].index(), b.pieces[i].index());
    std::visit(
        [&](const auto& piece) {
          expect_same(piece, std::get<std::decay_t<decltype(piece)>>(b.pieces[i]));
        },
        a.pieces[i]);
  }
  ASSERT_EQ(a.runs.size(), b.runs.size());
  for (std::size_t i = 0; i < a.runs.size(); ++i) {
    EXPECT_EQ(a.runs[i].first_piece, b.runs[i].first_piece);
    EXPECT_EQ(a.runs[i].last_piece, b.runs[i].last_piece);
    EXPECT_EQ(a.runs[i].direction, b.runs[i].direction);
  }
}

void expect_same(const FitReport& a, const FitReport& b) {
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    const SegmentReport& p = a.segments[i];
    const SegmentReport& q = b.segments[i];
    EXPECT_TRUE(same_bits(p.chord, q.chord) && same_bits(p.width, q.width));
    EXPECT_TRUE(same_bits(p.points_only_error, q.points_only_error));
    EXPECT_TRUE(same_bits(p.width_unrefined, q.width_unrefined));
    EXPECT_TRUE(same_bits(p.deviation, q.deviation));
    EXPECT_TRUE(same_bits(p.deviation_at.x, q.deviation_at.x));
    EXPECT_TRUE(same_bits(p.deviation_at.y, q.deviation_at.y));
    EXPECT_EQ(p.inserted, q.inserted);
  }
  EXPECT_TRUE(same_bits(a.tolerance, b.tolerance) && same_bits(a.largest_width, b.largest_width));
  EXPECT_TRUE(same_bits(a.largest_move, b.largest_move) && same_bits(a.seconds, b.seconds));
  ASSERT_EQ(a.moves.size(), b.moves.size());
  for (std::size_t i = 0; i < a.moves.size(); ++i) {
    EXPECT_TRUE(same_bits(a.moves[i], b.moves[i]));
  }
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.vertices_lower_bound, b.vertices_lower_bound);
  EXPECT_EQ(a.inflections, b.inflections);
  EXPECT_EQ(a.inserted_points, b.inserted_points);
  EXPECT_EQ(a.chain.newton_steps, b.chain.newton_steps);
  EXPECT_TRUE(same_bits(a.chain.smallest_margin, b.chain.smallest_margin));
  EXPECT_EQ(a.chain.free_elements, b.chain.free_elements);
}

void expect_same(const Certificate& a, const Certificate& b) {
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    EXPECT_EQ(a.pieces[i].verdict, b.pieces[i].verdict);
    EXPECT_EQ(a.pieces[i].exact_arithmetic, b.pieces[i].exact_arithmetic);
    EXPECT_TRUE(same_bits(a.pieces[i].t0, b.pieces[i].t0));
    EXPECT_TRUE(same_bits(a.pieces[i].t1, b.pieces[i].t1));
  }
  EXPECT_TRUE(same_bits(a.gaps.position, b.gaps.position));
  EXPECT_TRUE(same_bits(a.gaps.heading, b.gaps.heading));
  EXPECT_TRUE(same_bits(a.gaps.curvature, b.gaps.curvature));
  EXPECT_EQ(a.gaps_within_bounds, b.gaps_within_bounds);
  EXPECT_EQ(a.inside_region, b.inside_region);
  EXPECT_EQ(a.through_points, b.through_points);
  EXPECT_TRUE(same_bits(a.largest_move, b.largest_move));
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.inflections, b.inflections);
  EXPECT_EQ(a.self_intersections, b.self_intersections);
  EXPECT_EQ(a.proved, b.proved);
  EXPECT_EQ(a.reason, b.reason);
}

/// Doubles of every size and sign; zeros of both signs and whole numbers among them.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}

  double any() {
    switch (random_() % 6) {
      case 0:
        return 0.0;
      case 1:
        return -0.0;
      case 2:
        return static_cast<double>(random_() % 1000000);
      default:
        break;
    }
    for (;;) {
      const auto value = std::bit_cast<double>(random_());
      if (std::isfinite(value)) return value;
    }
  }
  double positive() {
    const double value = std::fabs(any());
    return value > 0.0 ? value : 1.0;
  }
  /// Limits of the numbers of a contour: docs/methods/certify.md, section 4.
  double within(double limit) {
    for (;;) {
      const double value = any();
      if (std::fabs(value) <= limit) return value;
    }
  }
  double between(double low, double high) {
    for (;;) {
      const double value = positive();
      if (value >= low && value <= high) return value;
    }
  }
  Vec2 point() { return {within(1e100), within(1e100)}; }
  /// At least 1e-100 apart.
  std::pair<Vec2, Vec2> two_points() {
    for (;;) {
      const Vec2 a = point(), b = point();
      if (std::max(std::fabs(a.x - b.x), std::fabs(a.y - b.y)) >= 1e-100) return {a, b};
    }
  }
  double length() { return between(1e-100, 1e100); }
  double heading() { return within(25.0); }  // rad
  double weight() { return between(1e-50, 1e50); }
  std::size_t below(std::size_t n) { return random_() % n; }
  bool coin() { return random_() % 2 == 0; }

 private:
  std::mt19937_64 random_;
};

RationalBezier random_bezier(Numbers& numbers) {
  RationalBezier bezier;
  bezier.degree = 1 + static_cast<int>(numbers.below(kMaxBezierDegree));
  const bool far = numbers.coin();
  const bool weighted = numbers.coin();
  const auto [first, last] = numbers.two_points();
  if (far) bezier.origin = {1234.5, -8.25e6};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(bezier.degree); ++j) {
    bezier.offset[j] =
        far ? Vec2{1e-7 * static_cast<double>(numbers.below(1000) + 1000 * j), -1e-9 / 3}
            : (j == 0   ? first
               : j == 1 ? last
                        : numbers.point());
    bezier.weight[j] = weighted ? numbers.weight() : 1.0;
  }
  return bezier;
}

Piece random_piece(Numbers& numbers) {
  const auto [start, end] = numbers.two_points();
  const double length = numbers.length();
  const auto curvature = [&] { return numbers.within(60.0) / length; };  // ten turns at the most
  switch (numbers.below(4)) {
    case 0:
      return LinePiece{start, end};
    case 1:
      return ArcPiece{start, end, numbers.heading(), numbers.between(1e-9, 60.0) / length, length};
    case 2:
      return ClothoidPiece{start, end, numbers.heading(), curvature(), curvature(), length};
    default:
      return random_bezier(numbers);
  }
}

Contour random_contour(Numbers& numbers) {
  Contour contour;
  contour.units = numbers.coin() ? "mm" : "\xC2\xB5m \"quoted\" \\";
  constexpr Carrier kCarriers[] = {Carrier::kSpiral, Carrier::kArcs, Carrier::kClothoids};
  contour.carrier = kCarriers[numbers.below(3)];
  const std::size_t pieces = 1 + numbers.below(6);
  for (std::size_t i = 0; i < pieces; ++i) contour.pieces.push_back(random_piece(numbers));
  contour.points = {{0.0, -0.0}, {1.0 / 3.0, 1e-300}};  // no contour is smaller than 1e-100
  for (std::size_t i = 0; i < numbers.below(6); ++i) contour.points.push_back(numbers.point());
  if (numbers.coin()) {
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      contour.point_tolerance.push_back(numbers.coin() ? 0.0 : numbers.length());
    }
  }
  contour.closed = numbers.coin();
  const std::size_t joints = contour.closed && numbers.coin() ? pieces : pieces + 1;
  for (std::size_t i = 0; i < joints; ++i) {
    Joint joint{
        {numbers.point(), numbers.heading(), numbers.within(1e130)}, std::nullopt, std::nullopt};
    if (numbers.coin()) joint.source = numbers.below(contour.points.size());
    const bool inner = contour.closed || (i > 0 && i < pieces);
    if (inner && numbers.below(4) == 0) {
      joint.leaving = Element{joint.element.point, numbers.heading(), numbers.within(1e130)};
    }
    contour.joints.push_back(joint);
  }
  contour.runs.push_back({0, pieces - 1, static_cast<int>(numbers.below(3)) - 1});
  return contour;
}

FitReport random_report(Numbers& numbers, std::size_t points, std::size_t segments,
                        std::size_t moves) {
  FitReport report;
  for (std::size_t i = 0; i < moves; ++i) report.moves.push_back(numbers.positive());
  for (std::size_t i = 0; i < segments; ++i) {
    report.segments.push_back({numbers.below(points),
                               numbers.below(points),
                               numbers.positive(),
                               numbers.coin() ? kNan : numbers.any(),
                               numbers.any(),
                               numbers.any(),
                               numbers.any(),
                               {numbers.any(), numbers.any()},
                               numbers.below(9)});
  }
  report.tolerance = numbers.between(1e90, 1e300);  // 1e-12 of any size at least
  report.largest_width = numbers.any();
  report.largest_deviation = numbers.any();
  report.largest_move = numbers.any();
  report.given = {numbers.below(5), numbers.below(5), numbers.below(5), numbers.positive(),
                  numbers.positive()};
  if (numbers.coin()) report.waviness = numbers.positive();
  if (numbers.coin()) report.carrier_deviation = numbers.positive();
  if (numbers.coin()) report.outside_spirals_region = numbers.positive();
  report.vertices = static_cast<int>(numbers.below(5));
  report.vertices_lower_bound = static_cast<int>(numbers.below(5));
  report.inflections = static_cast<int>(numbers.below(5));
  report.inserted_points = numbers.below(1000);
  report.seconds = numbers.any();
  report.chain.newton_steps = static_cast<int>(numbers.below(50));
  report.chain.smallest_margin = numbers.any();
  report.chain.free_elements = numbers.below(4);
  if (numbers.coin()) {
    report.chain.slope_step_g2 = numbers.positive();
    if (numbers.coin()) report.chain.waviness_g2 = numbers.positive();
  }
  return report;
}

Certificate random_certificate(Numbers& numbers, std::size_t pieces) {
  Certificate claims;
  for (std::size_t i = 0; i < pieces; ++i) {
    PieceProof proof{static_cast<Verdict>(numbers.below(5)), numbers.coin()};
    if (numbers.coin()) proof.t0 = 0.25;
    if (numbers.coin()) proof.t1 = 1.0 / 3;
    claims.pieces.push_back(proof);
  }
  claims.gaps = {numbers.any(), numbers.coin() ? kNan : 0.0, numbers.any()};
  claims.gaps_within_bounds = numbers.coin();
  claims.inside_region = numbers.coin();
  claims.through_points = numbers.coin();
  claims.largest_move = numbers.positive();
  claims.corners = static_cast<int>(numbers.below(5));
  claims.vertices = static_cast<int>(numbers.below(5));
  claims.inflections = static_cast<int>(numbers.below(5));
  claims.self_intersections = static_cast<int>(numbers.below(5));
  claims.proved = numbers.coin();
  claims.reason = claims.proved ? "" : "piece 3: \"undecided\"";
  return claims;
}

TEST(ContourJson, EveryContourReadsBackToTheSameBits) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Numbers numbers(seed);
    StoredContour stored{random_contour(numbers), std::nullopt, std::nullopt};
    const std::size_t points = stored.contour.points.size();
    if (numbers.coin()) {
      stored.report = random_report(numbers, points, points - 1, numbers.coin() ? points : 0);
    }
    if (numbers.coin()) {
      stored.certificate = random_certificate(numbers, stored.contour.pieces.size());
    }
    const std::string text = contour_to_json(stored);
    const auto read = contour_from_json(text, "f");
    ASSERT_TRUE(read.has_value()) << to_line(read.error()) << text;
    expect_same(stored.contour, read->contour);
    ASSERT_EQ(stored.report.has_value(), read->report.has_value());
    ASSERT_EQ(stored.certificate.has_value(), read->certificate.has_value());
    if (stored.report) expect_same(*stored.report, *read->report);
    if (stored.certificate) expect_same(*stored.certificate, *read->certificate);
    EXPECT_EQ(contour_to_json(*read), text);
  }
}

/// A small contour file of each piece; texts in it are changed to see what is refused.
const std::string kSmall = R"({ "format": "obvid-contour", "version": 1, "units": "mm",
 "closed": false, "carrier": "spiral",
 "points": [[0, 0], [1, 0], [2, 1]],
 "elements": [{"point": [0, 0], "heading": 0, "kappa": 0, "source": 0},
              {"point": [1, 0], "heading": 0, "kappa": 0, "source": null},
              {"point": [2, 1], "heading": 1.5, "kappa": 1},
              {"point": [2, 2], "heading": 1.5, "kappa": 0}],
 "pieces": [{"type": "line", "start": [0, 0], "end": [1, 0]},
            {"type": "arc", "start": [1, 0], "end": [2, 1], "theta0": 0, "kappa": 1, "length": 1.5},
            {"type": "bezier", "points": [[2, 1], [2, 1.5], [2, 2]]}],
 "runs": [{"first_piece": 0, "last_piece": 2, "direction": 1}],
 "anything": [null],
 "report": {"segments": [{"chord": 1, "points_only_error": null, "width": 0, "deviation": 0},
                         {"chord": 1, "points_only_error": null, "width": 0, "deviation": 0}],
            "tolerance": 1e-3, "largest_width": 0, "largest_move": 0, "vertices": 2,
            "vertices_lower_bound": 0, "inflections": 1, "inserted_points": 0, "seconds": 0},
 "certificate": {"monotone": [{"piece": 0, "verdict": "constant"},
                              {"piece": 1, "verdict": "constant"},
                              {"piece": 2, "verdict": "has-vertex"}],
                 "joint_gaps": {"position": 0, "heading": 0, "curvature": 1},
                 "inside_region": true, "proved": true} })";

std::string with(const std::string& old, const std::string& now) {
  std::string text = kSmall;
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), now);
}

TEST(ContourJson, FilesOfOtherProgramsMayLeaveOutWhatTheFormatLetsThem) {
  const auto read = contour_from_json(kSmall, "f");
  ASSERT_TRUE(read.has_value()) << to_line(read.error());
  EXPECT_EQ(read->contour.pieces.size(), 3U);
  const auto& bezier = std::get<RationalBezier>(read->contour.pieces[2]);
  EXPECT_EQ(bezier.degree, 2);
  EXPECT_EQ(bezier.weight[2], 1.0);
  EXPECT_EQ(bezier.offset[1], (Vec2{2, 1.5}));
  EXPECT_TRUE(read->certificate->through_points);
  EXPECT_EQ(read->certificate->vertices, 2);
  EXPECT_TRUE(std::isnan(read->report->segments[0].points_only_error));
}

TEST(ContourJson, AFileWithoutTolerancesAndCornersHasNone) {
  const auto read = contour_from_json(kSmall, "f");
  ASSERT_TRUE(read.has_value());
  EXPECT_TRUE(read->contour.point_tolerance.empty());
  EXPECT_TRUE(read->report->moves.empty());
  EXPECT_EQ(read->certificate->corners, 0);
  EXPECT_EQ(read->certificate->largest_move, 0.0);
  const std::string text = contour_to_json(*read);
  EXPECT_EQ(text.find("point_tolerance"), std::string::npos);
  EXPECT_EQ(text.find("\"moves\""), std::string::npos);
  EXPECT_EQ(text.find("\"corner\""), std::string::npos);
}

void expect_refused(const std::string& text, ErrorCode code, const std::string& where) {
  const auto read = contour_from_json(text, "f");
  ASSERT_FALSE(read.has_value()) << where;
  EXPECT_EQ(read.error().code, code) << to_line(read.error());
  EXPECT_EQ(read.error().where, where) << to_line(read.error());
}

TEST(ContourJson, SyntaxErrorsNameLineAndColumn) {
  expect_refused("", ErrorCode::kBadJson, "f:1:1");
  expect_refused("{\n  \"format\": nonsense\n}", ErrorCode::kBadJson, "f:2:14");
  expect_refused("{\n  \"a\": 1,,\n}", ErrorCode::kBadJson, "f:2:10");
  expect_refused("[1, 2", ErrorCode::kBadJson, "f:1:6");
  expect_refused("{\"a\": NaN}", ErrorCode::kBadJson, "f:1:7");
}

TEST(ContourJson, DeepNestingIsRefusedBeforeItCostsAnything) {
  const std::string deep(1000000, '[');
  expect_refused(deep, ErrorCode::kBadJson, "f:1:65");
  EXPECT_TRUE(contour_from_json(with("[null]", "\"[[[[\\\"" + deep + "\""), "f").has_value());
}

TEST(ContourJson, MeaningErrorsNameTheField) {
  const ErrorCode bad = ErrorCode::kBadJson;
  expect_refused("[]", bad, "f: /");
  expect_refused(with("obvid-contour", "other"), bad, "f: /format");
  expect_refused(with("\"units\": \"mm\",", ""), bad, "f: /units");
  expect_refused(with("\"closed\": false", "\"closed\": 0"), bad, "f: /closed");
  expect_refused(with("[1, 0], [2, 1]]", "[1, 0], [2]]"), bad, "f: /points/2");
  expect_refused(with("[1, 0], [2, 1]]", "[1, \"0\"], [2, 1]]"), bad, "f: /points/1/1");
  expect_refused(with("\"heading\": 0", "\"heading\": null"), bad, "f: /elements/0/heading");
  expect_refused(with("\"source\": 0", "\"source\": 3"), bad, "f: /elements/0/source");
  expect_refused(with("\"source\": 0", "\"source\": 0.5"), bad, "f: /elements/0/source");
  expect_refused(with("\"source\": 0", "\"source\": -1"), bad, "f: /elements/0/source");
  expect_refused(with(",\n              {\"point\": [2, 2], \"heading\": 1.5, \"kappa\": 0}", ""),
                 bad, "f: /elements");
  expect_refused(with("\"length\": 1.5", "\"length\": 0"), bad, "f: /pieces/1/length");
  expect_refused(with("\"theta0\": 0, \"kappa\": 1", "\"theta0\": 0, \"kappa\": 0"), bad,
                 "f: /pieces/1/kappa");
  expect_refused(with("\"arc\"", "\"clothoid\""), bad, "f: /pieces/1/kappa0");
  const std::string clothoid = "\"clothoid\", \"kappa0\": 1, \"kappa1\": 2, \"length\": 0";
  expect_refused(with("\"line\"", clothoid + ", \"theta0\": 0"), bad, "f: /pieces/0/length");
  expect_refused(with("[[2, 1], [2, 1.5], [2, 2]]", "[[2, 1]]"), bad, "f: /pieces/2/points");
  expect_refused(
      with("[[2, 1], [2, 1.5], [2, 2]]", "[[0,0],[0,0],[0,0],[0,0],[0,0],[0,0],[0,0],[0,0],[0,0]]"),
      bad, "f: /pieces/2/points");
  expect_refused(with("[2, 2]]}", "[2, 2]], \"weights\": [1, 2]}"), bad, "f: /pieces/2/weights");
  expect_refused(with("[2, 2]]}", "[2, 2]], \"weights\": [1, 2, 0]}"), bad,
                 "f: /pieces/2/weights/2");
  expect_refused(with("\"last_piece\": 2", "\"last_piece\": 3"), bad, "f: /runs/0/last_piece");
  expect_refused(with("\"direction\": 1", "\"direction\": 2"), bad, "f: /runs/0/direction");
  expect_refused(
      with("{\"chord\": 1, \"points_only_error\": null, \"width\": 0, \"deviation\": 0},", ""), bad,
      "f: /report/segments");
  expect_refused(with("\"vertices\": 2", "\"vertices\": 2.5"), bad, "f: /report/vertices");
  expect_refused(with("\"piece\": 1", "\"piece\": 2"), bad, "f: /certificate/monotone/1/piece");
  expect_refused(with("has-vertex", "fine"), bad, "f: /certificate/monotone/2/verdict");
  expect_refused(with("\"proved\": true", "\"proved\": \"yes\""), bad, "f: /certificate/proved");
}

TEST(ContourJson, NumbersBeyondDoublesAreRefused) {
  const auto read = contour_from_json(with("\"heading\": 0", "\"heading\": 1e999"), "f");
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().code, ErrorCode::kBadJson);
}

TEST(ContourJson, WhatThisVersionDoesNotKnowIsCalledUnsupported) {
  const ErrorCode unknown = ErrorCode::kUnsupported;
  expect_refused(with("\"version\": 1", "\"version\": 2"), unknown, "f: /version");
  expect_refused(with("\"spiral\"", "\"quintics\""), unknown, "f: /carrier");
  expect_refused(with("\"line\"", "\"conic\""), unknown, "f: /pieces/0/type");
}

TEST(ContourJson, CornersSayHowTheContourLeavesThem) {
  const std::string smooth = "\"heading\": 0, \"kappa\": 0, \"source\": null";
  const std::string corner = smooth + ", \"corner\": true, \"heading_out\": 1.5, \"kappa_out\": -2";
  const auto read = contour_from_json(with(smooth, corner), "f");
  ASSERT_TRUE(read.has_value()) << to_line(read.error());
  ASSERT_TRUE(read->contour.joints[1].leaving);
  EXPECT_EQ(read->contour.joints[1].leaving->point, (Vec2{1, 0}));
  EXPECT_EQ(read->contour.joints[1].leaving->theta, 1.5);
  EXPECT_EQ(read->contour.joints[1].leaving->kappa, -2.0);
  EXPECT_FALSE(read->contour.joints[0].leaving || read->contour.joints[2].leaving);
  EXPECT_EQ(read->certificate->corners, 1) << "what the elements say, unless it is claimed";
  EXPECT_NE(contour_to_json(*read).find(corner), std::string::npos);
}

TEST(ContourJson, HalfACornerIsRefused) {
  const ErrorCode bad = ErrorCode::kBadJson;
  const std::string smooth = "\"kappa\": 0, \"source\": null";
  const std::string out = ", \"heading_out\": 1.5, \"kappa_out\": -2";
  expect_refused(with(smooth, smooth + ", \"corner\": true, \"heading_out\": 1"), bad,
                 "f: /elements/1/kappa_out");
  expect_refused(with(smooth, smooth + out), bad, "f: /elements/1/heading_out");
  expect_refused(with(smooth, smooth + ", \"corner\": false" + out), bad,
                 "f: /elements/1/heading_out");
  const std::string first = "\"source\": 0";
  const std::string at_start = with(first, first + ", \"corner\": true" + out);
  expect_refused(at_start, bad, "f: /elements/0");
  expect_refused(with("1.5, \"kappa\": 0", "1.5, \"kappa\": 0, \"corner\": true" + out), bad,
                 "f: /elements/3");
  std::string closed = at_start;
  closed.replace(closed.find("false"), 5, "true");
  EXPECT_TRUE(contour_from_json(closed, "f").has_value()) << "a seam may be a corner";
}

TEST(ContourJson, ACornerOnNoPointNamesThePointsBesideIt) {
  const std::string smooth = "\"heading\": 0, \"kappa\": 0, \"source\": null";
  const std::string corner = smooth + ", \"corner\": true, \"heading_out\": 1.5, \"kappa_out\": -2";
  const auto beside = [](const std::string& points) { return ", \"between\": [" + points + "]"; };
  const auto read = contour_from_json(with(smooth, corner + beside("0, 1")), "f");
  ASSERT_TRUE(read.has_value()) << to_line(read.error());
  EXPECT_EQ(read->contour.joints[1].after, std::optional<std::size_t>(0));
  EXPECT_NE(contour_to_json(*read).find(corner + beside("0, 1")), std::string::npos);
  const ErrorCode bad = ErrorCode::kBadJson;
  for (const char* points : {"0", "0, 2", "1, 0", "0, 1, 2"}) {
    expect_refused(with(smooth, corner + beside(points)), bad, "f: /elements/1/between");
  }
  expect_refused(with(smooth, smooth + beside("0, 1")), bad, "f: /elements/1/between");
}

TEST(ContourJson, TolerancesAndMovesAreOneForEachPoint) {
  const ErrorCode bad = ErrorCode::kBadJson;
  const std::string elements = "\"elements\"";
  const auto tolerance = [&](const std::string& list) {
    return with(elements, "\"point_tolerance\": " + list + ", " + elements);
  };
  const auto read = contour_from_json(tolerance("[0, 0.5, 1e-3]"), "f");
  ASSERT_TRUE(read.has_value()) << to_line(read.error());
  EXPECT_EQ(read->contour.point_tolerance, (std::vector<double>{0.0, 0.5, 1e-3}));
  expect_refused(tolerance("0.5"), bad, "f: /point_tolerance");
  expect_refused(tolerance("[0.5, 0.5]"), bad, "f: /point_tolerance");
  expect_refused(tolerance("[0.5, 0.5, -1]"), bad, "f: /point_tolerance/2");
  expect_refused(tolerance("[0.5, null, 1]"), bad, "f: /point_tolerance/1");
  const std::string move = "\"largest_move\": 0";
  const auto moves = contour_from_json(with(move, move + ", \"moves\": [0, 0.25, 1]"), "f");
  ASSERT_TRUE(moves.has_value()) << to_line(moves.error());
  EXPECT_EQ(moves->report->moves, (std::vector<double>{0.0, 0.25, 1.0}));
  expect_refused(with(move, move + ", \"moves\": [0, 0.25]"), bad, "f: /report/moves");
}

TEST(ContourJson, PointsWithTolerancesNeedNoRowOfTheirOwn) {
  // The only joint on a point is the first: one part, hence one row.
  const std::string row =
      "{\"chord\": 1, \"points_only_error\": null, \"width\": 0, \"deviation\": 0},";
  std::string text = with(row, "");
  expect_refused(text, ErrorCode::kBadJson, "f: /report/segments");
  text.replace(text.find("\"elements\""), 0, "\"point_tolerance\": [1, 1, 1], ");
  const auto read = contour_from_json(text, "f");
  EXPECT_TRUE(read.has_value()) << to_line(read.error());
}

StoredContour two_parabolas() {
  StoredContour stored;
  Contour& contour = stored.contour;
  contour.points = {{0, 0}, {2, 1}, {3, 4}};
  for (std::size_t i = 0; i < 3; ++i) {
    contour.joints.push_back({{contour.points[i], 0.0, 0.0}, i, std::nullopt});
  }
  for (const auto& control : {std::array<Vec2, 3>{Vec2{0, 0}, Vec2{1, 0}, Vec2{2, 1}},
                              std::array<Vec2, 3>{Vec2{2, 1}, Vec2{3, 2}, Vec2{3, 4}}}) {
    RationalBezier piece;
    piece.degree = 2;
    std::copy(control.begin(), control.end(), piece.offset.begin());
    piece.weight = {1.0, 0.75, 1.0};
    contour.pieces.emplace_back(piece);
  }
  contour.runs = {{0, 1, 1}};
  return stored;
}

TEST(ContourJson, TheOneCurveIsWrittenAndMustBeThatOfThePieces) {
  const std::string text = contour_to_json(two_parabolas());
  const std::string knots = "\"knots\": [0, 0, 0, 1, 1, 2, 2, 2]";
  ASSERT_NE(text.find(knots), std::string::npos) << text;
  EXPECT_TRUE(contour_from_json(text, "f").has_value());
  std::string other_knots = text;
  other_knots.replace(text.find(knots), knots.size(), "\"knots\": [0, 0, 0, 1, 1, 3, 3, 3]");
  expect_refused(other_knots, ErrorCode::kBadJson, "f: /bspline");
  std::string other_weight = text;
  other_weight.replace(text.rfind("0.75"), 4, "0.76");
  expect_refused(other_weight, ErrorCode::kBadJson, "f: /bspline");
}

TEST(ContourJson, ExactPointsMustRoundToThePointsBesideThem) {
  const std::string exact =
      "[2, 2]], \"exact\": {\"origin\": [2, 1], \"offsets\": "
      "[[0, 0], [0, 0.5], [1e-20, 1]]}}";
  const auto read = contour_from_json(with("[2, 2]]}", exact), "f");
  ASSERT_TRUE(read.has_value()) << to_line(read.error());
  const auto& bezier = std::get<RationalBezier>(read->contour.pieces[2]);
  EXPECT_EQ(bezier.origin, (Vec2{2, 1}));
  EXPECT_EQ(bezier.offset[2], (Vec2{1e-20, 1}));
  std::string moved = exact;
  moved.replace(moved.find("0.5]"), 3, "0.500001");
  expect_refused(with("[2, 2]]}", moved), ErrorCode::kBadJson, "f: /pieces/2/points/1");
  std::string fewer = exact;
  fewer.replace(fewer.find(", [1e-20, 1]"), 12, "");
  expect_refused(with("[2, 2]]}", fewer), ErrorCode::kBadJson, "f: /pieces/2/exact/offsets");
}

TEST(ContourJson, OnePointOrPieceStandsOnALine) {
  const auto read = contour_from_json(kSmall, "f");
  ASSERT_TRUE(read.has_value());
  const std::string text = contour_to_json(*read);
  EXPECT_NE(text.find("\n    [1, 0],\n    [2, 1]\n  ],\n"), std::string::npos);
  EXPECT_NE(text.find("\n    {\"type\": \"bezier\", \"points\": [[2, 1], [2, 1.5], [2, 2]]}\n"),
            std::string::npos);
}

/// Lines through points of a parabola, with corners.
Contour lines_through(std::size_t count) {
  Contour out;
  out.carrier = Carrier::kArcs;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i);
    out.points.push_back({x, x * x});
  }
  double heading = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    Joint joint{{out.points[i], heading, 0.0}, i, std::nullopt};
    if (i + 1 < count) {
      const Vec2 to = out.points[i + 1] - out.points[i];
      heading = std::atan2(to.y, to.x);
      (i > 0 ? joint.leaving.emplace(joint.element) : joint.element).theta = heading;
      out.pieces.push_back(LinePiece{out.points[i], out.points[i + 1]});
      out.runs.push_back({i, i, 0});
    }
    out.joints.push_back(joint);
  }
  return out;
}

TEST(ContourJson, LongTextsAskWhetherToGoOnAndEndWhereTheyAreToldTo) {
  const std::string text = contour_to_json({lines_through(3000), std::nullopt, std::nullopt});
  int asked = 0, last = 1 << 30;
  const auto read = [&] {
    asked = 0;
    Watch watch({{}, [&] { return ++asked >= last; }});
    return contour_from_json(text, "f", &watch);
  };
  const auto whole = read();
  ASSERT_TRUE(whole) << to_line(whole.error());
  const int in_all = asked;
  // three passes over all bytes, each item of five lists, unknown fields
  EXPECT_GE(in_all, static_cast<int>(2 * text.size() / 65536 + 5 * 3000 / 256));
  for (const int stop : {1, in_all / 4, in_all / 2, 3 * in_all / 4, in_all}) {
    last = stop;
    const auto cancelled = read();
    ASSERT_FALSE(cancelled) << last;
    EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled) << last;
    EXPECT_EQ(asked, last);
  }
}

TEST(ContourJson, TextThatIsNotUtf8IsWrittenAsValidJson) {
  auto read = contour_from_json(kSmall, "f");
  ASSERT_TRUE(read.has_value());
  read->contour.units = "\xFF\n\x01";
  EXPECT_TRUE(contour_from_json(contour_to_json(*read), "f").has_value());
}

}  // namespace
}  // namespace obvid
