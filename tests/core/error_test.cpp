// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/error.h"
#include "../common/text.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "obvid/core/result.h"
#include "obvid/core/version.h"

namespace obvid {
namespace {

TEST(ErrorLine, HoldsCodePlaceAndHintInTheDocumentedOrder) {
  const Error error{ErrorCode::kBadNumber, "`1.2.3` is not a number", "part.csv:12:7",
                    "check the decimal point"};
  EXPECT_EQ(to_line(error),
            "obvid: error E302: `1.2.3` is not a number (part.csv:12:7); check the decimal point");
}

TEST(ErrorLine, LeavesOutWhatIsEmpty) {
  EXPECT_EQ(to_line({ErrorCode::kUsage, "no command given", "", ""}),
            "obvid: error E201: no command given");
  EXPECT_EQ(to_line({ErrorCode::kUsage, "no command given", "", "try --help"}),
            "obvid: error E201: no command given; try --help");
}

TEST(ErrorLine, StaysOneLineWhateverTheInputHolds) {
  const std::string line = to_line({ErrorCode::kCannotOpen, "a\nb", "c\r\nd", "e\n"});
  EXPECT_EQ(line.find_first_of("\r\n"), std::string::npos);
}

TEST(ErrorTexts, StandInAscendingOrderWithoutRepetition) {
  int before = 0;
  for (const ErrorText& text : error_texts()) {
    EXPECT_LT(before, static_cast<int>(text.code));
    before = static_cast<int>(text.code);
  }
}

// The header is the list of codes; reading it here notices a code that was added without a text.
TEST(ErrorTexts, ExplainEveryCodeOfTheHeader) {
  const std::string header = text_of_file(OBVID_SOURCE_DIR "/include/obvid/core/error.h");
  const std::regex enumerator(R"(\bk[A-Z]\w* = (\d{3}),)");
  std::set<int> declared;
  for (std::sregex_iterator it(header.begin(), header.end(), enumerator), end; it != end; ++it) {
    declared.insert(std::stoi((*it)[1]));
  }
  ASSERT_GE(declared.size(), 20u) << "the header was not understood";
  std::set<int> explained;
  for (const ErrorText& text : error_texts()) {
    explained.insert(static_cast<int>(text.code));
  }
  EXPECT_EQ(declared, explained);
}

TEST(ErrorTexts, AreWholeSentences) {
  for (const ErrorText& text : error_texts()) {
    EXPECT_FALSE(text.title.empty());
    EXPECT_NE(text.title.back(), '.') << text.title;
    EXPECT_EQ(text.meaning.back(), '.') << text.title;
    EXPECT_EQ(text.remedy.back(), '.') << text.title;
  }
}

TEST(ErrorBuilder, TellsAnErrorFieldByFieldAndGoesWhereAnErrorOrAResultIsDue) {
  const Error told = error(ErrorCode::kOutOfOrder, "two nodes coincide")
                         .where("node 3")
                         .hint("remove one of them")
                         .points(std::size_t{2}, std::size_t{3})
                         .value(0.5);
  EXPECT_EQ(to_line(told), "obvid: error E313: two nodes coincide (node 3); remove one of them");
  EXPECT_EQ(told.index, 2);
  EXPECT_EQ(told.last, 3);
  EXPECT_EQ(told.value, 0.5);
  const Result<std::string> refused = error(ErrorCode::kBadOption, "no");
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kBadOption);
  EXPECT_EQ(refused.error().index, -1);
  EXPECT_EQ(refused.error().last, -1);
}

TEST(Try, LeavesWithTheErrorAndGoesOnWithoutOne) {
  int asked = 0;
  const auto half = [&](int of) -> Result<int> {
    ++asked;
    if (of % 2 != 0) return error(ErrorCode::kBadOption, "odd").value(of);
    return of / 2;
  };
  const auto quarter = [&](int of) -> Result<std::string> {
    auto first = half(of);
    OBVID_TRY(first);
    OBVID_TRY(half(*first));
    return std::to_string(*first / 2);
  };
  EXPECT_EQ(*quarter(8), "2");
  EXPECT_EQ(asked, 2);  // an expression is evaluated once
  EXPECT_EQ(quarter(6).error().value, 3.0);
  EXPECT_EQ(quarter(5).error().value, 5.0);
}

TEST(Category, IsThatOfTheExitCode) {
  EXPECT_EQ(category(ErrorCode::kCancelled), ErrorCategory::kProgram);
  EXPECT_EQ(category(ErrorCode::kBadOption), ErrorCategory::kUsage);
  EXPECT_EQ(category(ErrorCode::kNothingThere), ErrorCategory::kInput);
  EXPECT_EQ(category(ErrorCode::kSurfaceFolds), ErrorCategory::kNoContour);
  EXPECT_EQ(category(ErrorCode::kFalseClaim), ErrorCategory::kNotKept);
}

TEST(ExitCode, IsTheHundredsDigitAndOneOfTheDocumentedFive) {
  EXPECT_EQ(exit_code(ErrorCode::kUsage), 2);
  EXPECT_EQ(exit_code(ErrorCode::kTooFewPoints), 3);
  EXPECT_EQ(exit_code(ErrorCode::kNoSpiral), 4);
  EXPECT_EQ(exit_code(ErrorCode::kFalseClaim), 5);
  for (const ErrorText& text : error_texts()) {
    EXPECT_GE(exit_code(text.code), 1);
    EXPECT_LE(exit_code(text.code), 5);
  }
}

TEST(Result, CarriesAValueOrTheReasonWhyThereIsNone) {
  const Result<int> good = 7;
  const Result<int> bad = fail({ErrorCode::kTooFewPoints, "2 points", "", "", 0, 2.0});
  ASSERT_TRUE(good.has_value());
  EXPECT_EQ(*good, 7);
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(bad.error().value, 2.0);
}

TEST(Version, IsTheOneOfTheVersionFile) {
  std::string stated = text_of_file(OBVID_SOURCE_DIR "/VERSION");
  while (!stated.empty() && stated.back() == '\n') stated.pop_back();
  EXPECT_EQ(stated, kVersion);
}

}  // namespace
}  // namespace obvid
