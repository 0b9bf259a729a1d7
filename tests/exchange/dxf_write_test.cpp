// SPDX-License-Identifier: Apache-2.0
// DXF files of contours: no entry in ezdxf's audit, and the same curve through ezdxf and back.
#include "../common/angles.h"
#include "../common/arcs.h"
#include "../common/programs.h"
#include "obvid/exchange/internal/dxf/write.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "obvid/exchange/internal/dxf/read.h"
#include "road_contours.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

const DxfProfile kProfiles[] = {DxfProfile::kExact, DxfProfile::kArcs, DxfProfile::kCubic,
                                DxfProfile::kArcsR12};
const char* const kStored[] = {"spirals_open.json",   "spirals_closed.json",  "spirals_corner.json",
                               "conics_open.json",    "arcs_closed.json",     "clothoids_open.json",
                               "clothoids_wave.json", "clothoids_closed.json"};

Contour of_pieces(std::vector<Piece> pieces, bool closed) {
  Contour c;
  c.closed = closed;
  c.carrier = Carrier::kArcs;
  c.joints.resize(pieces.size() + (closed ? 0 : 1));
  for (std::size_t i = 0; i < c.joints.size(); ++i) {
    const bool last = i == pieces.size();
    const Jet jet = evaluate(pieces[last ? i - 1 : i], last ? 1.0 : 0.0);
    c.joints[i].element = {jet.point, heading(jet.d1), curvature(jet)};
  }
  for (const Joint& joint : c.joints) c.points.push_back(joint.element.point);
  c.pieces = std::move(pieces);
  c.runs = {{0, c.pieces.size() - 1, 0}};
  return c;
}

/// Two lines and two half circles, clockwise.
Contour slot() {
  return of_pieces({LinePiece{{0, 2}, {4, 2}}, arc_from({4, 2}, 0.0, -1.0, kPi),
                    LinePiece{{4, 0}, {0, 0}}, arc_from({0, 0}, kPi, -1.0, kPi)},
                   true);
}

DxfText written(const Contour& contour, DxfProfile profile, double tolerance) {
  auto text = dxf_text(contour, {profile, tolerance, "CONTOUR"});
  EXPECT_TRUE(text) << (text ? "" : to_line(text.error()));
  return text ? *std::move(text) : DxfText{};
}

double size_of(const Contour& contour) {
  Vec2 low = contour.points.front(), high = low;
  for (const Vec2 p : contour.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return norm(high - low);
}

// ---- distances, independent of the parameters of both sides -----------------------------------

/// Distance from a point to a piece: the nearest of many points, then a golden section beside it.
/// Not looked for where it cannot be less than `least`: no place of the piece is farther from the
/// nearer of two neighbours than these are apart.
double distance_to(const Piece& piece, Vec2 p, double least) {
  constexpr int kCoarse = 24;
  const auto away = [&](double t) { return norm(evaluate(piece, t).point - p); };
  int best = 0;
  double nearest = HUGE_VAL, apart = 0.0, last = 0.0;
  Vec2 before{};
  for (int k = 0; k <= kCoarse; ++k) {
    const Vec2 at = evaluate(piece, double(k) / kCoarse).point;
    if (k > 0) apart = std::max(apart, norm(at - before));
    before = at;
    last = norm(at - p);
    if (last < nearest) {
      nearest = last;
      best = k;
    }
  }
  if (nearest - apart > least) return nearest;
  double low = std::max(0.0, (best - 1.0) / kCoarse), high = std::min(1.0, (best + 1.0) / kCoarse);
  constexpr double kGolden = 0.3819660112501051;
  double left = low + kGolden * (high - low), right = high - kGolden * (high - low);
  double at_left = away(left), at_right = away(right);
  for (int k = 0; k < 80; ++k) {
    if (at_left < at_right) {
      high = std::exchange(right, left);
      at_right = at_left;
      left = low + kGolden * (high - low);
      at_left = away(left);
    } else {
      low = std::exchange(left, right);
      at_left = at_right;
      right = high - kGolden * (high - low);
      at_right = away(right);
    }
  }
  return std::min(nearest, away(0.5 * (low + high)));
}

double distance_to(const std::vector<Piece>& pieces, Vec2 p) {
  double least = HUGE_VAL;
  for (const Piece& piece : pieces) least = std::min(least, distance_to(piece, p, least));
  return least;
}

double largest_distance(const std::vector<Piece>& of, const std::vector<Piece>& from) {
  double most = 0.0;
  for (const Piece& piece : of) {
    for (int k = 0; k <= 6; ++k) {
      most = std::max(most, distance_to(from, evaluate(piece, k / 6.0).point));
    }
  }
  return most;
}

// ---- ezdxf ------------------------------------------------------------------------------------

class DxfFilesByEzdxf : public testing::Test {
 protected:
  void SetUp() override {
    // looked for, not begun: that takes half a second
    if (std::system("/usr/bin/python3 -c 'import importlib.util, sys; "
                    "sys.exit(importlib.util.find_spec(\"ezdxf\") is None)'") != 0) {
      GTEST_SKIP() << "python3-ezdxf is not installed";
    }
    std::string pattern = (fs::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  /// What dxf_audit.py prints about a file, errors of Python included.
  std::string judge(const std::string& task, const std::string& text,
                    const std::string& rest = "") {
    return judged(task, kept(text, "file") + " " + rest);
  }

  /// The file of a text, as a word of a command.
  std::string kept(const std::string& text, const std::string& name) {
    const fs::path file = folder_ / (name + ".dxf");
    std::ofstream(file, std::ios::binary) << text;
    return "'" + file.string() + "'";
  }

  static std::string judged(const std::string& task, const std::string& rest) {
    const std::string command = std::string("/usr/bin/python3 -B '") + OBVID_SOURCE_DIR +
                                "/tests/exchange/dxf_audit.py' " + task + " " + rest;
    return judged_by(command);
  }

  /// Points that ezdxf finds on the curves of files (words of a command), file by file.
  static std::vector<std::vector<Vec2>> points(const std::vector<std::string>& files,
                                               int per_piece) {
    std::string words = std::to_string(per_piece);
    for (const std::string& file : files) words += " " + file;
    const std::string answer = judged("points", words);
    std::istringstream in(answer);
    std::vector<std::vector<Vec2>> out;
    for (std::string head; in >> head && head == "file";) {
      std::size_t count = 0;
      in >> count;
      out.emplace_back(count);
      for (Vec2& p : out.back()) in >> p.x >> p.y;
    }
    EXPECT_TRUE(in.eof()) << answer.substr(0, 400);
    EXPECT_EQ(out.size(), files.size()) << answer.substr(0, 400);
    out.resize(files.size());
    return out;
  }

  fs::path folder_;
};

TEST_F(DxfFilesByEzdxf, PassTheAuditInEveryProfile) {
  std::string files;
  for (const char* name : kStored) {
    const Contour contour = stored(name);
    for (const DxfProfile profile : kProfiles) {
      const std::string file = std::string(name) + " " + std::to_string(static_cast<int>(profile));
      files += kept(written(contour, profile, 1e-3).text, file) + " ";
    }
  }
  EXPECT_EQ(judged("audit", files + kept(written(slot(), DxfProfile::kExact, 1e-3).text, "slot")),
            "");
}

TEST_F(DxfFilesByEzdxf, TheAuditFindsWhatIsWrong) {
  std::string text = written(stored("spirals_open.json"), DxfProfile::kExact, 1e-3).text;
  const std::size_t owner = text.find("330\n1F\n100\nAcDbEntity\n  8\nCONTOUR");
  ASSERT_NE(owner, std::string::npos);
  text.replace(text.find("CONTOUR", owner), 7, "CON<OUR");
  EXPECT_NE(judge("audit", text), "");
}

double farthest(const std::vector<Vec2>& points, const Contour& from) {
  double most = 0.0;
  for (const Vec2 p : points) most = std::max(most, distance_to(from.pieces, p));
  return most;
}

TEST_F(DxfFilesByEzdxf, AreTheSameCurveInEveryExactProfile) {
  const char* const names[] = {"spirals_open.json", "spirals_closed.json", "spirals_corner.json",
                               "conics_open.json", "arcs_closed.json"};
  std::vector<std::string> files;
  for (const char* name : names) {
    files.push_back(kept(written(stored(name), DxfProfile::kExact, 1e-3).text, name));
  }
  const auto found = points(files, 5);
  for (std::size_t k = 0; k < files.size(); ++k) {
    const Contour contour = stored(names[k]);
    // the contour with a corner begins with two parts of one arc, which are one
    const bool has_parts = std::string(names[k]) == "spirals_corner.json";
    const std::size_t entities = contour.pieces.size() - (has_parts ? 1 : 0);
    ASSERT_GE(found[k].size(), 5 * entities) << names[k];
    EXPECT_LE(farthest(found[k], contour), 1e-9 * size_of(contour)) << names[k];
  }
}

TEST_F(DxfFilesByEzdxf, ArcsComeBackWithin1e9) {
  const Contour contour = stored("arcs_closed.json");
  for (const auto& found : points({kept(written(contour, DxfProfile::kArcs, 1e-3).text, "arcs"),
                                   kept(written(contour, DxfProfile::kArcsR12, 1e-3).text, "r12")},
                                  5)) {
    ASSERT_GE(found.size(), 5 * contour.pieces.size());
    EXPECT_LE(farthest(found, contour), 1e-9 * size_of(contour));
  }
}

TEST_F(DxfFilesByEzdxf, StayWithinTheToleranceElsewhere) {
  constexpr double kTolerance = 1e-4;
  struct Approximate {
    const char* name;
    double told;
  };
  std::vector<Approximate> all;
  std::vector<std::string> files;
  for (const char* name : kStored) {
    for (const DxfProfile profile : {DxfProfile::kArcs, DxfProfile::kCubic}) {
      const DxfText dxf = written(stored(name), profile, kTolerance);
      files.push_back(kept(dxf.text, std::to_string(files.size())));
      all.push_back({name, dxf.deviation});
    }
  }
  const auto found = points(files, 4);
  for (std::size_t k = 0; k < files.size(); ++k) {
    ASSERT_FALSE(found[k].empty()) << all[k].name;
    const double most = farthest(found[k], stored(all[k].name));
    EXPECT_LE(most, kTolerance) << all[k].name;
    EXPECT_LE(most, 1.05 * all[k].told + 1e-9) << all[k].name;  // as it was told
  }
}

// ---- our own reader ---------------------------------------------------------------------------

TEST(DxfRoundTrip, ExactContoursComeBackAsTheyWere) {
  for (const char* name : {"spirals_open.json", "spirals_closed.json", "spirals_corner.json",
                           "conics_open.json", "arcs_closed.json"}) {
    const Contour contour = stored(name);
    const DxfText dxf = written(contour, DxfProfile::kExact, 1e-3);
    EXPECT_EQ(dxf.deviation, 0.0);
    const auto drawing = parse_dxf(dxf.text, name);
    ASSERT_TRUE(drawing) << to_line(drawing.error());
    EXPECT_EQ(drawing->units, Units(contour.units.name, UnitSource::kFile));  // the file says so
    EXPECT_TRUE(drawing->warnings.empty()) << drawing->warnings[0];
    ASSERT_EQ(drawing->curves.size(), 1u) << name;  // joined over corners and entities
    EXPECT_EQ(drawing->curves[0].closed, contour.closed) << name;
    const double near = 1e-9 * size_of(contour);
    EXPECT_LE(largest_distance(contour.pieces, drawing->curves[0].pieces), near) << name;
    EXPECT_LE(largest_distance(drawing->curves[0].pieces, contour.pieces), near) << name;
  }
}

TEST(DxfRoundTrip, ArcsKeepDirectionRadiusAndTangents) {
  for (const DxfProfile profile : {DxfProfile::kArcs, DxfProfile::kArcsR12}) {
    const auto drawing = parse_dxf(written(slot(), profile, 1e-3).text, "slot");
    ASSERT_TRUE(drawing);
    ASSERT_EQ(drawing->curves.size(), 1u);
    const auto& pieces = drawing->curves[0].pieces;
    EXPECT_TRUE(drawing->curves[0].closed);
    EXPECT_EQ(start_point(pieces[0]), (Vec2{0, 2}));
    double length = 0.0, turn = 0.0;
    for (const Piece& piece : pieces) {
      length += arc_length(piece, 1e-12);
      turn += arc_length(piece, 1e-12) * curvature(evaluate(piece, 0.5));
    }
    EXPECT_NEAR(length, 8.0 + 2.0 * kPi, 1e-12);
    EXPECT_NEAR(turn, -2.0 * kPi, 1e-12);
  }
}

TEST(DxfRoundTrip, UnitsAreKeptEvenInR12) {
  for (const char* unit : {"um", "mm", "cm", "m", "km", "in", "ft"}) {
    for (const DxfProfile profile : kProfiles) {
      Contour contour = slot();
      contour.units = unit;
      const auto drawing = parse_dxf(written(contour, profile, 1e-3).text, "slot");
      ASSERT_TRUE(drawing);
      EXPECT_EQ(drawing->units, unit);
      EXPECT_TRUE(drawing->warnings.empty());
    }
  }
}

TEST(DxfWrites, OneEntityPerSmoothPart) {
  EXPECT_EQ(written(stored("spirals_open.json"), DxfProfile::kExact, 1e-3).entities, 1u);
  EXPECT_EQ(written(stored("spirals_closed.json"), DxfProfile::kExact, 1e-3).entities, 1u);
  // before the corner two parts of one arc, after it a spline
  EXPECT_EQ(written(stored("spirals_corner.json"), DxfProfile::kExact, 1e-3).entities, 2u);
  EXPECT_EQ(written(stored("spirals_corner.json"), DxfProfile::kCubic, 1e-3).entities, 2u);
  EXPECT_EQ(written(stored("spirals_corner.json"), DxfProfile::kArcs, 1e-3).entities, 1u);
}

TEST(DxfWrites, AClosedContourOfOneCornerFromThatCornerAround) {
  // a drop: three quarters of a circle and two lines that meet at a right angle, the seam on the
  // circle
  const ArcPiece first = arc_from({1, 0}, 0.5 * kPi, 1.0, 0.75 * kPi);
  const Vec2 tip{-std::sqrt(2.0), 0.0};
  const LinePiece down{first.end, tip};
  const Vec2 below{first.end.x, -first.end.y};
  const LinePiece back{tip, below};
  const ArcPiece second = arc_from(below, -0.25 * kPi, 1.0, 0.75 * kPi);
  Contour drop = of_pieces({first, down, back, second}, true);
  drop.pieces[3] = ArcPiece{below, {1, 0}, -0.25 * kPi, 1.0, 0.75 * kPi};
  drop.joints[2].leaving = drop.joints[2].element;
  drop.joints[2].element.theta = heading(tip - first.end);
  const DxfText dxf = written(drop, DxfProfile::kCubic, 1e-4);
  EXPECT_EQ(dxf.entities, 1u);
  const auto drawing = parse_dxf(dxf.text, "drop");
  ASSERT_TRUE(drawing);
  ASSERT_EQ(drawing->curves.size(), 1u);
  EXPECT_TRUE(drawing->curves[0].closed);
  EXPECT_LE(norm(start_point(drawing->curves[0].pieces[0]) - tip), 1e-12);
  EXPECT_LE(largest_distance(drawing->curves[0].pieces, drop.pieces), 1e-4);
}

TEST(DxfWrites, AWholeCircle) {
  const ArcPiece whole{{2, 0}, {2, 0}, 0.5 * kPi, 0.5, 4.0 * kPi};
  for (const DxfProfile profile : {DxfProfile::kExact, DxfProfile::kArcs}) {
    const auto drawing = parse_dxf(written(of_pieces({whole}, true), profile, 1e-3).text, "o");
    ASSERT_TRUE(drawing) << to_line(drawing.error());
    ASSERT_EQ(drawing->curves.size(), 1u);
    double length = 0.0;
    for (const Piece& piece : drawing->curves[0].pieces) length += arc_length(piece, 1e-12);
    EXPECT_NEAR(length, 4.0 * kPi, 1e-11);
  }
}

TEST(DxfWrites, ArcsThatAreNearlyStraightWithoutLoss) {
  // radius 1e9: a centre would cost 1e-7
  const Contour contour = of_pieces({arc_from({0, 0}, 0.3, 1e-9, 5.0)}, false);
  const auto drawing = parse_dxf(written(contour, DxfProfile::kExact, 1e-3).text, "flat");
  ASSERT_TRUE(drawing);
  ASSERT_EQ(drawing->curves.size(), 1u);
  EXPECT_LE(largest_distance(contour.pieces, drawing->curves[0].pieces), 1e-14);
}

TEST(DxfWrites, ConicsAsEllipsesAndNearParabolasAsSplines) {
  const DxfText ellipses = written(stored("conics_open.json"), DxfProfile::kExact, 1e-3);
  EXPECT_EQ(ellipses.entities, stored("conics_open.json").pieces.size());
  EXPECT_THAT(ellipses.text, testing::HasSubstr("AcDbEllipse"));
  RationalBezier conic;
  conic.degree = 2;
  conic.offset = {Vec2{0, 0}, Vec2{1, 0}, Vec2{3, 1}};
  conic.weight = {1.0, 1.0 - 1e-12, 1.0};
  const DxfText spline = written(of_pieces({conic}, false), DxfProfile::kExact, 1e-3);
  EXPECT_THAT(spline.text, testing::HasSubstr("AcDbSpline"));
}

TEST(DxfWrites, LayersUnderNamesThatAllVersionsTake) {
  auto dxf = dxf_text(slot(), {DxfProfile::kArcsR12, 1e-3, "a|b\n  0\nEOF"});
  ASSERT_TRUE(dxf);
  EXPECT_THAT(dxf->text, testing::HasSubstr("  8\na_b___0_EOF\n"));
}

TEST(DxfWrites, NothingWithoutATolerancePiecesOrNumbers) {
  EXPECT_EQ(dxf_text(slot(), {DxfProfile::kArcs, 0.0, "0"}).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(dxf_text(slot(), {DxfProfile::kArcs, NAN, "0"}).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(dxf_text(Contour{}).error().code, ErrorCode::kNothingThere);
  Contour broken = slot();
  broken.pieces[2] = LinePiece{{4, 0}, {0, NAN}};
  EXPECT_EQ(dxf_text(broken).error().code, ErrorCode::kNotFinite);
  broken.pieces[2] = LinePiece{{4, 0}, {HUGE_VAL, 0}};
  EXPECT_EQ(dxf_text(broken).error().code, ErrorCode::kNotFinite);
}

}  // namespace
}  // namespace obvid
