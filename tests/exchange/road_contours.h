// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "../common/programs.h"
#include "drawing_checks.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/exchange/drawing.h"
#include "obvid/io/contour_json.h"

namespace obvid {

inline Contour stored(const std::string& name) {
  const auto path = std::filesystem::path(OBVID_TEST_DATA) / "contours" / name;
  auto contour = contour_from_json(text_of_file(path), name);
  EXPECT_TRUE(contour.has_value()) << name;
  return contour ? contour->contour : Contour{};
}

/// One after the other: each starts where and as the one before ends.
class Road {
 public:
  explicit Road(Element start) : here_(start) { contour_.units = "m"; }

  Road& add(double kappa0, double kappa1, double length) {
    const Vec2 end = here_.point + clothoid_step(here_.theta, kappa0, kappa1, length);
    if (kappa0 == 0.0 && kappa1 == 0.0) {
      contour_.pieces.emplace_back(LinePiece{here_.point, end});
    } else if (kappa0 == kappa1) {
      contour_.pieces.emplace_back(ArcPiece{here_.point, end, here_.theta, kappa0, length});
    } else {
      contour_.pieces.emplace_back(
          ClothoidPiece{here_.point, end, here_.theta, kappa0, kappa1, length});
    }
    Joint joint;
    joint.element = {here_.point, here_.theta - turned_, kappa0};
    if (turned_ != 0.0) {
      joint.element.kappa = here_.kappa;
      joint.leaving = Element{here_.point, here_.theta, kappa0};
    }
    turned_ = 0.0;
    contour_.joints.push_back(joint);
    here_ = {end, here_.theta + 0.5 * (kappa0 + kappa1) * length, kappa1};
    return *this;
  }
  Road& turn(double angle) {
    here_.theta += angle;
    turned_ = angle;
    return *this;
  }
  [[nodiscard]] Contour take() {
    Joint joint;
    joint.element = here_;
    contour_.joints.push_back(joint);
    return contour_;
  }

 private:
  Contour contour_;
  Element here_;
  double turned_ = 0.0;  // rad, since the last piece
};

/// Everything that a road has: a line, both senses, an S, a spiral of several turns, a long arc.
inline Contour every_kind() {
  return Road({{2500000.0, 5600000.0}, 0.3, 0.0})
      .add(0.0, 0.0, 120.0)
      .add(0.0, 0.01, 50.0)
      .add(0.01, 0.01, 80.0)
      .add(0.01, -0.02, 60.0)
      .add(-0.02, -0.02, 200.0)
      .add(-0.02, -0.2, 90.0)
      .add(1e-6, 1e-6, 30.0)
      .take();
}

inline Element at(const Piece& piece, double t) {
  const Jet jet = evaluate(piece, t);
  return {jet.point, heading(jet.d1), curvature(jet)};
}

/// Where a length lies on a sequence of pieces that are parametrised by arc length.
inline Element at_length(const std::vector<Piece>& pieces, double s) {
  for (std::size_t i = 0;; ++i) {
    const double length = arc_length(pieces[i], 0.0);
    if (s <= length || i + 1 == pieces.size()) return at(pieces[i], std::min(1.0, s / length));
    s -= length;
  }
}

/// The same points, headings and curvatures at the same lengths. `factor`: what one unit of the
/// contour is in the unit of the file. Tolerances: the size of the contour, radians, the largest
/// curvature.
inline void expect_same_curve(const Contour& contour, const std::vector<Piece>& read, double factor,
                              double tolerance = 1e-9) {
  double length = 0.0, size = 0.0, largest = 0.0, read_length = 0.0, far = 0.0;
  for (const Piece& piece : contour.pieces) {
    length += arc_length(piece, 0.0);
    for (const double t : {0.0, 1.0}) largest = std::max(largest, std::abs(at(piece, t).kappa));
    size = std::max(size, norm(end_point(piece) - start_point(contour.pieces.front())));
    far = std::max(far, norm(end_point(piece)));
  }
  for (const Piece& piece : read) read_length += arc_length(piece, 0.0);
  ASSERT_NEAR(read_length, factor * length, tolerance * factor * length);
  // Coordinates far from the origin carry their own rounding.
  const double place = factor * (tolerance * size + 4.0 * far * 2.3e-16);
  double before = 0.0;
  for (const Piece& piece : contour.pieces) {
    const double own = arc_length(piece, 0.0);
    for (const double t :
         {0.1, 0.35, 0.5, 0.8}) {  // at joints of arcs the curvature has two values
      const Element here = at(piece, t), there = at_length(read, factor * (before + t * own));
      EXPECT_NEAR(there.point.x, factor * here.point.x, place);
      EXPECT_NEAR(there.point.y, factor * here.point.y, place);
      EXPECT_NEAR(std::remainder(there.theta - here.theta, 2.0 * std::numbers::pi), 0.0,
                  tolerance + place / (factor * size));
      EXPECT_NEAR(there.kappa * factor, here.kappa, tolerance * largest);
    }
    before += own;
  }
}

/// Runs a script of this folder over a text. Empty: it found nothing wrong; otherwise what it said.
inline std::string judged(const std::string& script, const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() /
                    (script + "." + std::to_string(std::hash<std::string>{}(text)) + ".tmp");
  std::ofstream(file, std::ios::binary) << text;
  const std::string command = "python3 '" + std::string(OBVID_SOURCE_DIR) + "/tests/exchange/" +
                              script + "' '" + file.string() + "' 2>&1";
  RanCommand done = ran(command);
  if (done.status != 0 && done.printed.empty()) done.printed = "the script failed";
  std::filesystem::remove(file);
  return done.printed;
}

}  // namespace obvid
