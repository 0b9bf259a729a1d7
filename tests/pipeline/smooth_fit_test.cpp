// SPDX-License-Identifier: Apache-2.0
// Whole fits with continuous slopes of curvature: no vertex more than the G2 contour, the same from
// either end, and less wavy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "fit/waviness.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

Result<Fit> shaped(std::vector<Vec2> points, Continuity continuity, double noise = 0.0) {
  PointSeries series;
  series.points = std::move(points);
  FitJob job;
  job.continuity = continuity;
  job.find_corners = false;
  if (noise > 0.0) job.noise = noise;
  return fit(series, job);
}

/// Points of a clothoid, curvature 0.2 to 2.2, at uneven steps.
std::vector<Vec2> clothoid_points(std::size_t n, std::mt19937_64& random) {
  std::vector<double> step;
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    step.push_back(1.0 + std::generate_canonical<double, 53>(random));
    sum += step.back();
  }
  std::vector<Vec2> out = {{0.0, 0.0}};
  double s = 0.0;
  for (const double one : step) {
    s += one / sum;
    out.push_back(clothoid_step(0.3, 0.2, 0.2 + 2.0 * s, s));
  }
  return out;
}

/// A closed course with bends to both sides, its points moved at random.
std::vector<Vec2> measured_course(std::size_t n, double noise, std::mt19937_64& random) {
  std::normal_distribution<double> error(0.0, noise);
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const double r = 100.0 + 25.0 * std::cos(3.0 * t) + 8.0 * std::sin(5.0 * t);
    out.push_back({r * std::cos(t) + error(random), r * std::sin(t) + error(random)});
  }
  out.push_back(out.front());
  return out;
}

double longest_chord(const std::vector<Vec2>& points) {
  double longest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    longest = std::max(longest, norm(points[i] - points[i - 1]));
  }
  return longest;
}

TEST(SmoothFit, IsTheSameCurveFromEitherEnd) {
  std::mt19937_64 random(15);
  for (std::size_t n = 8; n <= 30; n += 2) {
    std::vector<Vec2> points = clothoid_points(n, random);
    const auto there = shaped(points, Continuity::kG3);
    const double chord = longest_chord(points);
    std::reverse(points.begin(), points.end());
    const auto back = shaped(points, Continuity::kG3);
    ASSERT_TRUE(there && back);
    const std::size_t pieces = there->contour.pieces.size();
    ASSERT_EQ(back->contour.pieces.size(), pieces);
    for (std::size_t i = 0; i < pieces; ++i) {
      const Piece& other = back->contour.pieces[pieces - 1 - i];
      const Vec2 middle = evaluate(there->contour.pieces[i], 0.5).point;
      double u = 0.5;
      for (int k = 0; k < 6; ++k) {
        const Jet jet = evaluate(other, u);
        u -= dot(jet.point - middle, jet.d1) / dot(jet.d1, jet.d1);
      }
      EXPECT_LT(norm(evaluate(other, u).point - middle), 1e-9 * chord) << n << " " << i;
    }
  }
}

TEST(SmoothFit, OfAClothoidHasOneHillOfItsSlope) {
  std::mt19937_64 random(16);
  for (std::size_t n = 8; n <= 30; n += 2) {
    const std::vector<Vec2> points = clothoid_points(n, random);
    const auto smooth = shaped(points, Continuity::kG3), flat = shaped(points, Continuity::kG2);
    ASSERT_TRUE(smooth && flat && smooth->report.waviness && flat->report.waviness);
    EXPECT_TRUE(smooth->certificate.proved);
    EXPECT_LT(*smooth->certificate.gaps.slope, 1e-6);
    EXPECT_GE(*smooth->report.waviness, 1.0 - 1e-9);
    EXPECT_LT(*smooth->report.waviness, 1.25) << n;
    EXPECT_GT(*flat->report.waviness, 1.5) << n;
    EXPECT_EQ(smooth->report.chain.waviness_g2, flat->report.waviness);
  }
}

double slope_at(const Piece& piece, double t) { return curvature_rate(evaluate(piece, t)); }

/// Largest step of the slope of curvature at joints first..last of a contour, of the largest there.
double largest_step(const Contour& c, std::size_t first, std::size_t last) {
  double step = 0.0;
  for (std::size_t j = first; j <= last; ++j) {
    const Piece& before = c.pieces[(j + c.pieces.size() - 1) % c.pieces.size()];
    const Piece& after = c.pieces[j];
    const double left = slope_at(before, 1.0), right = slope_at(after, 0.0);
    const double scale = std::max({std::abs(slope_at(before, 0.0)), std::abs(left), std::abs(right),
                                   std::abs(slope_at(after, 1.0))});
    step = std::max(step, std::abs(right - left) / scale);
  }
  return step;
}

TEST(SmoothFit, GoesRoundAClosedContourAcrossItsSeam) {
  for (const std::size_t start : {0U, 2U, 5U}) {  // the seam at a vertex or anywhere
    PointSeries series;
    constexpr std::size_t kPoints = 20;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const double t =
          2.0 * std::numbers::pi * static_cast<double>(i + start) / static_cast<double>(kPoints);
      series.points.push_back({3.0 * std::cos(t), 2.0 * std::sin(t)});
    }
    FitJob job;
    job.closing = Closing::kClosed;
    job.continuity = Continuity::kG3;
    const auto made = fit(series, job);
    ASSERT_TRUE(made);
    EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
    EXPECT_TRUE(made->contour.closed);
    EXPECT_EQ(made->certificate.vertices, 4);
    EXPECT_EQ(made->certificate.slope_steps, 0);
    EXPECT_LT(largest_step(made->contour, 0, made->contour.pieces.size() - 1), 1e-6) << start;
    job.continuity = Continuity::kG2;
    const auto flat = fit(series, job);
    ASSERT_TRUE(flat);
    EXPECT_GT(largest_step(flat->contour, 0, flat->contour.pieces.size() - 1), 1e-2);
  }
}

/// An ellipse's slope of curvature has one hill between vertices. Steps that creep end before they
/// are there, and leave more.
TEST(SmoothFit, TheSlopesOfAnEllipseHaveOneHillEach) {
  PointSeries series;
  for (int i = 0; i < 12; ++i) {
    const double t = std::numbers::pi * i / 6.0 + 0.2;
    series.points.push_back({3.0 * std::cos(t), 2.0 * std::sin(t)});
  }
  FitJob job;
  job.closing = Closing::kClosed;
  const auto made = fit(series, job);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
  ASSERT_TRUE(made->report.waviness);
  EXPECT_NEAR(*made->report.waviness, 1.0, 1e-3);  // that of the ellipse
  EXPECT_EQ(made->certificate.vertices, 4);
}

TEST(SmoothFit, KeepsCornersAndIsSmoothOnBothSides) {
  // two clothoids that meet at a right angle, the second a mirror image of the first
  std::mt19937_64 random(18);
  const std::vector<Vec2> first = clothoid_points(9, random);
  PointSeries series;
  series.points = first;
  const Vec2 corner = first.back();
  for (std::size_t i = 1; i < first.size(); ++i) {
    const Vec2 d = first[first.size() - 1 - i] - corner;
    series.points.push_back(corner + Vec2{d.y, -d.x});
  }
  FitJob job;
  job.continuity = Continuity::kG3;
  const auto made = fit(series, job);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
  EXPECT_EQ(made->certificate.corners, 1);
  EXPECT_EQ(made->certificate.slope_steps, 0);
  const Contour& c = made->contour;
  ASSERT_EQ(c.pieces.size(), 16U);
  ASSERT_TRUE(c.joints[8].leaving.has_value());
  EXPECT_LT(largest_step(c, 1, 7), 1e-6);
  EXPECT_LT(largest_step(c, 9, 15), 1e-6);
}

TEST(SmoothFit, KeepsGivenHeadingsAndCurvatures) {
  std::mt19937_64 random(19);
  PointSeries series;
  series.points = clothoid_points(12, random);
  FitJob job;
  job.continuity = Continuity::kG3;
  const auto open = fit(series, job);
  ASSERT_TRUE(open);
  job.start_heading = open->contour.joints[0].element.theta + 1e-3;
  job.end_kappa = open->contour.joints[11].element.kappa * 1.01;
  PointConstraint wish;
  wish.index = 5;
  wish.theta = open->contour.joints[5].element.theta - 1e-4;
  wish.kappa = open->contour.joints[5].element.kappa * 1.002;
  job.constraints.push_back(wish);
  const auto made = fit(series, job);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
  EXPECT_EQ(made->certificate.slope_steps, 0);
  EXPECT_LT(largest_step(made->contour, 1, made->contour.pieces.size() - 1), 1e-6);
  const auto& joints = made->contour.joints;
  EXPECT_NEAR(joints.front().element.theta, *job.start_heading, 1e-12);
  EXPECT_NEAR(joints.back().element.kappa, *job.end_kappa, 1e-9);
  const auto at = std::find_if(joints.begin(), joints.end(),
                               [](const Joint& joint) { return joint.source == std::size_t{5}; });
  ASSERT_NE(at, joints.end());
  EXPECT_NEAR(at->element.theta, *wish.theta, 1e-12);
  EXPECT_NEAR(at->element.kappa, *wish.kappa, 1e-9);
}

TEST(SmoothFit, LineSpiralArcHasNoJerk) {
  // a line, a transition and an arc, as on rails: the slope is zero where the spiral meets the
  // others
  PointSeries series;
  for (int i = -6; i < 0; ++i) series.points.push_back({0.5 * i, 0.0});
  constexpr double kLength = 2.0, kEnd = 0.8;
  for (int i = 0; i <= 8; ++i) {
    const double s = kLength * i / 8.0;
    series.points.push_back(i == 0 ? Vec2{0.0, 0.0} : clothoid_step(0.0, 0.0, kEnd * i / 8.0, s));
  }
  const Vec2 join = series.points.back();
  const double theta = 0.5 * kEnd * kLength;
  for (int i = 1; i <= 6; ++i) {
    series.points.push_back(join + clothoid_step(theta, kEnd, kEnd, 0.25 * i));
  }
  FitJob job;
  job.continuity = Continuity::kG3;
  job.primitives = true;
  job.noise = 1e-4;
  const auto made = fit(series, job);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
  EXPECT_EQ(made->certificate.slope_steps, 0);
  const std::vector<Piece>& pieces = made->contour.pieces;
  bool line = false, arc = false;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    const bool before = std::holds_alternative<RationalBezier>(pieces[i]);
    const bool after = std::holds_alternative<RationalBezier>(pieces[i + 1]);
    if (before == after) continue;
    const Piece& other = pieces[before ? i + 1 : i];
    line = line || std::holds_alternative<LinePiece>(other);
    arc = arc || std::holds_alternative<ArcPiece>(other);
    const double slope = before ? slope_at(pieces[i], 1.0) : slope_at(pieces[i + 1], 0.0);
    EXPECT_LT(std::abs(slope), 1e-6 * kEnd / kLength) << i;
  }
  EXPECT_TRUE(line && arc);
  EXPECT_LT(largest_step(made->contour, 1, pieces.size() - 1), 1e-6);
}

/// How far a contour moves when a point of its own is put between two of its points, in chords.
double moved_by_own_point(const std::vector<Vec2>& points, Continuity continuity) {
  const auto before = shaped(points, continuity);
  const std::size_t at = points.size() / 2;
  std::vector<Vec2> more = points;
  more.insert(more.begin() + static_cast<std::ptrdiff_t>(at),
              evaluate(before->contour.pieces[at - 1], 0.5).point);
  const auto after = shaped(more, continuity);
  double most = 0.0;
  for (const Piece& piece : after->contour.pieces) {
    for (const double t : {0.25, 0.5, 0.75}) {
      const Vec2 p = evaluate(piece, t).point;
      double least = INFINITY;
      for (const Piece& other : before->contour.pieces) {
        double u = 0.5;
        for (int k = 0; k < 12; ++k) {
          const Jet jet = evaluate(other, u);
          u = std::clamp(u - dot(jet.point - p, jet.d1) / dot(jet.d1, jet.d1), 0.0, 1.0);
        }
        least = std::min(least, norm(evaluate(other, u).point - p));
      }
      most = std::max(most, least);
    }
  }
  return most / longest_chord(points);
}

TEST(SmoothFit, HardlyMovesWhenAPointOfItsOwnIsGiven) {
  std::mt19937_64 random(20);
  std::vector<double> smooth, flat;
  for (std::size_t n = 8; n <= 36; ++n) {
    const std::vector<Vec2> points = clothoid_points(n, random);
    smooth.push_back(moved_by_own_point(points, Continuity::kG3));
    flat.push_back(moved_by_own_point(points, Continuity::kG2));
  }
  std::sort(smooth.begin(), smooth.end());
  std::sort(flat.begin(), flat.end());
  EXPECT_LT(smooth[smooth.size() / 2], 1e-6);
  EXPECT_LT(smooth.back(), 1e-5);
  EXPECT_LT(smooth.back(), flat.back());
}

/// Headings and curvatures at the points of a loop, by their angles about its middle.
std::map<int, Element> by_angle(const Contour& contour) {
  std::map<int, Element> out;
  for (const Joint& joint : contour.joints) {
    if (!joint.source) continue;
    const Vec2 p = joint.element.point;
    out[static_cast<int>(std::lround(1e6 * std::atan2(p.y, p.x)))] = joint.element;
  }
  return out;
}

TEST(SmoothFit, ALoopIsTheSameWhereverItBeginsAndWhicheverWayItGoes) {
  constexpr int kPoints = 40;
  const auto loop = [](int from, int step, double off) {
    std::vector<Vec2> out;
    for (int k = 0; k <= kPoints; ++k) {
      const int i = ((from + step * k) % kPoints + kPoints) % kPoints;
      const double t = 2.0 * std::numbers::pi * (i + off) / kPoints;
      const double r = 1.0 + 0.1 * std::cos(3.0 * t + 0.4);
      out.push_back({5.0 * r * std::cos(t), 3.0 * r * std::sin(t)});
    }
    return out;
  };
  for (const double off : {0.0, 0.3}) {
    const auto first = shaped(loop(0, 1, off), Continuity::kG3);
    ASSERT_TRUE(first);
    ASSERT_EQ(first->certificate.slope_steps, 0);
    const auto is = by_angle(first->contour);
    for (const auto& [from, step] : std::vector<std::pair<int, int>>{{7, 1}, {23, 1}, {0, -1}}) {
      const auto other = shaped(loop(from, step, off), Continuity::kG3);
      ASSERT_TRUE(other);
      for (const auto& [angle, e] : by_angle(other->contour)) {
        const Element& there = is.at(angle);
        const double turn =
            step > 0 ? e.theta - there.theta : e.theta - there.theta - std::numbers::pi;
        EXPECT_NEAR(std::remainder(turn, 2.0 * std::numbers::pi), 0.0, 1e-8) << from << " " << step;
        EXPECT_NEAR(step * e.kappa, there.kappa, 1e-8) << from << " " << step;
      }
    }
  }
}

TEST(SmoothFit, WithinTolerancesAddsNoVertexAndNoInflection) {
  std::mt19937_64 random(17);
  constexpr double kMeasured = 0.1;
  for (int k = 0; k < 6; ++k) {
    const std::vector<Vec2> points = measured_course(150, kMeasured, random);
    const auto smooth = shaped(points, Continuity::kG3, 4.0 * kMeasured);
    const auto flat = shaped(points, Continuity::kG2, 4.0 * kMeasured);
    ASSERT_TRUE(smooth && flat);
    EXPECT_TRUE(smooth->certificate.proved) << smooth->certificate.reason;
    EXPECT_EQ(smooth->certificate.vertices, flat->certificate.vertices);
    EXPECT_EQ(smooth->certificate.inflections, flat->certificate.inflections);
    ASSERT_TRUE(smooth->certificate.gaps.slope.has_value());
    EXPECT_EQ(smooth->certificate.slope_steps, 0);
    EXPECT_LE(smooth->certificate.largest_move, 4.0 * kMeasured);
  }
}

TEST(Waviness, IsTrueOrNotToldWhereAPieceRunsOutSharply) {
  // the speed falls to a fiftieth towards the end, where the slope of curvature returns to 0 from
  // 5e-4: one hill, by 50 digits (8.6e-11 is left at the end), whichever way it runs. Doubles leave
  // 4e-6 there, which would be another hundredth of a hill
  const std::vector<Vec2> offsets = {{0, 0},
                                     {-0.0562082846788177, -0.015111647055570814},
                                     {-0.09490103707500258, -0.035155580768179415},
                                     {-0.10811918247104478, -0.04202514437729919},
                                     {-0.10835755406633174, -0.04214903185902469}};
  const std::vector<double> weights = {1, 1.2061011594499873, 1.3125302360148536,
                                       1.2131471515517098, 1};
  for (const bool back : {false, true}) {
    RationalBezier piece;
    piece.degree = 4;
    for (std::size_t j = 0; j < 5; ++j) {
      piece.offset[j] = offsets[back ? 4 - j : j];
      piece.weight[j] = weights[back ? 4 - j : j];
    }
    Contour contour;
    contour.pieces = {piece};
    contour.joints = {Joint{{start_point(piece), 0.0, 0.0}, 0},
                      Joint{{end_point(piece), 0.0, 0.0}, 1}};
    contour.runs.push_back({0, 0, 1});
    Watch nobody;
    const auto hills = pipeline_detail::waviness(contour, nobody);
    EXPECT_NEAR(hills.value_or(1.0), 1.0, 1e-3) << back;
  }
}

}  // namespace
}  // namespace obvid
