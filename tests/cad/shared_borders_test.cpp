// SPDX-License-Identifier: Apache-2.0
// One question, five answers: which borders do patches share? Check, mesh, page, tool path and CAD
// file say the same of one model, and change their minds at the same distance.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "../../src/toolpath/drop_field.h"
#include "faces_fixture.h"
#include "obvid/mesh/mesh.h"
#include "obvid/picture/internal/surface_page.h"
#include "obvid/surface/internal/topology.h"
#include "obvid/surface_builders/internal/check.h"

namespace obvid {
namespace {

constexpr double kChord = 1e-3;

/// A strip along y beside the parabola (4t, from, 4t (1 - t) + up), t = cs / (1 - s + cs).
NurbsSurface strip(double from, double to, double c, double up) {
  NurbsSurface out{2, 1, {0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}, {}, {}};
  for (const double y : {from, to}) {
    for (const Vec3 p : {Vec3{0, y, up}, {2, y, 2 + up}, {4, y, up}}) out.points.push_back(p);
    if (c != 1.0) out.weights.insert(out.weights.end(), {1.0, c, c * c});
  }
  return out;
}

NurbsSurface at(NurbsSurface surface, Vec3 place) {
  for (Vec3& p : surface.points) p = p + place;
  return surface;
}

/// Two strips that share a parabola at different pace, up to a gap; beside them a tube with a
/// pointed hat: two seams, a circle that runs the other way in the hat, and a pole.
SurfaceModel strips_and_tube(double gap = 0.0) {
  const Vec3 aside{10, 0, 0};
  return {"fixture",
          "mm",
          {{"strip", strip(0, -3, 1.0, 0.0)},
           {"other strip", strip(0, 3, 2.5, gap)},
           {"tube", at(turned_about_z(straight({1, 0, 0}, {1, 0, 2})), aside)},
           {"hat", at(transposed(turned_about_z(straight({1, 0, 2}, {0, 0, 3}))), aside)}}};
}

/// Length of the parabola: 4 times the integral of sqrt(1 + (1 - 2t)^2) over [0, 1].
const double kParabola = 2.0 * (std::numbers::sqrt2 + std::asinh(1.0));
/// Sides of the strips but the common one, and the tube's lower end.
const double kFreeLength = 2.0 * kParabola + 4.0 * 3.0 + 2.0 * std::numbers::pi;

/// What each of those who look at borders makes of a model.
struct Borders {
  std::size_t edges = 0, points = 0, other_parameters = 0;  // topology
  std::size_t joints = 0, free = 0;                         // check, of those that it calls shared
  double open_in_mesh = 0.0, open_to_cutter = 0.0;          // lengths
  std::size_t drawn = 0;                                    // page
};

std::vector<Mesh> meshes_of(const SurfaceModel& model) {
  const auto meshes = tessellate(model, {kChord, 10.0});
  EXPECT_TRUE(meshes) << to_line(meshes.error());
  return meshes.value_or(std::vector<Mesh>{});
}

/// Length of the edges at which one triangle of all meshes ends and no other.
double open_length(const std::vector<Mesh>& meshes) {
  double length = 0.0;
  std::vector<std::array<Vec3, 2>> edges;
  for (const Mesh& mesh : meshes) {
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        edges.push_back({mesh.vertices[t[k]].point, mesh.vertices[t[(k + 1) % 3]].point});
      }
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    bool alone = true;
    for (std::size_t k = 0; k < edges.size() && alone; ++k) {
      const bool same = (edges[k][0] == edges[i][0] && edges[k][1] == edges[i][1]) ||
                        (edges[k][0] == edges[i][1] && edges[k][1] == edges[i][0]);
      alone = k == i || !same;
    }
    if (alone) length += norm(edges[i][1] - edges[i][0]);
  }
  return length;
}

/// Length of the sides that the cutter rolls over.
double open_to_cutter(const std::vector<Mesh>& meshes) {
  double length = 0.0;
  const toolpath::DropField field(meshes, 1);
  for (const toolpath::FieldTriangle& t : field.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((t.open >> (1 + k)) & 1U) length += norm(t.corners[(k + 1) % 3] - t.corners[k]);
    }
  }
  return length;
}

/// Borders that a page draws as edges: in its header `"borders":[1,0,1,1]` of each patch.
std::size_t drawn_by_page(const SurfaceModel& model, const std::vector<Mesh>& meshes) {
  const auto page = surface_page(model, meshes);
  EXPECT_TRUE(page) << to_line(page.error());
  std::size_t drawn = 0, patches = 0;
  const std::string mark = "\"borders\":[";
  for (std::size_t i = page->find(mark); i != std::string::npos; i = page->find(mark, i + 1)) {
    ++patches;
    for (std::size_t k = i + mark.size(); (*page)[k] != ']'; ++k) drawn += (*page)[k] == '1';
  }
  EXPECT_EQ(patches, model.patches.size());
  return drawn;
}

Borders seen(const SurfaceModel& model) {
  Borders out;
  for (const TopologyEdge& edge : topology_of(model).edges) {
    ++(edge.point ? out.points : out.edges);
    for (const EdgeUse& use : edge.uses) out.other_parameters += use.other_parameters ? 1 : 0;
  }
  const auto check = check_surface(model);
  EXPECT_TRUE(check);
  for (const JointReport& joint : check->joints) out.joints += joint.shared ? 1 : 0;
  out.free = check->free_borders + check->apart_borders;
  const std::vector<Mesh> meshes = meshes_of(model);
  out.open_in_mesh = open_length(meshes);
  out.open_to_cutter = open_to_cutter(meshes);
  out.drawn = drawn_by_page(model, meshes);
  return out;
}

TEST(SharedBorders, CheckMeshPageAndToolPathAgreeWithTheTopology) {
  const SurfaceModel model = strips_and_tube();
  const Borders found = seen(model);
  EXPECT_EQ(found.edges, 11U);  // 16 sides: 1 point, 2 seams and 2 common borders count once
  EXPECT_EQ(found.points, 1U);
  EXPECT_EQ(found.other_parameters, 1U);
  EXPECT_EQ(found.joints, 4U);  // two seams, the parabola, the circle
  EXPECT_EQ(found.free, 7U);
  EXPECT_NEAR(found.open_in_mesh, kFreeLength, 20 * kChord);
  EXPECT_NEAR(found.open_to_cutter, kFreeLength, 20 * kChord);
  EXPECT_EQ(found.drawn, 16U - 1U - 2U * 2U);  // neither the point nor smooth seams
}

TEST(SharedBorders, AllChangeTheirMindsAtTheSameDistance) {
  const double limit = kSameBorder * size_of(strips_and_tube());
  for (const double part : {0.9, 1.1}) {
    const bool same = part < 1.0;
    const SurfaceModel model = strips_and_tube(part * limit);
    const Borders found = seen(model);
    EXPECT_EQ(found.edges, same ? 11U : 12U) << part;
    EXPECT_EQ(found.joints, same ? 4U : 3U) << part;
    EXPECT_EQ(found.free, same ? 7U : 9U) << part;
    const double open = kFreeLength + (same ? 0.0 : 2.0 * kParabola);
    EXPECT_NEAR(found.open_in_mesh, open, 20 * kChord) << part;
    EXPECT_NEAR(found.open_to_cutter, open, 20 * kChord) << part;
    // the gap itself is reported in either case
    const auto check = check_surface(model);
    ASSERT_EQ(check->joints.size(), 4U) << part;
    EXPECT_NEAR(check->joints[0].gap, part * limit, 1e-3 * limit) << part;
    EXPECT_EQ(check->joints[0].shared, same) << part;
  }
}

TEST_F(FaceFiles, TheFileOfTheSameModelHasTheSameEdges) {
  const double limit = kSameBorder * size_of(strips_and_tube());
  for (const double part : {0.0, 0.9, 1.1}) {
    const auto text = cad_surface_text(strips_and_tube(part * limit), {});
    ASSERT_TRUE(text) << to_line(text.error());
    EXPECT_EQ(count_of(*text, "= EDGE_CURVE("), part < 1.0 ? 11U : 12U) << part;
    // tube and hat are one shell, the strips are another or one face each
    EXPECT_EQ(count_of(*text, "= OPEN_SHELL("), part < 1.0 ? 2U : 3U) << part;
  }
}

TEST_F(FaceFiles, BordersAtTheirOwnPaceComeBackAsTheyWere) {
  for (const CadFormat format : kAllCadFormats) {
    const SurfaceModel model = strips_and_tube();
    const auto read = read_cad_surfaces(written(model, format).string());
    ASSERT_TRUE(read) << to_line(read.error());
    EXPECT_EQ(read->model.patches.size(), 4U);
    if (format == CadFormat::kIges) continue;  // knows no shells
    EXPECT_EQ(seen(read->model).edges, 11U);
  }
}

}  // namespace
}  // namespace obvid
