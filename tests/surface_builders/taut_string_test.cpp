// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/taut_string.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace obvid {
namespace {

struct Known {
  Tube tube;
  std::size_t fewest = 0;
};

/// Random tubes, the fewest changes found by trying every pattern of signs with linear programs.
std::vector<Known> known_tubes() {
  std::ifstream in(std::string(OBVID_TEST_DATA) + "/across/taut_string.tsv");
  std::vector<Known> all;
  for (std::string line; std::getline(in, line);) {
    if (line.front() == '#') continue;
    std::istringstream text(line);
    std::size_t nodes = 0;
    text >> nodes;
    Known known;
    for (std::vector<double>* list : {&known.tube.at, &known.tube.low, &known.tube.high}) {
      list->resize(nodes);
      for (double& x : *list) text >> x;
    }
    text >> known.fewest;
    all.push_back(known);
  }
  return all;
}

TEST(TautString, ChangesAsSeldomAsAnyHeightsInTheTube) {
  const std::vector<Known> all = known_tubes();
  ASSERT_EQ(all.size(), 240u);
  std::size_t certified = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& [tube, fewest] = all[k];
    EXPECT_EQ(changes_of(taut_string(tube)), fewest) << k;
    EXPECT_LE(changes_certified(tube), fewest) << k;
    certified += changes_certified(tube) == fewest ? 1 : 0;
  }
  EXPECT_GE(certified, 230u);  // a bound that is seldom met would say little
}

/// Through its contacts the string stays within the bounds and bends where it says.
TEST(TautString, BendsAtTheBoundsAndStaysBetweenThem) {
  for (const auto& [tube, fewest] : known_tubes()) {
    const std::vector<StringContact> contacts = taut_string(tube);
    const auto height = [&](const StringContact& c) {
      return c.bend > 0 ? tube.high[c.node] : tube.low[c.node];
    };
    for (std::size_t k = 0; k + 1 < contacts.size(); ++k) {
      const auto &a = contacts[k], &b = contacts[k + 1];
      ASSERT_LT(a.node, b.node);
      const double slope = (height(b) - height(a)) / (tube.at[b.node] - tube.at[a.node]);
      for (std::size_t i = a.node; i <= b.node; ++i) {
        const double y = height(a) + slope * (tube.at[i] - tube.at[a.node]);
        EXPECT_LE(y, tube.high[i] + 1e-9);
        EXPECT_GE(y, tube.low[i] - 1e-9);
      }
      if (k + 2 == contacts.size()) continue;
      const auto& c = contacts[k + 2];
      const double next = (height(c) - height(b)) / (tube.at[c.node] - tube.at[b.node]);
      EXPECT_GT(b.bend * (next - slope), 0.0);
    }
  }
}

/// The number is one of shapes: places and heights in other units, turned upside down, read
/// backwards, sheared by a straight line.
TEST(TautString, IsThatOfTheShape) {
  for (const auto& [tube, fewest] : known_tubes()) {
    for (const double scale : {1e-9, 1e9}) {
      Tube other, mirror;
      const std::size_t n = tube.at.size();
      for (std::size_t i = 0; i < n; ++i) {
        const double shear = 0.25 * tube.at[i];
        other.at.push_back(scale * tube.at[i]);
        other.low.push_back(scale * (tube.low[i] + shear));
        other.high.push_back(scale * (tube.high[i] + shear));
        const std::size_t j = n - 1 - i;
        mirror.at.push_back(-scale * tube.at[j]);
        mirror.low.push_back(-scale * tube.high[j]);
        mirror.high.push_back(-scale * tube.low[j]);
      }
      EXPECT_EQ(changes_of(taut_string(other)), fewest);
      EXPECT_EQ(changes_of(taut_string(mirror)), fewest);
      EXPECT_LE(changes_certified(other), fewest);
      EXPECT_LE(changes_certified(mirror), fewest);
    }
  }
}

TEST(TautString, ZigzagsOfWhichEachIsForcedOrNone) {
  Tube tube;
  for (int i = 0; i < 200; ++i) {
    tube.at.push_back(i);
    tube.low.push_back((i % 2) - 0.4);
    tube.high.push_back((i % 2) + 0.4);
  }
  // 198 inner nodes bend in turn
  EXPECT_EQ(changes_of(taut_string(tube)), 197u);
  EXPECT_EQ(changes_certified(tube), 197u);
  for (int i = 0; i < 200; ++i) {
    tube.low[static_cast<std::size_t>(i)] = (i % 2) - 0.6;
    tube.high[static_cast<std::size_t>(i)] = (i % 2) + 0.6;
  }
  EXPECT_TRUE(taut_string(tube).empty());
  EXPECT_EQ(changes_certified(tube), 0u);
  EXPECT_TRUE(taut_string({{0.0, 1.0}, {0.0, 0.0}, {0.0, 0.0}}).empty());
  EXPECT_EQ(changes_certified({{}, {}, {}}), 0u);
}

}  // namespace
}  // namespace obvid
