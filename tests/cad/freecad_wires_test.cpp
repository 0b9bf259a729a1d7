// SPDX-License-Identifier: Apache-2.0
// STEP files of lines, arcs and whole circles, with and without faces, read by FreeCAD: one wire, a
// valid shell, lengths and areas by closed form.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "../common/drawn_files.h"
#include "../common/programs.h"
#include "obvid/exchange/internal/step/write.h"

namespace obvid {
namespace {

constexpr double kPi = std::numbers::pi;

struct WireCase {
  std::string name;
  std::vector<Piece> pieces;
  double length;  ///< units
  bool closed;
};

std::vector<WireCase> wire_cases() {
  return {{"line", {LinePiece{{0, 0}, {3, -4}}}, 5.0, false},
          {"outline",
           {LinePiece{{0, 0}, {2, 0}}, ArcPiece{{2, 0}, {3, 1}, 0.0, 1.0, 0.5 * kPi},
            ArcPiece{{3, 1}, {4, 2}, 0.5 * kPi, -1.0, 0.5 * kPi}, LinePiece{{4, 2}, {4, 7}}},
           7.0 + kPi,
           false},
          {"slot",
           {LinePiece{{0, 0}, {20, 0}}, ArcPiece{{20, 0}, {20, 10}, 0.0, 0.2, 5 * kPi},
            LinePiece{{20, 10}, {0, 10}}, ArcPiece{{0, 10}, {0, 0}, kPi, 0.2, 5 * kPi}},
           40.0 + 10.0 * kPi,
           true},
          {"rectangle",
           {LinePiece{{1, 1}, {4, 1}}, LinePiece{{4, 1}, {4, 3}}, LinePiece{{4, 3}, {1, 3}},
            LinePiece{{1, 3}, {1, 1}}},
           10.0,
           true},
          {"circle", {ArcPiece{{5, 0}, {5, 0}, -0.5 * kPi, -0.2, 10 * kPi}}, 10.0 * kPi, true},
          {"ring",
           {ArcPiece{{5, 0}, {-5, 0}, 0.5 * kPi, 0.2, 5 * kPi},
            ArcPiece{{-5, 0}, {5, 0}, -0.5 * kPi, 0.2, 5 * kPi}},
           10.0 * kPi,
           true}};
}

struct FoundShape {
  int edges = 0, wires = 0, faces = 0, shells = 0, valid = 0, free = 0;
  double length = 0.0, area = 0.0;
};

std::map<std::string, FoundShape> found_by_freecad(const std::string& files) {
  const std::string list = testing_files::file_with("files.txt", files);
  const std::string home = std::filesystem::path(list).parent_path().string();
  std::istringstream lines(output_of("HOME='" + home + "' OBVID_JUDGE='" + list + "' freecadcmd " +
                                     OBVID_SOURCE_DIR +
                                     "/tests/cad/freecad_wires_judge.py 2>&1 </dev/null"));
  std::map<std::string, FoundShape> out;
  for (std::string word, name; lines >> word;) {
    if (word != "FOUND") continue;
    FoundShape one;
    lines >> name >> one.edges >> one.wires >> one.faces >> one.shells >> one.valid >> one.length >>
        one.area >> one.free;
    out[name] = one;
  }
  return out;
}

TEST(WiresInFreecad, AreOneCurveAndTheirFacesOneShell) {
  SKIP_WITHOUT_PROGRAM("freecadcmd");
  constexpr double kWidth = 2.0, kInch = 25.4;
  std::string files;
  for (const WireCase& one : wire_cases()) {
    for (const double width : {0.0, kWidth}) {
      const StepOptions options{width > 0.0 ? StepSchema::kAp242 : StepSchema::kAp214, "in", width};
      const auto text = step_text({{one.name, one.pieces}}, options);
      ASSERT_TRUE(text) << to_line(text.error());
      files += testing_files::file_with(one.name + (width > 0.0 ? "_face.step" : ".step"), *text);
      files += "\n";
    }
  }
  auto found = found_by_freecad(files);
  for (const WireCase& one : wire_cases()) {
    const int n = static_cast<int>(one.pieces.size());
    for (const bool face : {false, true}) {
      const std::string name = one.name + (face ? "_face.step" : ".step");
      ASSERT_TRUE(found.contains(name)) << name;
      const FoundShape& shape = found[name];
      EXPECT_EQ(shape.valid, 1) << name;
      EXPECT_EQ(shape.edges, n) << name;
      EXPECT_EQ(shape.wires, n > 1 ? 1 : 0) << name;
      EXPECT_NEAR(shape.length, kInch * one.length, 1e-9 * kInch * one.length) << name;
      EXPECT_EQ(shape.faces, face ? n : 0) << name;
      EXPECT_EQ(shape.shells, face ? 1 : 0) << name;
      const double area = face ? kInch * kInch * kWidth * one.length : 0.0;
      EXPECT_NEAR(shape.area, area, 1e-9 * area) << name;
      // along the bottom and the top, and the two ends of an open one
      EXPECT_EQ(shape.free, face ? 2 * n + (one.closed ? 0 : 2) : 0) << name;
    }
  }
}

}  // namespace
}  // namespace obvid
