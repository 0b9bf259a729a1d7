// SPDX-License-Identifier: Apache-2.0
// Faces read by FreeCAD, a program of other people: valid, as many, of the same area, the same
// points.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "../common/programs.h"
#include "../common/shared_data.h"
#include "built_cad.h"
#include "faces_models.h"
#include "obvid/cad/internal/cad.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

struct FaceVerdict {
  int valid = 0;
  std::string kind;
  std::size_t faces = 0, open_edges = 0;
  double area = 0.0, volume = 0.0, distance = 1.0;
  Vec3 low, high;
};

struct FileEnding {
  CadFormat format;
  const char* ending;
};
constexpr FileEnding kFreecadFormats[] = {{CadFormat::kStepAp214, ".step"},
                                          {CadFormat::kStepAp242, ".stp"},
                                          {CadFormat::kIges, ".igs"},
                                          {CadFormat::kBrep, ".brep"}};

/// Points all over the patches, none of them a pole.
std::string patch_points_json(const SurfaceModel& model, double scale) {
  constexpr int kEach = 5;
  std::ostringstream out;
  out.precision(17);
  const char* comma = "";
  for (const SurfacePatch& patch : model.patches) {
    for (int k = 0; k < kEach * kEach; ++k) {
      const double u = domain_u(patch.surface).at((k % kEach + 0.37) / kEach);
      const double v = domain_v(patch.surface).at((k / kEach + 0.61) / kEach);
      const Vec3 p = scale * evaluate(patch.surface, u, v).point;
      out << comma << "[" << p.x << ", " << p.y << ", " << p.z << "]";
      comma = ", ";
    }
  }
  return out.str();
}

class FacesInFreecad : public testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_PROGRAM("freecadcmd");
    if (kCadIsMissing) GTEST_SKIP() << kCadMissing;
    std::string pattern = (fs::temp_directory_path() / "obvid-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  void write(const SurfaceModel& model, const FileEnding& format, double millimetres) {
    CadWriteOptions options;
    options.format = format.format;
    const auto text = cad_surface_text(model, options);
    ASSERT_TRUE(text) << model.name << format.ending << to_line(text.error());
    const fs::path file = folder_ / (model.name + format.ending);
    std::ofstream(file, std::ios::binary) << *text;
    add(file, model, format.format == CadFormat::kBrep ? 1.0 : millimetres);
  }

  /// A file to be judged, with points that lie on its faces.
  void add(const fs::path& file, const SurfaceModel& model, double scale) {
    job_ << (written_++ > 0 ? ",\n" : "[") << "{\"file\": \"" << file.string()
         << "\", \"size\": " << scale * size_of(model) << ", \"points\": ["
         << patch_points_json(model, scale) << "]}";
  }

  std::map<std::string, FaceVerdict> judged() {
    const fs::path list = folder_ / "judge.json";
    std::ofstream(list) << job_.str() << "]";
    const std::string out =
        output_of("HOME=" + folder_.string() + " OBVID_JUDGE=" + list.string() + " freecadcmd " +
                  OBVID_SOURCE_DIR + "/tests/cad/freecad_faces_judge.py 2>&1 </dev/null");
    EXPECT_NE(out.find("JUDGE DONE"), std::string::npos) << out;
    std::map<std::string, FaceVerdict> verdicts;
    std::istringstream lines(out);
    std::string word, name;
    while (lines >> word) {
      if (word != "JUDGED") continue;
      FaceVerdict v;
      lines >> name >> v.valid >> v.kind >> v.faces >> v.open_edges >> v.area >> v.volume >>
          v.distance >> v.low.x >> v.low.y >> v.low.z >> v.high.x >> v.high.y >> v.high.z;
      verdicts[name] = v;
      std::printf("%-16s valid %d %-9s %2zu faces, %2zu open edges, area %.12g, volume %.12g, %g\n",
                  name.c_str(), v.valid, v.kind.c_str(), v.faces, v.open_edges, v.area, v.volume,
                  v.distance);
    }
    EXPECT_EQ(verdicts.size(), written_);
    return verdicts;
  }

  fs::path folder_;
  std::ostringstream job_;
  std::size_t written_ = 0;
};

/// The box that FreeCAD finds holds our points, and is not larger than that of the control points.
void expect_around(const FaceVerdict& v, const SurfaceModel& model, const std::string& name) {
  const double room = 1e-6 * size_of(model);  // FreeCAD widens boxes by tolerances
  for (const SurfacePatch& patch : model.patches) {
    const std::vector<double> us = {domain_u(patch.surface).from, domain_u(patch.surface).at(0.3),
                                    domain_u(patch.surface).to};
    const std::vector<double> vs = {domain_v(patch.surface).from, domain_v(patch.surface).at(0.6),
                                    domain_v(patch.surface).to};
    for (const SurfacePoint& p : evaluate_raster(patch.surface, us, vs)) {
      EXPECT_GE(p.point.x, v.low.x - room) << name;
      EXPECT_GE(p.point.y, v.low.y - room) << name;
      EXPECT_GE(p.point.z, v.low.z - room) << name;
      EXPECT_LE(p.point.x, v.high.x + room) << name;
      EXPECT_LE(p.point.y, v.high.y + room) << name;
      EXPECT_LE(p.point.z, v.high.z + room) << name;
    }
  }
  EXPECT_LE(norm(v.high - v.low), 1.001 * size_of(model)) << name;
}

TEST_F(FacesInFreecad, EveryPatchIsAValidFaceInEveryFormat) {
  const std::vector<KnownModel> models = known_models();
  for (const KnownModel& one : models) {
    for (const FileEnding& format : kFreecadFormats) write(one.model, format, 1.0);
  }
  const auto verdicts = judged();
  for (const KnownModel& one : models) {
    for (const FileEnding& format : kFreecadFormats) {
      const std::string name = one.model.name + format.ending;
      ASSERT_EQ(verdicts.count(name), 1U) << name;
      const FaceVerdict& v = verdicts.at(name);
      EXPECT_EQ(v.valid, 1) << name;
      EXPECT_EQ(v.faces, one.faces) << name;
      EXPECT_LE(v.distance, 1e-9) << name;
      if (one.area > 0.0) {
        EXPECT_NEAR(v.area, one.area, 1e-8 * one.area) << name;
      }
      expect_around(v, one.model, name);
      if (format.format == CadFormat::kIges) continue;  // faces only
      // STEP has no lone faces
      const bool face = one.kind == "Face" && format.format != CadFormat::kBrep;
      EXPECT_EQ(v.kind, face ? "Shell" : one.kind) << name;
      EXPECT_EQ(v.open_edges, one.open_edges) << name;
      // FreeCAD's volumes of rational bodies are a few parts in a thousand off; normals inwards
      // would make them negative
      EXPECT_NEAR(v.volume, one.volume, 5e-3 * one.volume) << name;
    }
  }
}

TEST_F(FacesInFreecad, UnitsKeepTheLengths) {
  const std::pair<const char*, double> units[] = {{"m", 1000.0}, {"in", 25.4}, {"cm", 10.0}};
  for (const auto& [unit, millimetres] : units) {
    KnownModel one = torus_model();
    one.model.name = unit;
    one.model.units = unit;
    for (const FileEnding& format : kFreecadFormats) write(one.model, format, millimetres);
  }
  for (const auto& [name, v] : judged()) {
    EXPECT_EQ(v.valid, 1) << name;
    EXPECT_LE(v.distance, 1e-9) << name;
  }
}

/// Planes, cylinders, spheres and tori of files that other systems wrote.
TEST_F(FacesInFreecad, FacesReadFromPublicFilesLieOnTheirs) {
  SKIP_WITHOUT("cad_iges_step");
  const auto folder = shared_data() / "cad_iges_step";
  for (const char* name :
       {"stepcode_HEAD_BACK.stp", "stepcode_TAIL_TURBINE.stp", "pythonocc_splinecage.stp",
        "pygem_test_pipe.step", "pythonocc_surf114.igs", "occt_wing.brep"}) {
    const auto read = read_cad_surfaces((folder / name).string());
    ASSERT_TRUE(read) << name << to_line(read.error());
    add(folder / name, read->model, 1.0);
  }
  for (const auto& [name, v] : judged()) EXPECT_LE(v.distance, 1e-9) << name;
}

/// Distance of a point from the shape of this name, whose equation is known.
double off(const std::string& name, Vec3 p) {
  const double r = std::hypot(p.x, p.y);
  if (name == "torus") return std::hypot(r - 10.0, p.z) - 3.0;
  if (name == "cone") return r - 4.0 + 4.0 / 3.0 * p.z;
  if (name == "cylinder" || name == "extrusion") return r - 2.0;
  return norm(p) - 5.0;
}

TEST_F(FacesInFreecad, FacesOfAllKindsAreReadAsTheyAre) {
  const std::string out =
      output_of("HOME=" + folder_.string() + " OBVID_MAKE=" + folder_.string() + " freecadcmd " +
                OBVID_SOURCE_DIR + "/tests/cad/freecad_faces_make.py 2>&1 </dev/null");
  ASSERT_NE(out.find("MADE ALL"), std::string::npos) << out;
  for (const std::string name :
       {"sphere", "torus", "cone", "cylinder", "extrusion", "revolution", "offset"}) {
    for (const char* ending : {".step", ".brep", ".igs"}) {
      const bool offset = name == "offset", iges = std::string(ending) == ".igs";
      if (offset && iges) continue;  // known limit: the kernel refuses its parameters
      const auto read = read_cad_surfaces((folder_ / (name + ending)).string());
      ASSERT_TRUE(read) << name << ending << to_line(read.error());
      double worst = 0.0;
      for (const SurfacePatch& patch : read->model.patches) {
        for (int k = 0; k < 100; ++k) {
          const double u = domain_u(patch.surface).at((k % 10 + 0.5) / 10.0);
          const double v = domain_v(patch.surface).at((k / 10 + 0.5) / 10.0);
          worst = std::max(worst, std::abs(off(name, evaluate(patch.surface, u, v).point)));
        }
      }
      std::printf("%-10s %-5s %zu patches, %zu warnings, %g\n", name.c_str(), ending,
                  read->model.patches.size(), read->warnings.size(), worst);
      // FreeCAD writes 9 digits behind the point into IGES and 15 characters into STEP files
      EXPECT_LE(worst, offset ? 1e-5 : iges ? 1e-9 : 1e-11) << name << ending;
      EXPECT_EQ(read->model.patches.size(), 1U) << name << ending;
      EXPECT_EQ(read->warnings.empty(), !offset) << name << ending;
    }
  }
}

}  // namespace
}  // namespace obvid
