// SPDX-License-Identifier: Apache-2.0
// Tours against all orders of few stops, and what they have to keep.
#include "short_tour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "obvid/core/run_context.h"

namespace obvid::cutting {
namespace {

struct Case {
  std::vector<Stop> stops;
  std::vector<Turn> tour;  ///< by number, which keeps what comes first
};

/// Places in a square; every third stop has two ends, half of these may be turned; of stops that
/// `follow` others each waits for one before it.
Case random_case(std::mt19937& random, std::size_t count, bool follow) {
  std::uniform_real_distribution<double> place(0.0, 100.0);
  Case out;
  for (std::size_t k = 0; k < count; ++k) {
    Stop stop;
    stop.begin = {place(random), place(random)};
    stop.end = k % 3 == 0 ? Vec2{place(random), place(random)} : stop.begin;
    stop.may_turn = k % 6 == 0;
    if (follow && k > 1 && k % 2 == 0) stop.first.push_back(random() % k);
    out.stops.push_back(stop);
    out.tour.push_back({k, false});
  }
  return out;
}

bool keeps_order(const std::vector<Stop>& stops, const std::vector<Turn>& tour) {
  std::vector<std::size_t> at(stops.size());
  for (std::size_t i = 0; i < tour.size(); ++i) at[tour[i].stop] = i;
  for (std::size_t k = 0; k < stops.size(); ++k) {
    for (const std::size_t before : stops[k].first) {
      if (at[before] > at[k]) return false;
    }
  }
  return true;
}

/// Of all orders, with the best of both directions of each stop that has them.
double shortest(const std::vector<Stop>& stops) {
  std::vector<Turn> tour(stops.size());
  for (std::size_t k = 0; k < stops.size(); ++k) tour[k].stop = k;
  double least = HUGE_VAL;
  do {
    if (!keeps_order(stops, tour)) continue;
    double straight = 0.0, turned = HUGE_VAL;  // ways to where a stop is left, either way round
    Vec2 from_straight{}, from_turned{};
    for (const Turn& turn : tour) {
      const Stop& s = stops[turn.stop];
      const auto way_to = [&](Vec2 p) {
        return std::min(straight + norm(p - from_straight), turned + norm(p - from_turned));
      };
      const double one = way_to(s.begin), other = s.may_turn ? way_to(s.end) : HUGE_VAL;
      straight = one, turned = other;
      from_straight = s.end, from_turned = s.begin;
    }
    least = std::min({least, straight, turned});
  } while (std::next_permutation(tour.begin(), tour.end(),
                                 [](const Turn& a, const Turn& b) { return a.stop < b.stop; }));
  return least;
}

std::vector<Turn> shorter(const Case& made) {
  const RunContext run;
  Watch watch(run);
  return shorter_tour(made.stops, made.tour, watch);
}

TEST(ShortTour, OfSevenStopsIsTheShortestOfAll) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const Case made = random_case(random, 7, trial % 2 == 0);
    const auto tour = shorter(made);
    EXPECT_TRUE(keeps_order(made.stops, tour));
    EXPECT_NEAR(way_between(made.stops, tour), shortest(made.stops), 1e-9) << trial;
  }
}

TEST(ShortTour, VisitsEachStopOnceInAnAllowedOrderAndOnlyTurnsWhatMayBe) {
  std::mt19937 random(3);
  for (const std::size_t count : {0U, 1U, 2U, 3U, 60U, 200U}) {
    const Case made = random_case(random, count, true);
    const auto tour = shorter(made);
    ASSERT_EQ(tour.size(), count);
    EXPECT_TRUE(keeps_order(made.stops, tour));
    EXPECT_LE(way_between(made.stops, tour), way_between(made.stops, made.tour));
    std::vector<bool> seen(count, false);
    for (const Turn& turn : tour) {
      EXPECT_FALSE(seen[turn.stop]);
      seen[turn.stop] = true;
      EXPECT_TRUE(!turn.turned || made.stops[turn.stop].may_turn);
    }
  }
}

TEST(ShortTour, OfAGridIsHardlyLongerThanItsRows) {
  // to and fro along the rows of n x n places one apart the way is n^2 - 1; no way is shorter
  for (const std::size_t n : {6U, 12U}) {
    Case made;
    std::vector<std::size_t> order(n * n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(5));
    for (const std::size_t k : order) {
      const Vec2 p{static_cast<double>(k % n), static_cast<double>(k / n)};
      made.tour.push_back({made.stops.size(), false});
      made.stops.push_back({p, p, false, {}});
    }
    const double least = static_cast<double>(n * n - 1);
    EXPECT_LE(way_between(made.stops, shorter(made)), 1.03 * least);
  }
}

TEST(ShortTour, IsTheSameInEverySize) {
  std::mt19937 random(11);
  const Case made = random_case(random, 40, true);
  const auto tour = shorter(made);
  for (const double factor : {0x1p-30, 0x1p30}) {
    Case other = made;
    for (Stop& stop : other.stops) stop.begin = factor * stop.begin, stop.end = factor * stop.end;
    const auto same = shorter(other);
    for (std::size_t k = 0; k < tour.size(); ++k) {
      EXPECT_EQ(same[k].stop, tour[k].stop);
      EXPECT_EQ(same[k].turned, tour[k].turned);
    }
  }
}

}  // namespace
}  // namespace obvid::cutting
