// SPDX-License-Identifier: Apache-2.0
// A tetrahedron in every form of STL, PLY and OBJ, put together here byte by byte.
#include "obvid/exchange/mesh_read.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace obvid {
namespace {

const std::array<Vec3, 4> kCorners{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
const std::array<std::array<int, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

template <class T>
void add(std::string& out, T value, bool little = true) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (little != (std::endian::native == std::endian::little)) {
    std::reverse(bytes.begin(), bytes.end());
  }
  out.append(bytes.data(), bytes.size());
}

std::string triple(Vec3 p) {
  return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
}

std::string binary_tetrahedron(const std::string& head) {
  std::string out = head;
  out.resize(80, ' ');
  add(out, std::uint32_t{4});
  for (const auto& face : kFaces) {
    for (int i = 0; i < 3; ++i) add(out, 0.0F);
    for (const int corner : face) {
      const Vec3 p = kCorners[static_cast<std::size_t>(corner)];
      for (const double c : {p.x, p.y, p.z}) add(out, static_cast<float>(c));
    }
    add(out, std::uint16_t{0});
  }
  return out;
}

std::string text_tetrahedron() {
  std::string out = "solid thing\n";
  for (const auto& face : kFaces) {
    out += "  facet normal 0 0 0\n    outer loop\n";
    for (const int corner : face) {
      out += "      vertex " + triple(kCorners[static_cast<std::size_t>(corner)]) + "\n";
    }
    out += "    endloop\n  endfacet\n";
  }
  return out + "endsolid thing\n";
}

std::string ply_head(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty uchar red\n"
         "property double y\nproperty float z\nelement face 4\nproperty list uchar int "
         "vertex_indices\nelement edge 1\nproperty int16 a\nend_header\n";
}

std::string binary_ply(bool little) {
  std::string out = ply_head(little ? "binary_little_endian" : "binary_big_endian");
  for (const Vec3 p : kCorners) {
    add(out, p.x, little);
    add(out, std::uint8_t{7}, little);
    add(out, p.y, little);
    add(out, static_cast<float>(p.z), little);
  }
  for (const auto& face : kFaces) {
    add(out, std::uint8_t{3}, little);
    for (const int corner : face) add(out, corner, little);
  }
  add(out, std::int16_t{1}, little);
  return out;
}

std::string text_ply() {
  std::string out = ply_head("ascii");
  for (const Vec3 p : kCorners) {
    out += std::to_string(p.x) + " 7 " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  for (const auto& face : kFaces) {
    out += "3";
    for (const int corner : face) out += " " + std::to_string(corner);
    out += "\n";
  }
  return out + "1\n";
}

/// Six times the volume, by the divergence theorem; 1 for the tetrahedron, looked at from outside.
double six_volumes(const TriangleMesh& mesh) {
  double out = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    out += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c]));
  }
  return out;
}

void expect_tetrahedron(const std::string& text, const std::string& name) {
  EXPECT_TRUE(is_mesh(text, name)) << name;
  const auto mesh = parse_mesh(text, name);
  ASSERT_TRUE(mesh) << name << ": " << mesh.error().what;
  EXPECT_EQ(mesh->points.size(), 4U) << name;  // shared
  EXPECT_EQ(mesh->triangles.size(), 4U) << name;
  EXPECT_DOUBLE_EQ(six_volumes(*mesh), 1.0) << name;
}

TEST(MeshRead, EveryFormIsTheSameTetrahedron) {
  expect_tetrahedron(binary_tetrahedron("binary"), "a.stl");
  expect_tetrahedron(binary_tetrahedron("solid by a system that does not know better"), "b.stl");
  expect_tetrahedron(text_tetrahedron(), "c.stl");
  expect_tetrahedron(binary_ply(true), "d.ply");
  expect_tetrahedron(binary_ply(false), "e.ply");
  expect_tetrahedron(text_ply(), "f.ply");
  expect_tetrahedron(
      "# hand\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\n"
      "f 1 3 2\nf 1/1 2/2 4/3\nf 2//1 3//1 4//1\nf -2/1/1 -4/1/1 -1/1/1\n",
      "g.obj");
}

TEST(MeshRead, PolygonsAreFansAndWhatHasNoAreaIsLeftOut) {
  const auto mesh = parse_mesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -0 0 0\nf 1 2 3 4\nf 1 5 2\n",
                               "square.obj");
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->points.size(), 4U);  // -0 is 0
  EXPECT_EQ(mesh->triangles.size(), 2U);
}

ErrorCode code_of(const std::string& text, const std::string& name) {
  const auto mesh = parse_mesh(text, name);
  return mesh ? ErrorCode::kInternal : mesh.error().code;
}

TEST(MeshRead, RefusesWhatIsDamaged) {
  EXPECT_EQ(code_of("nothing", "a.txt"), ErrorCode::kUnknownFormat);
  std::string cut = binary_tetrahedron("binary");
  cut.resize(cut.size() - 1);
  EXPECT_EQ(code_of(cut, "a.stl"), ErrorCode::kUnknownFormat);
  EXPECT_EQ(code_of("v 0 0 0\nv 1 x 0\n", "a.obj"), ErrorCode::kBadNumber);
  EXPECT_EQ(code_of("v 0 0 0\nv 1 inf 0\n", "a.obj"), ErrorCode::kNotFinite);
  EXPECT_EQ(code_of("v 0 0 0\nf 1 1 2\n", "a.obj"), ErrorCode::kBadCount);
  EXPECT_EQ(code_of("v 0 0 0\nf 1 1 0\n", "a.obj"), ErrorCode::kBadCount);
  EXPECT_EQ(code_of("v 0 0 0\n", "a.obj"), ErrorCode::kTooFewPoints);
  std::string ply = binary_ply(true);
  EXPECT_EQ(code_of(ply.substr(0, ply.size() - 3), "a.ply"), ErrorCode::kBadCount);
  EXPECT_EQ(code_of("ply\nformat ascii 1.0\nelement vertex 99999999999999\nproperty double x\n"
                    "property double y\nproperty double z\nend_header\n",
                    "a.ply"),
            ErrorCode::kBadCount);
  EXPECT_EQ(code_of("ply\nformat ascii 1.0\nproperty quad x\nend_header\n", "a.ply"),
            ErrorCode::kUnsupported);
  std::string facet = text_tetrahedron();
  facet.erase(facet.find("      vertex"),
              facet.find('\n', facet.find("      vertex")) + 1 - facet.find("      vertex"));
  EXPECT_EQ(code_of(facet, "a.stl"), ErrorCode::kBadCount);
}

TEST(MeshRead, DamagedBytesGiveAMeshOrAnError) {
  std::mt19937 random(3);
  int meshes = 0, errors = 0;
  for (const std::string& whole : {binary_tetrahedron("b"), text_tetrahedron(), binary_ply(true),
                                   binary_ply(false), text_ply()}) {
    for (int k = 0; k < 2000; ++k) {
      std::string text = whole;
      for (int i = 0; i < 3; ++i) {
        text[random() % text.size()] = static_cast<char>(random() % 256);
      }
      if (k % 3 == 0) text.resize(random() % text.size());
      const auto mesh = parse_mesh(text, "x.obj");
      ++(mesh ? meshes : errors);
      if (!mesh) continue;
      for (const auto& t : mesh->triangles) {
        for (const std::uint32_t corner : t) ASSERT_LT(corner, mesh->points.size());
      }
    }
  }
  EXPECT_GT(meshes, 100);
  EXPECT_GT(errors, 100);
}

}  // namespace
}  // namespace obvid
