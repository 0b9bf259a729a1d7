// SPDX-License-Identifier: Apache-2.0
// Blocks of programs around squares and circles: ramps, tabs, feeds, leads and times by their
// closed forms.
#include "cut_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "cut_time.h"

namespace obvid::cutting {
namespace {

using Kind = CutBlock::Kind;

constexpr double kStraight = std::numbers::pi;
constexpr double kRound = 10.0;
constexpr double kBlockRounding = 1e-11;  // of lengths: rounding

Track track_of(ArcPath axis, CutSide side) {
  Track track;
  track.name = "it";
  track.axis = std::move(axis);
  track.side = side;
  return track;
}

/// Counterclockwise, begun in the middle of a side.
ArcPath begun_square() {
  const Vec2 at[] = {{20, 0}, {40, 0}, {40, 40}, {0, 40}, {0, 0}, {20, 0}};
  ArcPath out;
  out.closed = true;
  for (std::size_t i = 0; i < 5; ++i) out.pieces.emplace_back(LinePiece{at[i], at[i + 1]});
  return out;
}

/// Two half circles around the origin, counterclockwise.
ArcPath circle_of(double radius) {
  const Vec2 right{radius, 0}, left{-radius, 0};
  ArcPath out;
  out.closed = true;
  out.pieces.emplace_back(ArcPiece{right, left, 0.5 * kStraight, 1.0 / radius, kStraight * radius});
  out.pieces.emplace_back(ArcPiece{left, right, 1.5 * kStraight, 1.0 / radius, kStraight * radius});
  return out;
}

ArcPath open_line(double length) {
  ArcPath out;
  out.pieces.emplace_back(LinePiece{{0, 0}, {length, 0}});
  return out;
}

BlockRules milling(double depth, double pass_depth) {
  BlockRules rules;
  rules.depth = depth;
  rules.pass_depth = pass_depth;
  rules.tool_diameter = 3.0;
  rules.safe_z = 5.0;
  rules.clear_z = 1.0;
  rules.feed = 600.0;
  rules.plunge_feed = 120.0;
  return rules;
}

CutBlocks blocks_around(const ArcPath& axis, const BlockRules& rules,
                        CutSide side = CutSide::kOutside) {
  const Edges none;
  return blocks_of({track_of(axis, side)}, {Visit{0, axis, {}, {}, false}}, rules,
                   Leads(none, 0.0, 0.5 * rules.tool_diameter, true));
}

/// A block that cuts, with the height where it begins.
struct CutFrom {
  CutBlock block;
  double from_z = 0.0;

  [[nodiscard]] double length() const { return length_of(block.piece); }
  [[nodiscard]] double fall() const { return (from_z - block.z) / length(); }
};

std::vector<CutFrom> cuts_of(const CutBlocks& made) {
  std::vector<CutFrom> out;
  double z = 0.0;
  for (const CutBlock& block : made.blocks) {
    if (block.kind == Kind::kCut) out.push_back({block, z});
    if (block.kind != Kind::kRapidAcross) z = block.z;
  }
  return out;
}

double length_of_cuts(const std::vector<CutFrom>& cuts) {
  double sum = 0.0;
  for (const CutFrom& cut : cuts) sum += cut.length();
  return sum;
}

// A way of length L that falls by d at the angle a has d = L tan a; a pass that is level goes once
// around. Where a ramp is longer than the path, a turn of it cuts less than a pass: it goes on, and
// one level turn is left, at the bottom.
TEST(RampsAroundAClosedPath, FallByTheirAngleAndAreFollowedByLevelTurnsWhereTheyAreSteep) {
  for (const ArcPath& axis : {begun_square(), circle_of(kRound)}) {
    const double perimeter = length_of(axis);
    for (const double degrees : {0.5, 3.0, 20.0}) {
      SCOPED_TRACE(degrees);
      BlockRules rules = milling(6.0, 2.0);
      rules.fall = std::tan(degrees * kStraight / 180.0);
      const CutBlocks made = blocks_around(axis, rules);
      EXPECT_EQ(made.levels, 3);
      const std::vector<CutFrom> cuts = cuts_of(made);
      double level = 0.0, deepest = 0.0;
      for (const CutFrom& cut : cuts) {
        deepest = std::min(deepest, cut.block.z);
        if (cut.from_z == cut.block.z) {
          level += cut.length();
          continue;
        }
        EXPECT_NEAR(std::atan(cut.fall()) * 180.0 / kStraight, degrees, 1e-7);
      }
      EXPECT_EQ(deepest, -6.0);
      const double ramps = 6.0 / std::tan(degrees * kStraight / 180.0);
      const double turns = ramps / 3.0 >= perimeter ? 1.0 : 3.0;
      EXPECT_NEAR(level, turns * perimeter, kBlockRounding * perimeter);
      EXPECT_NEAR(length_of_cuts(cuts), ramps + turns * perimeter,
                  kBlockRounding * (ramps + turns * perimeter));
      // each begins where the last one ended
      for (std::size_t i = 1; i < cuts.size(); ++i) {
        EXPECT_NEAR(norm(start_point(cuts[i].block.piece) - end_point(cuts[i - 1].block.piece)),
                    0.0, kBlockRounding * perimeter);
      }
    }
  }
}

// The last of three passes is too short for a turn: before it there is a level one, so that no
// place has more than a pass cut at once.
TEST(RampsAroundAClosedPath, BeforeAShortPassThereIsALevelTurn) {
  BlockRules rules = milling(5.0, 2.0);
  rules.fall = std::tan(0.5 * kStraight / 180.0);
  const ArcPath axis = begun_square();
  double level = 0.0;
  for (const CutFrom& cut : cuts_of(blocks_around(axis, rules))) {
    if (cut.from_z == cut.block.z) level += cut.length();
  }
  EXPECT_NEAR(level, 2.0 * length_of(axis), kBlockRounding * length_of(axis));
}

// To and fro over a length L at an angle a: ceil(d / (L tan a)) legs down, the last one shorter,
// and one that is level.
TEST(RampsAlongAnOpenPath, GoToAndFroAndEndWithALevelLeg) {
  constexpr double kLength = 30.0;
  BlockRules rules = milling(4.0, 4.0);
  rules.fall = 0.05;
  const std::vector<CutFrom> cuts = cuts_of(blocks_around(open_line(kLength), rules, CutSide::kOn));
  // 30 by 0.05 are 1.5: two whole legs, 20 of a third one, then level to its end and back
  ASSERT_EQ(cuts.size(), 5U);
  const double ends[] = {-1.5, -3.0, -4.0, -4.0, -4.0};
  const double lengths[] = {30.0, 30.0, 20.0, 10.0, 30.0};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(cuts[i].block.z, ends[i], 1e-12);
    EXPECT_NEAR(cuts[i].length(), lengths[i], kBlockRounding * kLength);
  }
}

TEST(PassesOfAMill, AreAsFewAsTheirDepthAllows) {
  EXPECT_EQ(levels_of(milling(6.0, 2.0)), 3.0);
  EXPECT_EQ(levels_of(milling(6.01, 2.0)), 4.0);
  EXPECT_EQ(levels_of(milling(1.0, 2.0)), 1.0);
  EXPECT_EQ(levels_of(milling(2.1, 0.3)), 7.0);  // 7.000000000000001 as doubles
  const CutBlocks made = blocks_around(begun_square(), milling(5.0, 2.0));
  std::vector<double> levels;
  for (const CutFrom& cut : cuts_of(made)) {
    if (levels.empty() || levels.back() != cut.block.z) levels.push_back(cut.block.z);
  }
  EXPECT_EQ(levels, (std::vector<double>{-2.0, -4.0, -5.0}));
}

// A body on a circle of radius r has the acceleration v^2 / r across its way.
TEST(FeedOfACurve, HasTheAccelerationAcrossTheWayThatIsAllowed) {
  BlockRules rules = milling(1.0, 1.0);
  rules.across = 200.0;
  for (const double radius : {0.01, 0.1, 0.4}) {
    for (const double sign : {1.0, -1.0}) {
      const double speed = feed_for(sign / radius, rules) / 60.0;
      EXPECT_NEAR(speed * speed / radius, 200.0, 1e-9);
    }
  }
  EXPECT_EQ(feed_for(1.0 / 2.0, rules), rules.feed);  // 10/s are 50/s^2 there
  EXPECT_EQ(feed_for(0.0, rules), rules.feed);
  rules.across = 0.0;
  EXPECT_EQ(feed_for(1000.0, rules), rules.feed);
}

// On a line the gap in the way of the axis is the bridge and the tool's diameter. On a circle of
// radius r it is the arc over that chord, around a right angle the two legs under it.
TEST(Tabs, LeaveBridgesOfTheirWidth) {
  BlockRules rules = milling(4.0, 2.0);
  rules.tabs = {0, 5.0, 1.5};
  const double gap = 5.0 + rules.tool_diameter, radius = 30.0;
  struct {
    ArcPath axis;
    int count;
    double expected;
  } const paths[] = {
      {begun_square(), 2, gap},                        // middles of sides
      {begun_square(), 4, std::numbers::sqrt2 * gap},  // corners, a quarter from any line
      {circle_of(radius), 4, 2.0 * radius * std::asin(0.5 * gap / radius)}};
  for (const auto& [axis, count, expected] : paths) {
    rules.tabs.count = count;
    const CutBlocks made = blocks_around(axis, rules);
    EXPECT_TRUE(made.without_tabs.empty());
    double over = 0.0, at_bottom = 0.0;
    for (const CutFrom& cut : cuts_of(made)) {
      if (cut.block.over_tab) {
        EXPECT_NEAR(cut.block.z, -4.0 + 1.5, 1e-12);
        over += cut.length();
      } else if (cut.block.z == -4.0) {
        at_bottom += cut.length();
      }
    }
    // gaps that are no lines are widened by steps of 1 %
    EXPECT_GE(over, count * expected * (1.0 - 1e-9));
    EXPECT_LE(over, count * expected * 1.0100001);
    EXPECT_NEAR(over + at_bottom, length_of(axis), kBlockRounding * length_of(axis));
  }
  rules.tabs.count = 4;
  // a chord of 8 is longer than any on a circle of radius 3
  const CutBlocks small = blocks_around(circle_of(3.0), rules);
  EXPECT_EQ(small.without_tabs, (std::vector<std::size_t>{0}));
}

// Inside of a square the lead is a quarter of a circle that ends on the way, along it.
TEST(Leads, AreQuarterCirclesTangentToTheWay) {
  constexpr double kLead = 2.0, kTool = 1.5;
  for (const bool waste_left : {true, false}) {
    Tracks tracks;
    // what stays lies to the right of a way that runs as waste_left says; the axis is around it
    ArcPath axis = circle_of(kRound);
    if (!waste_left) axis = reversed(axis);
    const double inside = kRound + kTool;  // counterclockwise, its left is inside
    ArcPath edge = circle_of(inside);
    tracks.all.push_back(track_of(axis, CutSide::kInside));
    tracks.all.back().edge = edge;
    tracks.edges.add(edge, 0);
    tracks.edges.finish();
    Watch watch{RunContext{}};
    const Leads leads(tracks.edges, kLead, kTool, waste_left);
    const std::vector<Visit> visits = ordered(tracks, std::nullopt, leads, watch);
    ASSERT_EQ(visits.size(), 1U);
    const Visit& visit = visits.front();
    ASSERT_TRUE(visit.lead_in && visit.lead_out);
    const Vec2 start = start_point(visit.path.pieces.front());
    const double along = heading_at_start(visit.path.pieces.front());
    for (const ArcPiece& lead : {*visit.lead_in, *visit.lead_out}) {
      EXPECT_NEAR(lead.length, 0.5 * kStraight * kLead, kBlockRounding);
      EXPECT_NEAR(std::abs(lead.kappa), 1.0 / kLead, kBlockRounding);
      EXPECT_NEAR(norm(lead.end - lead.start), std::numbers::sqrt2 * kLead, kBlockRounding);
    }
    EXPECT_NEAR(norm(visit.lead_in->end - start), 0.0, kBlockRounding);
    EXPECT_NEAR(norm(visit.lead_out->start - start), 0.0, kBlockRounding);
    EXPECT_NEAR(std::remainder(heading_at_end(*visit.lead_in) - along, 2.0 * kStraight), 0.0,
                kBlockRounding);
    EXPECT_NEAR(std::remainder(heading_at_start(*visit.lead_out) - along, 2.0 * kStraight), 0.0,
                kBlockRounding);
    // the centre lies inside, 8 from the middle; the far ends 2 from it, along the way
    const double far = std::hypot(kRound - kLead, kLead);
    EXPECT_NEAR(norm(visit.lead_in->start), far, 1e-9);
    EXPECT_NEAR(norm(visit.lead_out->end), far, 1e-9);
  }
}

CutBlock cut_along(Piece piece, double feed) {
  CutBlock out;
  out.kind = Kind::kCut;
  out.piece = std::move(piece);
  out.feed = feed;
  return out;
}

// From rest to rest over a length s with a speed v and an acceleration a: s / v + v / a where the
// speed is reached (s >= v^2 / a), else 2 sqrt(s / a).
TEST(TimeOfBlocks, IsThatOfATrapezoidOfSpeeds) {
  const exchange::MotionRules rules{3000.0, 500.0, 0.0};
  constexpr double kSpeed = 20.0;  // 1200 a minute
  for (const double length : {0.1, 0.5, 0.8, 1.0, 40.0}) {
    const double expected = length >= kSpeed * kSpeed / 500.0 ? length / kSpeed + kSpeed / 500.0
                                                              : 2.0 * std::sqrt(length / 500.0);
    const std::vector<CutBlock> blocks{cut_along(LinePiece{{0, 0}, {length, 0}}, 60.0 * kSpeed)};
    EXPECT_NEAR(seconds_of(blocks, rules, 0.0), expected, 1e-12);
  }
}

TEST(TimeOfBlocks, GoesOnWhereTheWayDoesAndStopsAtCornersThatMayNotBeCut) {
  constexpr double kSpeed = 20.0, kFeed = 60.0 * kSpeed, kLength = 10.0;
  const double alone = kLength / kSpeed + kSpeed / 500.0;
  const exchange::MotionRules rules{3000.0, 500.0, 0.0};
  const auto seconds = [&](double turn, double corner) {
    const Vec2 middle{kLength, 0};
    const Vec2 end = middle + kLength * Vec2{std::cos(turn), std::sin(turn)};
    exchange::MotionRules cutting = rules;
    cutting.corner = corner;
    return seconds_of(
        {cut_along(LinePiece{{0, 0}, middle}, kFeed), cut_along(LinePiece{middle, end}, kFeed)},
        cutting, 0.0);
  };
  EXPECT_NEAR(seconds(0.0, 0.0), 2.0 * kLength / kSpeed + kSpeed / 500.0, 1e-12);
  EXPECT_NEAR(seconds(0.5 * kStraight, 0.0), 2.0 * alone, 1e-12);
  // a circle tangent to both sides of a right angle stays r (sqrt 2 - 1) away from it, and is run
  // through at sqrt(a r); each side takes 20/500 s to get up to speed, and (20 - v)/500 s down to v
  constexpr double kCorner = 0.1;
  const double v = std::sqrt(500.0 * kCorner / (std::numbers::sqrt2 - 1.0));
  ASSERT_LT(v, kSpeed);
  const double up = kSpeed / 500.0, down = (kSpeed - v) / 500.0;
  const double slow = kSpeed * kSpeed / 1000.0 + (kSpeed * kSpeed - v * v) / 1000.0;
  EXPECT_NEAR(seconds(0.5 * kStraight, kCorner), 2.0 * (up + down + (kLength - slow) / kSpeed),
              1e-12);
}

TEST(TimeOfBlocks, HasRapidMovesAtTheirSpeedAndWaitsForTheBeam) {
  const exchange::MotionRules rules{3000.0, 500.0, 0.0};  // 50/s: reached after 2.5
  CutBlock across, level, dwell;
  across.kind = Kind::kRapidAcross;
  across.to = {30, 40};
  level.kind = Kind::kRapidLevel;
  level.z = 2.0;
  dwell.kind = Kind::kDwell;
  EXPECT_NEAR(seconds_of({across}, rules, 0.0), 50.0 / 50.0 + 50.0 / 500.0, 1e-12);
  EXPECT_NEAR(seconds_of({level}, rules, 0.0), 2.0 * std::sqrt(2.0 / 500.0), 1e-12);
  EXPECT_NEAR(seconds_of({dwell, dwell}, rules, 0.7), 1.4, 1e-12);
}

}  // namespace
}  // namespace obvid::cutting
