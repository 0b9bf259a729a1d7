// SPDX-License-Identifier: Apache-2.0
// How patches hang together in a file: shared borders, seams, creases, which side is outside.
#include <gtest/gtest.h>

#include <string>

#include "faces_fixture.h"

namespace obvid {
namespace {

/// What stands in a STEP file.
struct Counts {
  std::size_t edges = 0, vertices = 0, shells = 0, solids = 0;
};
Counts counts_in_step(const SurfaceModel& model) {
  const auto text = cad_surface_text(model, {});
  EXPECT_TRUE(text) << to_line(text.error());
  if (!text) return {};
  return {count_of(*text, "= EDGE_CURVE("), count_of(*text, "= VERTEX_POINT("),
          count_of(*text, "= OPEN_SHELL("), count_of(*text, "= MANIFOLD_SOLID_BREP(")};
}

TEST_F(FaceFiles, ThreePatchesOnOneLineShareItTwoByTwo) {
  const Vec3 a{0, 0, 0}, b{0, 0, 5};
  SurfaceModel model{"fan", "mm", {}};
  for (const Vec3 p : {Vec3{4, 0, 0}, Vec3{-2, 3, 0}, Vec3{-2, -3, 0}}) {
    model.patches.push_back({"wing", bilinear(a, a + p, b, b + p)});
  }
  const Counts counts = counts_in_step(model);
  EXPECT_EQ(counts.edges, 11U);  // 12 sides, two of them the same
  EXPECT_EQ(counts.shells, 2U);
}

TEST_F(FaceFiles, AMoebiusStripStaysOpenAtOneJoint) {
  // three flat pieces; the third turns the strip over
  const Vec3 a0{4, 0, -1}, a1{4, 0, 1}, b0{-2, 3, -1}, b1{-2, 3, 1}, c0{-2, -3, -1}, c1{-2, -3, 1};
  const SurfaceModel model{"strip",
                           "mm",
                           {{"1", bilinear(a0, b0, a1, b1)},
                            {"2", bilinear(b0, c0, b1, c1)},
                            {"3", bilinear(c0, a1, c1, a0)}}};
  const Counts counts = counts_in_step(model);
  EXPECT_EQ(counts.edges, 10U);  // 12 sides, two joints
  EXPECT_EQ(counts.solids, 0U);
  EXPECT_EQ(read_cad_surfaces(written(model, CadFormat::kBrep).string())->model.patches.size(), 3U);
}

TEST_F(FaceFiles, BordersOfOtherDegreesAndKnotsAreOneWhereTheyAreTheSame) {
  const NurbsSurface low = bilinear({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {4, 3, 0});
  const NurbsSurface high = with_knots_u(
      with_degrees(bilinear({4, 0, 0}, {0, 0, 0}, {4, 0, 2}, {0, 0, 2}), 4, 2), {0.3, 0.3, 0.7});
  EXPECT_EQ(counts_in_step({"two", "mm", {{"low", low}, {"high", high}}}).edges, 7U);
  NurbsSurface off = high;  // by more than 1e-7 of the size
  for (Vec3& p : off.points) p.y += 1e-6;
  EXPECT_EQ(counts_in_step({"two", "mm", {{"low", low}, {"off", off}}}).edges, 8U);
}

TEST_F(FaceFiles, ATriangularPatchHasThreeEdges) {
  const NurbsSurface triangle = bilinear({0, 0, 0}, {4, 0, 0}, {2, 3, 1}, {2, 3, 1});
  const Counts counts = counts_in_step({"triangle", "mm", {{"sail", triangle}}});
  EXPECT_EQ(counts.edges, 3U);
  EXPECT_EQ(counts.vertices, 3U);
}

TEST_F(FaceFiles, ASphereSeenFromInsideIsWrittenWithItsNormalOutwards) {
  SurfaceModel model = sphere_model().model;
  for (const bool turned : {false, true}) {
    if (turned) model.patches[0].surface = reversed_u(model.patches[0].surface);
    const auto read = read_cad_surfaces(written(model, CadFormat::kBrep).string());
    ASSERT_TRUE(read);
    const SurfaceJet at = evaluate(read->model.patches.at(0).surface, 0.3, 0.4);
    EXPECT_GT(dot(cross(at.du, at.dv), at.point), 0.0) << turned;
  }
}

TEST_F(FaceFiles, PatchesFarFromTheOriginStillMeet) {
  SurfaceModel model = box_model().model;
  for (SurfacePatch& patch : model.patches) {
    for (Vec3& p : patch.surface.points) p = p + Vec3{1e6 / 3.0, -1e6 / 7.0, 1e5};
  }
  EXPECT_EQ(counts_in_step(model).edges, 12U);
  EXPECT_EQ(counts_in_step(model).solids, 1U);
}

TEST_F(FaceFiles, ACreaseCutsAPatchIntoNamedParts) {
  const auto read = read_cad_surfaces(written(roof_model().model, CadFormat::kStepAp214).string());
  ASSERT_TRUE(read) << to_line(read.error());
  ASSERT_EQ(read->model.patches.size(), 2U);
  EXPECT_EQ(read->model.patches[0].name, "roof, part 1 of 2");
  EXPECT_EQ(read->model.patches[1].name, "roof, part 2 of 2");
  for (const double part : {0.0, 0.4, 1.0}) {  // the line where they meet: x = 3, z = 4
    const Vec3 ridge = evaluate(read->model.patches[0].surface, 0.5, part).point;
    EXPECT_NEAR(norm(ridge - Vec3{3, 7.0 * part, 4}), 0.0, 1e-12);
  }
}

TEST_F(FaceFiles, CreasesBothWaysCutInFour) {
  NurbsSurface tent{1, 1, {0, 0, 0.5, 1, 1}, {0, 0, 0.5, 1, 1}, {}, {}};
  for (int k = 0; k < 9; ++k) {
    const double x = k % 3, y = k / 3;
    tent.points.push_back({x, y, k == 4 ? 1.0 : 0.0});
  }
  const SurfaceModel model{"tent", "mm", {{"tent", tent}}};
  const auto read = read_cad_surfaces(written(model, CadFormat::kBrep).string());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->model.patches.size(), 4U);
}

}  // namespace
}  // namespace obvid
