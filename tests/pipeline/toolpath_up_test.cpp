// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <utility>

#include "obvid/pipeline/toolpath_job.h"

namespace obvid {
namespace {

/// A plate over the axes: its control points are the corners of their box.
SurfaceModel plate() {
  SurfaceModel model;
  model.patches.push_back(
      {"plate",
       {1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {}}});
  return model;
}

TEST(UpAxis, TurnsWithoutAMirror) {
  for (const auto& [up, axis] : {std::pair{UpAxis::kX, Vec3{1, 0, 0}},
                                 {UpAxis::kY, Vec3{0, 1, 0}},
                                 {UpAxis::kZ, Vec3{0, 0, 1}},
                                 {UpAxis::kMinusX, Vec3{-1, 0, 0}},
                                 {UpAxis::kMinusY, Vec3{0, -1, 0}},
                                 {UpAxis::kMinusZ, Vec3{0, 0, -1}}}) {
    const auto p = turned_up(plate(), up).patches[0].surface.points;
    EXPECT_EQ(p[0], (Vec3{0, 0, 0}));
    const Vec3 x = p[1], y = p[2] / 2.0, z = p[3] / 3.0;
    EXPECT_EQ(cross(x, y), z) << to_string(up);  // lengths and angles of a right-handed frame
    EXPECT_EQ(dot(x, y), 0.0);
    EXPECT_EQ(norm(x), 1.0);
    EXPECT_EQ(axis.x * x + axis.y * y + axis.z * z, (Vec3{0, 0, 1})) << to_string(up);
  }
}

}  // namespace
}  // namespace obvid
