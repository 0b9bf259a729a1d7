// SPDX-License-Identifier: Apache-2.0
// A judge that finds no faults is worthless: every claim of a contour file is doctored once.
#include <filesystem>

#include "doctored.h"

namespace judge {
namespace {

std::string series10() { return data("judge/series10.json"); }

TEST(JudgeContour, ReadsWhatIsJsonAndNothingElse) {
  EXPECT_EQ(read_json(R"({"a": [1, -2.5e-3, null, true, "x"]})").fault, "");
  for (const char* bad : {"", "{", R"({"a": 1, "a": 2})", "[1,]", "[01]", "[1e999]", "[NaN]",
                          "[1] x", "[.5]", "'a'"}) {
    EXPECT_NE(read_json(bad).fault, "") << bad;
  }
}

TEST(JudgeContour, FindsAFalseVerdictOfAPiece) {
  expect_found(series10(), with(series10(), "verdict", "\"decreasing\"", 3),
               "certificate.monotone");
  expect_found(series10(), with(series10(), "verdict", "\"has-vertex\"", 0),
               "certificate.monotone");
}

TEST(JudgeContour, FindsAWeightMovedByAMillionthAtTheJoints) {
  // the curvature at the start is proportional to w0 w2 / w1^2
  const std::string doctored =
      changed(series10(), "\"weights\": [1, ", "\"weights\": [1.000003, ", 4);
  const Sheet sheet = judged(doctored);
  EXPECT_TRUE(sheet.has("certificate.joint_gaps.curvature")) << all_false(sheet);
  EXPECT_TRUE(sheet.has("certificate.gaps_within_bounds"));
  EXPECT_TRUE(sheet.has("bspline"));
}

TEST(JudgeContour, FindsFalseCounts) {
  expect_found(series10(), with(series10(), "vertices", "1", 0), "report.vertices");
  expect_found(series10(), with(series10(), "vertices", "1", 1), "certificate.vertices");
  expect_found(series10(), with(series10(), "inflections", "1", 0), "report.inflections");
  expect_found(series10(), with(series10(), "inflections", "1", 1), "certificate.inflections");
  expect_found(series10(), with(series10(), "corners", "1"), "certificate.corners");
  expect_found(series10(), with(series10(), "vertices_lower_bound", "1"),
               "report.vertices_lower_bound");
}

TEST(JudgeContour, FindsFalseRuns) {
  expect_found(series10(), with(series10(), "direction", "-1"), "runs");
  expect_found(series10(), with(series10(), "last_piece", "7"), "runs");
}

TEST(JudgeContour, FindsFalseElementsAndSources) {
  expect_found(series10(), with(series10(), "kappa", "-0.2", 1), "elements");
  expect_found(series10(), with(series10(), "heading", "1.5", 2), "elements");
  expect_found(series10(), with(series10(), "source", "4", 3), "elements.source");
  expect_found(series10(), with(series10(), "source", "4", 3), "certificate.through_points");
}

TEST(JudgeContour, FindsAPointThatIsNotMet) {
  const std::string doctored = changed(series10(), "[-20.48, -7.65]", "[-20.48, -7.650001]");
  expect_found(series10(), doctored, "certificate.through_points");
  expect_found(series10(), doctored, "report.largest_move");
  expect_found(series10(), doctored, "certificate.largest_move");
}

TEST(JudgeContour, FindsALabelThatIsNotTheCarrier) {
  for (const char* name :
       {"\"bspline\"", "\"conics\"", "\"beziers\"", "\"clothoids\"", "\"fair\""}) {
    expect_found(series10(), with(series10(), "carrier", name), "carrier");
  }
}

// The largest distance of the last part from the farther boundary is 0.6047, by an independent
// computation in plain geometry of touching circles; the height at one place gives 0.5912.
TEST(JudgeContour, KnowsTheLargestErrorOfTheSeriesOfTenPoints) {
  const auto last_row = [](const char* value) { return with(series10(), "deviation", value, 8); };
  EXPECT_TRUE(judged(last_row("0.5912")).has("segments.deviation"));
  const auto of_last = [](const Sheet& sheet) {
    for (const Finding& f : sheet.findings()) {
      if (f.claim.starts_with("segments.deviation") && f.where.starts_with("points 9-10 ") &&
          f.kind == Finding::Kind::kFalse && f.claim != "segments.deviation_at") {
        return f.claim;
      }
    }
    return std::string();
  };
  EXPECT_EQ(of_last(judged(last_row("0.6046"))), "segments.deviation");
  EXPECT_EQ(of_last(judged(last_row("0.6048"))), "");
  EXPECT_EQ(of_last(judged(last_row("0.6060"))), "segments.deviation tight");
}

// 000, table 1: errors 0.9431 and 1.8869 by the paper, 0.9426 and 1.8853 by the formula.
TEST(JudgeContour, KnowsTheErrorsOfThePointsAlone) {
  expect_found(series10(), with(series10(), "points_only_error", "0.94", 2),
               "segments.points_only_error");
  expect_found(series10(), with(series10(), "points_only_error", "0.95", 2),
               "segments.points_only_error");
  expect_found(series10(), with(series10(), "points_only_error", "0", 0),
               "segments.points_only_error");
  expect_found(series10(), with(series10(), "points_only_error", "null", 3),
               "segments.points_only_error null");
}

TEST(JudgeContour, FindsWidthsThatNeedMoreElements) {
  expect_found(series10(), with(series10(), "inserted", "2", 8), "segments.width");
  expect_found(series10(), with(series10(), "width", "0.00001", 4), "segments.width");
  expect_found(series10(), with(series10(), "chord", "7.3", 1), "segments.chord");
}

TEST(JudgeContour, FindsTotalsThatAreNotThoseOfTheRows) {
  expect_found(series10(), with(series10(), "largest_width", "0.0008"), "report.largest_width");
  expect_found(series10(), with(series10(), "inserted_points", "51"), "report.inserted_points");
}

TEST(JudgeContour, FindsFaultsInAFileWithoutPieces) {
  const std::string empty = with(with(series10(), "pieces", "[]"), "runs", "[]");
  EXPECT_GT(judged(empty).wrong(), 0);
}

TEST(JudgeContour, FindsProofsThatAreNone) {
  expect_found(series10(), with(series10(), "through_points", "false"), "certificate.proved");
  const std::string vertex =
      with(series10(), "points", "[[0, 0], [1, 0], [-2, 1], [3, 1], [0.21, -5.28]]", 2);
  const Sheet sheet = judged(vertex);
  EXPECT_TRUE(sheet.has("certificate.proved")) << all_false(sheet);
  EXPECT_TRUE(sheet.has("certificate.monotone"));
}

TEST(JudgeContour, FindsFlagsThatAreFalseAlthoughWhatTheySayHolds) {
  for (const char* name : {"gaps_within_bounds", "inside_region", "through_points", "proved"}) {
    expect_found(series10(), with(series10(), name, "false"), std::string("certificate.") + name);
  }
  expect_found(series10(), with(series10(), "reason", "\"piece 3 has a vertex at t = 0.5\""),
               "certificate.reason");
}

/// A line of 3 along x as a cubic, then one whose curvature begins with 2/3 (that of a cubic's
/// start: 2/3 of the height of its third control point over the square of its first side).
std::string stepping(const std::string& through, const std::string& reason) {
  return R"({"format": "obvid-contour", "version": 1, "units": "mm", "units_source": "given",
    "closed": false, "carrier": "baseline", "points": [[0, 0], [3, 0], [6, 3]],
    "elements": [{"point": [0, 0], "heading": 0, "kappa": 0, "source": 0},
      {"point": [3, 0], "heading": 0, "kappa": 0, "source": 1},
      {"point": [6, 3], "heading": 1.1071487177940904, "kappa": 0, "source": 2}],
    "pieces": [{"type": "bezier", "points": [[0, 0], [1, 0], [2, 0], [3, 0]], "weights": [1, 1, 1, 1]},
      {"type": "bezier", "points": [[3, 0], [4, 0], [5, 1], [6, 3]], "weights": [1, 1, 1, 1]}],
    "runs": [{"first_piece": 0, "last_piece": 0, "direction": 0},
      {"first_piece": 1, "last_piece": 1, "direction": 0}],
    "certificate": {"joint_gaps": {"position": 0, "heading": 0, "curvature": 1.0001},
      "gaps_within_bounds": false, "inside_region": false, "through_points": )" +
         through + R"(, "proved": false, "reason": ")" + reason + "\"}}";
}

TEST(JudgeContour, GapsOfCurvatureMissNoPointAndAreTheReason) {
  const std::string gap = "the curvature gap at joint 2 is 1, its bound 1e-06";
  const std::string sound = stepping("true", gap);
  EXPECT_FALSE(judged(sound).has("certificate.gaps_within_bounds")) << all_false(judged(sound));
  EXPECT_FALSE(judged(sound).has("certificate.joint_gaps.curvature")) << all_false(judged(sound));
  expect_found(sound, stepping("false", gap), "certificate.through_points");
  expect_found(sound, stepping("true", "piece 2 has a vertex at t = 0.9"), "certificate.reason");
  expect_found(sound, changed(sound, "[6, 3]], ", "[6, 3.01]], "), "certificate.through_points");
}

/// What `fit` and `verify` of a file end with.
TEST(JudgeContour, AContourKeepsWhatItsCarrierPromisesAndNoMore) {
  const auto kept = [](const std::string& text) {
    return read_contour(text).contour.keeps_promise();
  };
  const std::string gaps = stepping("true", "the curvature gap at joint 2");
  EXPECT_FALSE(kept(gaps));
  const std::string none = with(gaps, "gaps_within_bounds", "true");
  EXPECT_TRUE(kept(none));
  EXPECT_FALSE(kept(with(none, "through_points", "false")));
  EXPECT_FALSE(kept(with(none, "carrier", "\"spiral\"")));
  EXPECT_TRUE(kept(series10()));
  EXPECT_FALSE(kept(with(series10(), "largest_width", "0.00084")));
}

TEST(JudgeContour, AcceptsArcsThatJumpOneWayOnly) {
  const std::string arcs = data("contours/arcs_closed.json");
  EXPECT_FALSE(judged(arcs).has("runs")) << all_false(judged(arcs));
  EXPECT_FALSE(judged(arcs).has("certificate.vertices"));
  // one radius against the others
  const std::string doctored = with(arcs, "kappa", "0.1", 29);
  EXPECT_TRUE(judged(doctored).wrong() > judged(arcs).wrong());
}

TEST(JudgeContour, FindsTheFaultOfEachFileThatMustBeRefused) {
  const auto folder = std::filesystem::path(OBVID_SHARED_DATA) / "found" / "refuse";
  if (!std::filesystem::is_directory(folder))
    GTEST_SKIP() << "the public data sets are missing: " << folder;
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Sheet sheet = judged(text_of_file(entry.path().string()));
    EXPECT_GT(sheet.wrong(), 0) << entry.path();
    ++seen;
  }
  EXPECT_GE(seen, 11);
}

}  // namespace
}  // namespace judge
