// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "obvid/picture/internal/alignment_svg.h"
#include "picture_contours.h"

namespace obvid {
namespace {

using picture_test::arc_chain;
using picture_test::paths_of;

/// Places of a path of moves and lines, px.
std::vector<Vec2> places_of(std::string path) {
  for (char& c : path) {
    if (c == 'M' || c == 'L') c = ' ';
  }
  std::istringstream in(path);
  std::vector<Vec2> out;
  for (Vec2 p; in >> p.x >> p.y;) out.push_back(p);
  return out;
}

/// Place of the text, px.
Vec2 place_of(const std::string& svg, const std::string& text) {
  const auto end = svg.find(">" + text + "</text>");
  EXPECT_NE(end, std::string::npos) << text;
  const auto start = svg.rfind("<text ", end);
  const auto number = [&](const std::string& name) {
    return std::strtod(svg.c_str() + svg.find(name + "=\"", start) + name.size() + 2, nullptr);
  };
  return {number("x"), number("y")};
}

/// An arc of the given curvature between two lines.
std::string picture_of(double kappa, const std::string& label) {
  AlignmentDiagram diagram;
  diagram.parts = {{0.0, 100.0, "", {0.0, 0.0}},
                   {100.0, 100.0, label, {kappa, kappa}},
                   {200.0, 100.0, "", {0.0, 0.0}}};
  return alignment_svg(arc_chain({kappa}, 0.5), {}, diagram);
}

/// The letters of a label, 10 px above its base line, lie beside the level of its element.
void expect_readable(double kappa, const std::string& label) {
  const std::string svg = picture_of(kappa, label);
  const auto graphs = paths_of(svg, "graph up");
  ASSERT_EQ(graphs.size(), 1u);
  const Vec2 at = place_of(svg, label);
  double level = 0.0;
  const std::vector<Vec2> places = places_of(graphs.front());
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    if (places[k].x < at.x && at.x < places[k + 1].x) level = places[k].y;
  }
  ASSERT_GT(level, 0.0);
  EXPECT_TRUE(level < at.y - 12.0 || level > at.y + 2.0) << level << " " << at.y;
}

TEST(AlignmentLabels, OfAnArcThatBendsRightAreNotStruckThroughByItsCurvature) {
  // scales whose lowest line is the curvature of the arc, or nearly
  for (const double radius : {100.0, 180.0, 200.0, 250.0, 500.0}) {
    expect_readable(-1.0 / radius, "R -100");
  }
}

TEST(AlignmentLabels, OfAnArcThatBendsLeftAreNotEither) {
  for (const double radius : {100.0, 180.0, 200.0, 250.0, 500.0}) {
    expect_readable(1.0 / radius, "R 100");
  }
}

}  // namespace
}  // namespace obvid
