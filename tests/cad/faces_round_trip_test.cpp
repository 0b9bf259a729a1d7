// SPDX-License-Identifier: Apache-2.0
// Faces written, and read by a process that never wrote one: the same surfaces, names and units.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>

#include "../common/programs.h"
#include "../common/shared_data.h"
#include "../common/text.h"
#include "faces_fixture.h"
#include "obvid/cad/internal/cad.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFacesFile = "OBVID_TEST_FACES_FILE";
constexpr const char* kModel = "OBVID_TEST_FACES_MODEL";
constexpr const char* kUnits = "OBVID_TEST_FACES_UNITS";

double millimetres(const std::string& units) {
  return units == "m" ? 1000.0 : units == "in" ? 25.4 : 1.0;
}

SurfaceModel model_named(const std::string& name) {
  for (KnownModel& one : known_models()) {
    if (one.model.name == name) return std::move(one.model);
  }
  return {};
}

/// Largest distance of two surfaces at the same parameters; with the second turned round (its u
/// backwards) if that is nearer.
double apart(const NurbsSurface& a, const NurbsSurface& b, double scale) {
  constexpr int kSteps = 16;
  double straight = 0.0, turned = 0.0;
  for (int k = 0; k < kSteps * kSteps; ++k) {
    const double u = (k % kSteps + 0.5) / kSteps, v = (k / kSteps + 0.5) / kSteps;
    const Vec3 p = scale * evaluate(a, domain_u(a).at(u), domain_v(a).at(v)).point;
    const double y = domain_v(b).at(v);
    straight = std::max(straight, norm(p - evaluate(b, domain_u(b).at(u), y).point));
    turned = std::max(turned, norm(p - evaluate(b, domain_u(b).at(1.0 - u), y).point));
  }
  return std::min(straight, turned);
}

const SurfacePatch& nearest(const NurbsSurface& surface, const SurfaceModel& model, double scale) {
  std::size_t best = 0;
  double least = apart(surface, model.patches.front().surface, scale);
  for (std::size_t i = 1; i < model.patches.size(); ++i) {
    const double distance = apart(surface, model.patches[i].surface, scale);
    if (distance < least) std::tie(best, least) = std::tuple(i, distance);
  }
  return model.patches[best];
}

/// Runs in the fresh process only; the tests below start it with the name of the file.
TEST(FaceReader, FindsTheSurfacesOfAnotherProcess) {
  const char *file = std::getenv(kFacesFile), *name = std::getenv(kModel),
             *units = std::getenv(kUnits);
  if (file == nullptr || name == nullptr || units == nullptr) {
    GTEST_SKIP() << "the next tests start this one";
  }
  const SurfaceModel expected = model_named(name);
  const auto read = read_cad_surfaces(file);
  ASSERT_TRUE(read) << to_line(read.error());
  EXPECT_TRUE(read->warnings.empty()) << read->warnings.front();
  const bool states_unit = fs::path(file).extension() != ".brep";
  EXPECT_EQ(read->model.units, Units("mm", states_unit ? UnitSource::kFile : UnitSource::kAssumed));
  ASSERT_EQ(read->model.patches.size(), expected.patches.size());
  const double scale = fs::path(file).extension() == ".brep" ? 1.0 : millimetres(units);
  const double limit = 1e-9 * scale * size_of(expected);
  const std::string ending = fs::path(file).extension().string();
  std::set<std::string> names;
  for (const SurfacePatch& patch : expected.patches) {
    const SurfacePatch& found = nearest(patch.surface, read->model, scale);  // shells come in turn
    const NurbsSurface &a = patch.surface, &b = found.surface;
    EXPECT_EQ(a.degree_u, b.degree_u) << patch.name;
    EXPECT_EQ(a.degree_v, b.degree_v) << patch.name;
    EXPECT_EQ(a.points.size(), b.points.size()) << patch.name;
    EXPECT_EQ(a.weights.empty(), b.weights.empty()) << patch.name;
    EXPECT_LE(apart(a, b, scale), limit) << patch.name;
    if (ending == ".igs") {  // eight characters, and faces of one name are told apart
      EXPECT_EQ(found.name.substr(0, found.name.find(", face ")), patch.name.substr(0, 8));
      names.insert(found.name);
    } else if (ending == ".step") {
      EXPECT_EQ(found.name, patch.name);
    }
  }
  if (ending == ".igs") {
    EXPECT_EQ(names.size(), expected.patches.size());
  }
}

/// Whether a new process reads the model out of the file.
void expect_found(const fs::path& file, const SurfaceModel& model) {
  std::ostringstream command;
  command << kFacesFile << "='" << file.string() << "' " << kModel << "=" << model.name << " "
          << kUnits << "=" << model.units.name << " " << fs::read_symlink("/proc/self/exe").string()
          << " --gtest_filter=FaceReader.* 2>&1 </dev/null";
  const auto [out, status] = ran(command.str());
  EXPECT_EQ(status, 0) << file.filename() << "\n" << out;
  EXPECT_NE(out.find("[  PASSED  ] 1 test"), std::string::npos) << out;
}

TEST_F(FaceFiles, EveryFormatKeepsTheSurfacesAndTheirNames) {
  int models = 0;
  for (const KnownModel& one : known_models()) {
    if (one.faces != one.model.patches.size()) continue;  // cut at creases: the next test
    ++models;
    for (const CadFormat format : kAllCadFormats)
      expect_found(written(one.model, format), one.model);
  }
  EXPECT_GE(models, 7);
}

TEST_F(FaceFiles, UnitsKeepTheLengths) {
  for (const char* units : {"m", "in"}) {
    SurfaceModel model = sphere_model().model;
    model.units = units;
    for (const CadFormat format : kAllCadFormats) expect_found(written(model, format), model);
  }
  SurfaceModel model = plane_model().model;
  model.units = "furlong";
  const auto refused = cad_surface_text(model, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadOption);
}

TEST_F(FaceFiles, TheSameModelGivesTheSameBytes) {
  for (const KnownModel& one : {sphere_model(), box_model()}) {
    for (const CadFormat format : kAllCadFormats) {
      CadWriteOptions options;
      options.format = format;
      const auto a = cad_surface_text(one.model, options), b = cad_surface_text(one.model, options);
      ASSERT_TRUE(a && b);
      EXPECT_TRUE(*a == *b) << one.model.name;
    }
  }
}

TEST_F(FaceFiles, StepHasOneSplineSurfaceForEachPatch) {
  for (const KnownModel& one : known_models()) {
    if (one.faces != one.model.patches.size()) continue;
    const auto text = cad_surface_text(one.model, {});
    ASSERT_TRUE(text);
    EXPECT_EQ(count_of(*text, "B_SPLINE_SURFACE_WITH_KNOTS("), one.faces) << one.model.name;
    EXPECT_EQ(count_of(*text, "ADVANCED_FACE("), one.faces) << one.model.name;
    if (one.kind == "Solid") {
      EXPECT_EQ(count_of(*text, "MANIFOLD_SOLID_BREP("), 1U) << one.model.name;
    }
  }
}

TEST_F(FaceFiles, NamesSurviveWhateverTheyAreMadeOf) {
  SurfaceModel model = plane_model().model;
  for (const std::string name : {"it's", "a\\b",
                                 "Fl\xC3\xA4"
                                 "che \xE2\x88\x82",
                                 "two  words; #3 (x, $*)"}) {
    model.patches[0].name = name;
    model.name = "model " + name;
    const auto text = cad_surface_text(model, {});
    ASSERT_TRUE(text) << name;
    for (const char c : *text) EXPECT_LT(static_cast<unsigned char>(c), 128U) << name;
    const fs::path file = folder_ / "named.step";
    std::ofstream(file, std::ios::binary) << *text;
    const auto read = read_cad_surfaces(file.string());
    ASSERT_TRUE(read) << name << to_line(read.error());
    EXPECT_EQ(read->model.patches.at(0).name, name);
  }
}

TEST_F(FaceFiles, LineEndsInNamesBecomeBlanks) {
  SurfaceModel model = plane_model().model;
  model.name = "two\nlines";
  model.patches[0].name = "a\r\nb\tc";
  for (const CadFormat format : kAllCadFormats) {
    const auto read = read_cad_surfaces(written(model, format).string());
    ASSERT_TRUE(read) << to_line(read.error());
    if (format == CadFormat::kStepAp214) {
      EXPECT_EQ(read->model.patches.at(0).name, "a  b c");
    }
  }
}

TEST_F(FaceFiles, WhatIsNoSurfaceIsRefusedByName) {
  const auto empty = cad_surface_text({}, {});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::kNothingThere);
  SurfaceModel model = plane_model().model;
  model.patches[0].surface.points[2].y = std::nan("");
  const auto no_number = cad_surface_text(model, {});
  ASSERT_FALSE(no_number);
  EXPECT_EQ(no_number.error().code, ErrorCode::kNotFinite);
  EXPECT_NE(no_number.error().where.find("floor"), std::string::npos);
  model = sphere_model().model;
  model.patches[0].surface.weights[3] = -1.0;
  EXPECT_FALSE(cad_surface_text(model, {}));
  model.patches[0].surface.weights.clear();
  const std::size_t count = model.patches[0].surface.points.size();
  for (const Vec3 p : {Vec3{1, 2, 3}, Vec3{0, 0, 0}}) {  // shrunk to a point
    model.patches[0].surface.points.assign(count, p);
    const auto point = cad_surface_text(model, {});
    ASSERT_FALSE(point);
    EXPECT_EQ(point.error().code, ErrorCode::kSizeOutOfRange);
  }
  model = plane_model().model;
  model.patches[0].surface.points[3] = {1e300, 1e300, 0};
  EXPECT_FALSE(cad_surface_text(model, {}));
}

TEST_F(FaceFiles, DamagedFilesAreRefusedAndNothingCrashes) {
  for (const CadFormat format : kAllCadFormats) {
    const fs::path file = written(box_model().model, format);
    const std::string text = text_of_file(file);
    constexpr std::size_t kCuts = 12;
    for (std::size_t k = 0; k < kCuts; ++k) {
      std::ofstream(file, std::ios::binary) << text.substr(0, text.size() * k / kCuts);
      const auto read = read_cad_surfaces(file.string());
      if (!read) {
        EXPECT_FALSE(to_line(read.error()).empty());
      }
    }
  }
  EXPECT_EQ(read_cad_surfaces((folder_ / "none.step").string()).error().code,
            ErrorCode::kCannotOpen);
}

TEST_F(FaceFiles, PublicFilesAreReadOrRefusedWithAReason) {
  SKIP_WITHOUT("cad_iges_step");
  const auto folder = shared_data() / "cad_iges_step";
  int read_ones = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") continue;
    const auto read = read_cad_surfaces(entry.path().string());
    if (!read) {
      std::printf("%-28s %s\n", entry.path().filename().c_str(), to_line(read.error()).c_str());
      EXPECT_FALSE(read.error().what.empty());
      continue;
    }
    ++read_ones;
    std::printf("%-28s %zu patches, %zu warnings\n", entry.path().filename().c_str(),
                read->model.patches.size(), read->warnings.size());
    for (const SurfacePatch& patch : read->model.patches) {
      EXPECT_TRUE(check(patch.surface)) << patch.name;
    }
  }
  EXPECT_GE(read_ones, 7);
}

}  // namespace
}  // namespace obvid
