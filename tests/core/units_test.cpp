// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/units.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace obvid {
namespace {

// By definition: the international inch is 25.4 mm, foot and mile are 12 and 63360 of it (1959),
// the US survey foot is 1200/3937 m (1893).
TEST(Units, HaveTheLengthsOfTheirDefinitions) {
  EXPECT_EQ(metres_in("mm"), 1e-3);
  EXPECT_EQ(metres_in("um"), 1e-6);
  EXPECT_EQ(metres_in("nm"), 1e-9);
  EXPECT_EQ(metres_in("cm"), 1e-2);
  EXPECT_EQ(metres_in("dm"), 1e-1);
  EXPECT_EQ(metres_in("m"), 1.0);
  EXPECT_EQ(metres_in("km"), 1e3);
  EXPECT_EQ(metres_in("in"), 0.0254);
  EXPECT_EQ(metres_in("mil"), 2.54e-5);
  EXPECT_EQ(metres_in("ft"), 0.3048);
  EXPECT_EQ(metres_in("yd"), 0.9144);
  EXPECT_EQ(metres_in("mi"), 1609.344);
  EXPECT_EQ(metres_in("usft"), 1200.0 / 3937.0);
}

TEST(Units, AreConvertedWithOneRounding) {
  EXPECT_EQ(unit_ratio("in", "mm"), 25.4);
  EXPECT_EQ(unit_ratio("ft", "mm"), 304.8);
  EXPECT_EQ(unit_ratio("mi", "mm"), 1609344.0);
  EXPECT_EQ(unit_ratio("ft", "in"), 12.0);
  EXPECT_EQ(unit_ratio("in", "mil"), 1000.0);
  EXPECT_EQ(unit_ratio("m", "m"), 1.0);
  EXPECT_EQ(unit_ratio("ft", "usft"), 0.999998);  // 3048 x 3937 = 11999976, by hand
}

TEST(Units, AreKnownByManySpellings) {
  for (const char* spelling : {"mm", "MM", "Millimeters", "millimetre", " mm "}) {
    EXPECT_EQ(canonical_unit(spelling), "mm") << spelling;
  }
  for (const char* spelling : {"in", "inch", "Inches", "\"", "in."}) {
    EXPECT_EQ(canonical_unit(spelling), "in") << spelling;
  }
  for (const char* spelling : {"usft", "US survey foot", "us-survey-foot", "US_Survey_Feet"}) {
    EXPECT_EQ(canonical_unit(spelling), "usft") << spelling;
  }
  EXPECT_EQ(canonical_unit("\xC2\xB5m"), "um");
  EXPECT_EQ(canonical_unit("thou"), "mil");
  EXPECT_EQ(canonical_unit("nm"), "nm");
  EXPECT_EQ(canonical_unit("NM"), std::nullopt);  // nautical miles would be 1.8e12 times as long
  EXPECT_EQ(canonical_unit("furlong"), std::nullopt);
  EXPECT_EQ(canonical_unit(""), std::nullopt);
}

TEST(Units, OfTheChordHaveNoLengthInMetres) {
  EXPECT_EQ(canonical_unit("chord"), "chord");
  EXPECT_EQ(metres_in("chord"), std::nullopt);
  EXPECT_EQ(metres_in("furlong"), std::nullopt);
  const auto refused = unit_ratio(Units("chord"), "mm", "STEP files");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadOption);
  EXPECT_NE(refused.error().what.find("STEP files"), std::string::npos);
  EXPECT_NE(refused.error().hint.find("usft"), std::string::npos);
}

TEST(Units, ThatAreMerelyAssumedAreNotPrinted) {
  EXPECT_EQ(Units().text(), "units");
  EXPECT_EQ(Units("in", UnitSource::kAssumed).text(), "units");
  EXPECT_EQ(Units("in").text(), "in");
  EXPECT_EQ(Units("in", UnitSource::kGiven).text(), "in");
}

TEST(Units, ThatAreTypedAreKnownOrRefused) {
  EXPECT_EQ(given_units("inches", "--units")->name, "in");
  EXPECT_EQ(given_units("inches", "--units")->source, UnitSource::kGiven);
  const auto refused = given_units("mmm", "--units");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadOption);
  EXPECT_EQ(refused.error().where, "--units");
}

TEST(Units, ThatContradictTheFileAreTakenWithAWord) {
  Units units("mm");
  const auto told = take_units(units, *given_units("in", "--units"));
  ASSERT_TRUE(told);
  EXPECT_NE(told->find("mm"), std::string::npos);
  EXPECT_EQ(units.name, "in");
  Units assumed;
  EXPECT_FALSE(take_units(assumed, *given_units("in", "--units")));
  EXPECT_EQ(assumed.name, "in");
}

TEST(Units, OfThingsThatBelongTogetherAgreeOrAreRefused) {
  EXPECT_EQ(common_units(std::vector<Units>{Units(), Units("m"), Units("m")}, "f")->name, "m");
  EXPECT_FALSE(common_units(std::vector<Units>{Units(), Units()}, "f")->known());
  const auto refused = common_units(std::vector<Units>{Units("mm"), Units("m")}, "f");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
}

TEST(Units, ThatAFileCannotStateBecomeTheNextOfTheirSystem) {
  constexpr std::array<std::string_view, 3> metric{"mm", "m", "ft"};
  EXPECT_EQ(unit_for_file("mm", metric), "mm");
  EXPECT_EQ(unit_for_file("nm", metric), "mm");
  EXPECT_EQ(unit_for_file("dm", metric), "m");
  EXPECT_EQ(unit_for_file("yd", metric), "ft");
  EXPECT_EQ(unit_for_file("mil", metric), "ft");
  EXPECT_EQ(unit_for_file("usft", metric), "m");
  EXPECT_EQ(unit_for_file("chord", metric), "");
}

}  // namespace
}  // namespace obvid
