// SPDX-License-Identifier: Apache-2.0
// Half a unit of the last printed digit, by hand for each form.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "../common/shared_data.h"
#include "obvid/io/read_points.h"
#include "text_digits.h"

namespace obvid {
namespace {

Vec2 rounding_of(std::string_view text) {
  const auto series = parse_points(text, "f");
  EXPECT_TRUE(series.has_value()) << (series ? "" : to_line(series.error()));
  return series ? series->rounding : Vec2{-1, -1};
}

TEST(Rounding, TheMostDecimalsOfAColumnDecideForEachColumn) {
  EXPECT_EQ(rounding_of("1. .5\n0.95 0.25\n0.9 0.125\n"), (Vec2{0.005, 0.0005}));
  EXPECT_EQ(rounding_of("0,0\n17,3\n-4,12\n"), (Vec2{0.5, 0.5}));
  EXPECT_EQ(rounding_of("1.00000 0.00126\n0.5 0.1\n0 0\n"), (Vec2{5e-6, 5e-6}));
  EXPECT_EQ(rounding_of("61. 61.\n60. 60.5\n59. 61.\n"), (Vec2{0.5, 0.05}));
  EXPECT_EQ(rounding_of("+1.25 -.5\n-0.5 +.25\n2 3\n"), (Vec2{0.005, 0.005}));
}

TEST(Rounding, SeparatorsQuotesAndDecimalCommasDoNotMatter) {
  EXPECT_EQ(rounding_of("1,50;2,5\n3;-4\n0,25;600\n"), (Vec2{0.005, 0.05}));
  EXPECT_EQ(rounding_of("\"x\",\"y\"\n\"1.50\",\"2.5\"\n3,-4\n0.25,600\n"), (Vec2{0.005, 0.05}));
  EXPECT_EQ(rounding_of("1.5\t2.25 # 0.12345\r\n3\t4 ! 0.123\r\n5\t7\r\n"), (Vec2{0.05, 0.005}));
}

TEST(Rounding, ExponentsCountWithTheFullDigitsOfTheMantissa) {
  EXPECT_EQ(rounding_of("1.00000E+00 1.0000d-02\n9.9500E-01 2.5000D-03\n5.00000e-1 1.2500d-03\n"),
            (Vec2{5e-6, 5e-7}));
  // Zeros have no exponent of their own; shorter mantissas are stripped ones.
  EXPECT_EQ(rounding_of("0.00E+00 1e0\n1.25E-03 2.5e-1\n2.50E-03 1.25e-1\n"), (Vec2{5e-6, 5e-4}));
  // Fortran writes 0.12345E+01: five digits.
  EXPECT_EQ(rounding_of("0.12345E+01 0\n0.99500E+00 1\n0.10000E-01 3\n"), (Vec2{5e-5, 0.5}));
}

TEST(Rounding, ZerosWithAnyExponentHaveNoRounding) {
  EXPECT_EQ(rounding_of("1 0e9999\n2 0e9999\n3 0e9999\n1 1\n").x, 0.5);
  EXPECT_EQ(rounding_of("1 0e9999\n2 0e9999\n3 0e9999\n").y, 0.0);
}

TEST(Rounding, InMixedColumnsTheMajorityDecides) {
  // A zero of a computing program in a column of six decimals, and noughts in one of exponents.
  EXPECT_EQ(rounding_of("1.000000 0\n0.500000 2.5e-1\n1.22E-16 1.5e-2\n"), (Vec2{5e-7, 0.005}));
  // As many of each kind: the smaller of both.
  EXPECT_EQ(rounding_of("1.5 1\n2.5E-01 2\n0 4\n"), (Vec2{0.005, 0.5}));
}

TEST(Rounding, SixteenAndMoreDigitsAreTakenAsTheyStand) {
  EXPECT_EQ(rounding_of("0.1234567890123456 1\n0.5 2\n0.25 4\n"), (Vec2{5e-17, 0.5}));
  EXPECT_EQ(rounding_of("0.123456789012345678 1e-30\n0.5 2e-30\n0.25 4e-30\n"),
            (Vec2{5e-19, 5e-31}));
}

TEST(Rounding, LinesThatAreNoPointsDoNotCount) {
  const std::string sides = "0 0\n0.1 0.05\n0.5 0.06\n1 0.01\n\n0 0\n0.1 -0.03\n0.5 -0.04\n1 0\n";
  EXPECT_EQ(rounding_of("FOIL\n 4. 4.\n\n" + sides), (Vec2{0.05, 0.005}));
  EXPECT_EQ(rounding_of("FOIL\n 4.0000 4.0000\n\n" + sides), (Vec2{0.05, 0.005}));
  EXPECT_EQ(rounding_of("D GEOM AIRFOIL FILE\nF 1.23456\n0\tSym Flag (0 - No, 1 - Yes)\n"
                        "4\tNum Pnts Upper\n4\tNum Pnts Lower\n" +
                        sides),
            (Vec2{0.05, 0.005}));
  EXPECT_EQ(rounding_of("FOIL\n -2.00000 3.00000 -2.5 3.5\n1.5 2.25\n3 -4\n0.5 600\n"),
            (Vec2{0.05, 0.005}));
  EXPECT_EQ(rounding_of("4 NumCoords\n0.25000 0.00000\n1.5 2.25\n3 -4\n0.5 600\n"),
            (Vec2{0.05, 0.005}));
  EXPECT_EQ(rounding_of("3\n1.5 2.25\n3 -4\n0.5 600\n"), (Vec2{0.05, 0.005}));
}

TEST(Rounding, OtherColumnsDoNotCount) {
  EXPECT_EQ(rounding_of("tol,y,x\n0.00001,2.5,1\n0.00001,-4,3\n,6,0.25\n"), (Vec2{0.005, 0.05}));
  EXPECT_EQ(rounding_of("1 2 0.125\n3 4 0.125\n5 7 0.125\n"), (Vec2{0.5, 0.5}));
}

// Points rounded to `decimals` and printed with `printed` of them, x on round stations or not.
std::string printed_points(int count, int decimals, int printed, bool single, double scale = 1.0,
                           unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, scale);
  std::string text;
  const double step = std::pow(10.0, decimals);
  for (int i = 0; i < count; ++i) {
    double xy[2];
    for (double& v : xy) {
      v = std::round(unit(random) * step) / step;
      if (single) v = double(float(float(v) * (1.0F - 0x1p-24F)));  // one step of single precision
    }
    char line[80];
    std::snprintf(line, sizeof line, "%.*f %.*f\n", printed, xy[0], printed, xy[1]);
    text += line;
  }
  return text;
}

TEST(Rounding, ZerosThatEndEveryNumberArePadding) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(rounding_of(printed_points(60, 5, 7, false, 1.0, seed)), (Vec2{5e-6, 5e-6}));
    EXPECT_EQ(rounding_of(printed_points(60, 5, 5, false, 1.0, seed)), (Vec2{5e-6, 5e-6}));
    EXPECT_EQ(rounding_of(printed_points(60, 7, 7, false, 1.0, seed)), (Vec2{5e-8, 5e-8}));
    EXPECT_EQ(rounding_of(printed_points(60, 3, 9, false, 50.0, seed)), (Vec2{5e-4, 5e-4}));
    // Whole numbers may be nominal sizes, whatever zeros follow.
    EXPECT_EQ(rounding_of(printed_points(60, 0, 2, false, 5000.0, seed)), (Vec2{0.005, 0.005}));
  }
}

TEST(Rounding, PaddingOfSinglePrecisionMissesByOne) {
  // 0.98561 stored in single precision is printed as 0.9856099 with seven decimals.
  const std::string text = printed_points(60, 5, 7, true);
  ASSERT_NE(text.find("99 "), std::string::npos);
  EXPECT_EQ(rounding_of(text), (Vec2{5e-6, 5e-6}));
}

TEST(Rounding, RoundStationsAreNotRoundedNumbers) {
  // x = 0.05 i has two decimals by choice, y five by rounding: both were printed alike.
  std::string text;
  for (int i = 0; i <= 20; ++i) {
    char line[64];
    std::snprintf(line, sizeof line, "%.5f00 %.5f00\n", 0.05 * i, 0.3 * std::sin(0.15 * i));
    text += line;
  }
  EXPECT_EQ(rounding_of(text), (Vec2{5e-6, 5e-6}));
}

TEST(Rounding, NominalSizesKeepTheirZeros) {
  EXPECT_EQ(rounding_of("0.000 0.000\n100.000 0.000\n100.000 50.000\n"), (Vec2{5e-4, 5e-4}));
  std::string plate;
  for (int i = 0; i < 40; ++i) {
    plate += std::to_string(10 * i) + ".000 " + std::to_string((i * i) % 90) + ".500\n";
  }
  EXPECT_EQ(rounding_of(plate), (Vec2{5e-4, 5e-4}));
  std::string steps;
  for (int i = 0; i < 40; ++i) {
    steps += std::to_string(i) + ".00 " + std::to_string((7 * i) % 97) + ".00\n";
  }
  EXPECT_EQ(rounding_of(steps), (Vec2{0.005, 0.005}));
}

TEST(Rounding, DigitsOfOneNumber) {
  const auto of = [](std::string_view field) { return text::digits_of(field); };
  EXPECT_EQ(of("0.0120").unit, -4);
  EXPECT_EQ(of("0.0120").padding, 1);
  EXPECT_EQ(of("0.0120").last, 2);
  EXPECT_EQ(of("0.0120").significant, 3);
  EXPECT_EQ(of("-61.").unit, 0);
  EXPECT_EQ(of("1.5E+03").unit, 2);
  EXPECT_TRUE(of("1.5E+03").exponent);
  EXPECT_TRUE(of("0.00D+00").zero);
  EXPECT_EQ(of("0.9856099").padding, 2);
  EXPECT_EQ(of("0.9856099").last, 1);
  EXPECT_EQ(of("0.8043801").padding, 2);
  EXPECT_EQ(of("0.8043801").last, 8);
  EXPECT_EQ(of("0.2999999").padding, 6);
  EXPECT_EQ(of("0.2999999").last, 3);
  EXPECT_EQ(of("0e99999999999999999999").unit, 100000);
}

TEST(PublicData, RoundingOfAirfoilsIsThatOfTheirDecimals) {
  SKIP_WITHOUT("airfoil_quirks.tsv");
  const std::filesystem::path data = shared_data();
  std::ifstream table(data / "airfoil_quirks.tsv");
  // The table of another program counts decimals of y without zeros at the end (column 13).
  std::string line;
  std::getline(table, line);
  std::size_t compared = 0, smaller = 0;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '\t');) cells.push_back(cell);
    if (cells.at(12) == "0") continue;  // exponents
    const auto series = read_points((data / cells[0] / cells[1]).string());
    ASSERT_TRUE(series.has_value());
    const double expected = std::stod("5e-" + std::to_string(std::stoi(cells[12]) + 1));
    // Never more than half a unit, but for single digits of single precision (those of `fx`).
    EXPECT_LE(series->rounding.y, expected) << line;
    if (series->rounding.y < expected) ++smaller;
    ++compared;
  }
  EXPECT_GE(compared, 1150U);
  EXPECT_LE(smaller, 12U);  // few numbers that use the last digit: the zeros count
}

}  // namespace
}  // namespace obvid
