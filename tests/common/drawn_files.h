// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace obvid::testing_files {

/// A file of this test alone, with the text; its path.
inline std::string file_with(const std::string& name, const std::string& text) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = std::filesystem::path(::testing::TempDir()) /
                      (std::string("obvid-") + test->test_suite_name() + "-" + test->name());
  std::filesystem::create_directories(folder);
  const std::string path = (folder / name).string();
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// Entities between the least that makes a DXF file; `units`: $INSUNITS.
inline std::string dxf_of(const std::string& entities, int units = 4) {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" + std::to_string(units) +
         "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

inline std::string dxf_line(double x0, double y0, double x1, double y1) {
  const auto n = [](double v) { return std::to_string(v); };
  return "0\nLINE\n8\n0\n10\n" + n(x0) + "\n20\n" + n(y0) + "\n11\n" + n(x1) + "\n21\n" + n(y1) +
         "\n";
}

/// Counter-clockwise from one angle to the other, degrees.
inline std::string dxf_arc(double x, double y, double r, double from, double to) {
  const auto n = [](double v) { return std::to_string(v); };
  return "0\nARC\n8\n0\n10\n" + n(x) + "\n20\n" + n(y) + "\n40\n" + n(r) + "\n50\n" + n(from) +
         "\n51\n" + n(to) + "\n";
}

/// Vertices x, y, bulge.
inline std::string dxf_polyline(const std::vector<std::array<double, 3>>& vertices, bool closed) {
  std::string out = "0\nLWPOLYLINE\n8\n0\n90\n" + std::to_string(vertices.size()) + "\n70\n" +
                    (closed ? "1" : "0") + "\n";
  for (const auto& [x, y, bulge] : vertices) {
    out += "10\n" + std::to_string(x) + "\n20\n" + std::to_string(y) + "\n42\n" +
           std::to_string(bulge) + "\n";
  }
  return out;
}

inline std::string svg_of(const std::string& shapes) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"100mm\" "
         "viewBox=\"0 0 100 100\">" +
         shapes + "</svg>";
}

}  // namespace obvid::testing_files
