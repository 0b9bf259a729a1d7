// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/internal/carrier_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "contours.h"
#include "spiral_table.h"

namespace obvid {
namespace {

using testing_data::arc_from;
using testing_data::kSpirals;
using testing_data::spiral;
using testing_data::SpiralRow;

RationalBezier polynomial(int degree) {
  RationalBezier piece;
  piece.degree = degree;
  for (int j = 0; j <= degree; ++j) {
    const double t = static_cast<double>(j) / degree;
    piece.offset[static_cast<std::size_t>(j)] = {t, 0.3 * t * t};
    piece.weight[static_cast<std::size_t>(j)] = 1.0;
  }
  return piece;
}

RationalBezier conic_with(double middle) {
  return {{}, 2, {Vec2{0, 0}, {0.5, 0}, {1, 1}}, {1.0, middle, 1.0}};
}

bool belongs(Carrier carrier, const Piece& piece) {
  Contour contour;
  contour.carrier = carrier;
  contour.pieces = {LinePiece{{-1, 0}, {0, 0}}, piece};
  const auto foreign = foreign_piece(contour);
  EXPECT_EQ(foreign.value_or(ForeignPiece{1, ""}).index, 1u);
  return !foreign;
}

TEST(CarrierPieces, EachCarrierHasItsOwnKindsOnly) {
  const std::vector<std::pair<const char*, Piece>> pieces = {
      {"arc", arc_from({0, 0}, 0.0, 0.5, 1.0)},
      {"clothoid", ClothoidPiece{{0, 0}, {1, 0}, 0.0, 0.0, 0.1, 1.0}},
      {"spiral", spiral(kSpirals[1])},
      {"ellipse", conic_with(0.9)},
      {"parabola", conic_with(1.0)},
      {"hyperbola", conic_with(1.1)},
      {"cubic", polynomial(3)},
      {"quartic", polynomial(4)},
      {"quintic", polynomial(5)}};
  const std::vector<std::pair<Carrier, std::vector<std::string>>> has = {
      {Carrier::kSpiral, {"arc", "spiral", "quartic"}},
      {Carrier::kArcs, {"arc"}},
      {Carrier::kConics, {"arc", "ellipse", "hyperbola"}},
      {Carrier::kBeziers, {"parabola"}},
      {Carrier::kClothoids, {"arc", "clothoid"}},
      {Carrier::kBspline, {"arc", "quintic"}},
      {Carrier::kCubic, {"cubic"}}};
  for (const auto& [carrier, names] : has) {
    for (const auto& [name, piece] : pieces) {
      const bool expected = std::find(names.begin(), names.end(), name) != names.end();
      EXPECT_EQ(belongs(carrier, piece), expected) << to_string(carrier) << " " << name;
    }
  }
  for (const auto& [name, piece] : pieces) EXPECT_TRUE(belongs(Carrier::kBaseline, piece)) << name;
}

TEST(CarrierPieces, ConicsAreEllipsesAndHyperbolasParabolasAreBeziers) {
  EXPECT_TRUE(belongs(Carrier::kConics, conic_with(std::nextafter(1.0, 0.0))));
  EXPECT_FALSE(belongs(Carrier::kConics, conic_with(1.0)));
  EXPECT_TRUE(belongs(Carrier::kConics, conic_with(std::nextafter(1.0, 2.0))));
  EXPECT_TRUE(belongs(Carrier::kBeziers, conic_with(1.0)));
  EXPECT_FALSE(belongs(Carrier::kBeziers, conic_with(std::nextafter(1.0, 2.0))));
}

TEST(CarrierPieces, TellsAKeptPieceThatIsNotTheCarriers) {
  Contour contour;
  contour.carrier = Carrier::kArcs;
  contour.pieces = {ClothoidPiece{{0, 0}, {1, 0}, 0.0, 0.0, 0.1, 1.0}};
  EXPECT_FALSE(keeps_foreign_pieces(contour));  // not kept: refused by `foreign_piece`
  contour.kept = {0};
  EXPECT_TRUE(keeps_foreign_pieces(contour));
  contour.carrier = Carrier::kClothoids;
  EXPECT_FALSE(keeps_foreign_pieces(contour));
}

}  // namespace
}  // namespace obvid
