// SPDX-License-Identifier: Apache-2.0
// Skins and surfaces of revolution over public bodies, as STEP in FreeCAD: valid, all faces there,
// our points on them. What a skin promises of its sections is checked on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "../common/programs.h"
#include "../common/shared_data.h"
#include "faces_fixture.h"
#include "obvid/io/read_points.h"
#include "obvid/io/read_sections.h"
#include "obvid/pipeline/skin_sections.h"
#include "obvid/pipeline/surface_job.h"
#include "obvid/surface_builders/internal/lighten.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

std::string public_file(const std::string& path) { return (shared_data() / path).string(); }

class SkinsInFreecad : public FaceFiles {
 protected:
  void SetUp() override {
    SKIP_WITHOUT("");
    SKIP_WITHOUT_PROGRAM("freecadcmd");
    FaceFiles::SetUp();
  }

  /// A file for FreeCAD, and points that have to lie on its faces.
  void add(SurfaceModel model, const std::string& name) {
    constexpr int kEach = 4;
    model.name = name;
    const fs::path file = written(model, CadFormat::kStepAp214);
    double size = 0.0;
    job_ << (faces_.empty() ? "[" : ",\n") << "{\"file\": \"" << file.string()
         << "\", \"points\": [";
    job_.precision(17);
    const char* comma = "";
    for (const SurfacePatch& patch : model.patches) {
      size = std::max(size, size_of(patch.surface));
      for (int k = 0; k < kEach * kEach; ++k) {
        const double u = domain_u(patch.surface).at((k % kEach + 0.37) / kEach);
        const double v = domain_v(patch.surface).at((k / kEach + 0.61) / kEach);
        const Vec3 p = evaluate(patch.surface, u, v).point;
        job_ << comma << "[" << p.x << ", " << p.y << ", " << p.z << "]";
        comma = ", ";
      }
    }
    job_ << "], \"area\": false, \"size\": " << size << "}";
    faces_[name + ".step"] = model.patches.size();
  }

  void judge() {
    const fs::path list = folder_ / "judge.json";
    std::ofstream(list) << job_.str() << "]";
    const std::string out =
        output_of("HOME=" + folder_.string() + " OBVID_JUDGE=" + list.string() + " freecadcmd " +
                  OBVID_SOURCE_DIR + "/tests/cad/freecad_faces_judge.py 2>&1 </dev/null");
    ASSERT_NE(out.find("JUDGE DONE"), std::string::npos) << out;
    std::istringstream lines(out);
    std::string word, name, kind;
    std::size_t judged = 0;
    while (lines >> word) {
      if (word != "JUDGED") continue;
      int valid = 0;
      std::size_t faces = 0, open = 0;
      double area = 0.0, volume = 0.0, distance = 1.0;
      lines >> name >> valid >> kind >> faces >> open >> area >> volume >> distance;
      ++judged;
      EXPECT_EQ(valid, 1) << name;
      EXPECT_GE(faces, faces_[name]) << name;  // more where a profile has corners
      EXPECT_LE(distance, 1e-9) << name;
      std::printf("%-20s valid %d, %zu faces of %s, points within %.2g of the size\n", name.c_str(),
                  valid, faces, kind.c_str(), distance);
    }
    EXPECT_EQ(judged, faces_.size());
  }

  std::ostringstream job_;
  std::map<std::string, std::size_t> faces_;
};

/// Largest fall of curvature against its run that counts as monotone, a share of the largest
/// curvature: 1e-6 is kept on circles, the rest is where a contour's curvature steps within the
/// rounding of its joints.
constexpr double kMonotone = 1e-3;

FittedSkin checked_skin(const std::vector<std::string>& files, std::optional<double> noise,
                        const std::string& name) {
  const auto sections = read_sections(files);
  EXPECT_TRUE(sections) << name << (sections ? "" : to_line(sections.error()));
  if (!sections) return {};
  SkinJob job;
  job.sections.noise = noise;
  const auto made = fit_skin(*sections, job);
  EXPECT_TRUE(made) << name << (made ? "" : to_line(made.error()));
  if (!made) return {};
  EXPECT_EQ(made->proved + made->points, sections->size()) << name;
  double deviation = 0.0, from_points = 0.0, ripple = 0.0;
  std::size_t monotone = 0;
  for (const SkinSectionReport& section : made->skin.sections) {
    deviation = std::max(deviation, section.deviation);
    from_points = std::max(from_points, section.from_points);
    ripple = std::max(ripple, section.ripple);
    monotone += section.ripple <= kMonotone ? 1 : 0;
  }
  EXPECT_LE(deviation, made->tolerance) << name;
  // points that may move lie within their noise of the contour
  EXPECT_LE(from_points, made->tolerance + 1.01 * noise.value_or(0.0)) << name;
  const AcrossReport& across = made->skin.across;
  std::printf(
      "%-12s %zu sections, %zu proved; within %.2g of contours, %.2g of points; %zu monotone "
      "within 0.1 %%, worst %.2g; across %zu changes on %zu lines, %zu forced, %zu "
      "beyond\n",
      name.c_str(), sections->size(), made->proved, deviation, from_points, monotone, ripple,
      across.found, across.isolines, across.forced, across.beyond);
  return *made;
}

/// The same body with few control points, within a share of its size.
SurfaceModel light_of(const SurfaceModel& model, const std::string& name) {
  constexpr double kShare = 1e-4;
  const double tolerance = kShare * size_of(model);
  std::vector<NurbsSurface> exact;
  std::size_t before = 0, after = 0;
  for (const SurfacePatch& patch : model.patches) {
    exact.push_back(patch.surface);
    before += patch.surface.points.size();
  }
  const auto light = lightened(exact, tolerance);
  EXPECT_TRUE(light) << name << (light ? "" : to_line(light.error()));
  SurfaceModel out = model;
  if (!light) return out;
  EXPECT_LE(light->moved, tolerance) << name;
  double found = 0.0;
  std::string nets;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const NurbsSurface& s = out.patches[k].surface = light->surfaces[k];
    after += s.points.size();
    nets += (k > 0 ? ", " : "") + std::to_string(s.count_u()) + " x " + std::to_string(s.count_v());
    constexpr int kEach = 97;
    for (int i = 0; i <= kEach * kEach; ++i) {
      const double u = domain_u(s).at((i % kEach) / (kEach - 1.0));
      const double v = domain_v(s).at((i / kEach) / (kEach - 1.0));
      found = std::max(found, norm(evaluate(s, u, v).point - evaluate(exact[k], u, v).point));
    }
  }
  EXPECT_LE(found, light->moved) << name;
  EXPECT_LT(5 * after, before) << name;
  std::printf(
      "%-12s within 1e-4 of the size: %zu control points instead of %zu (%s), moved %.2g of "
      "the tolerance, %.2g seen\n",
      name.c_str(), after, before, nets.c_str(), light->moved / tolerance, found / tolerance);
  return out;
}

/// The skin that is fair across within a share of its size; `light`: in few control points, too.
SurfaceModel fair_of(const std::vector<std::string>& files, std::optional<double> noise,
                     double size, bool light, const std::string& name) {
  constexpr double kShare = 1e-4, kLightShare = 0.5;  // of the size, of that
  SurfaceModel out;
  const auto sections = read_sections(files);
  EXPECT_TRUE(sections) << name;
  if (!sections) return out;
  SkinJob job;
  job.sections.noise = noise;
  job.fair_across = kShare * size;
  if (light) job.light = kLightShare * kShare * size;
  const auto made = fit_skin(*sections, job);
  EXPECT_TRUE(made && made->skin.fair) << name << (made ? "" : to_line(made.error()));
  if (!made || !made->skin.fair) return out;
  EXPECT_LE(made->skin.fair->moved, *job.fair_across) << name;
  EXPECT_LE(made->skin.across.found, made->skin.fair->before.found) << name;
  std::size_t points = 0;
  for (const SurfacePatch& patch : made->skin.patches) points += patch.surface.points.size();
  std::printf("%-12s fair across%s: %zu control points, %zu changes, %zu before\n", name.c_str(),
              light ? " and light" : "", points, made->skin.across.found,
              made->skin.fair->before.found);
  out.patches = made->skin.patches;
  return out;
}

TEST_F(SkinsInFreecad, PublicHullsAndBladesAreValidAndMeetTheirSections) {
  const auto hull = [](const char* name) {
    return public_file(std::string("hulls_grids/") + name + "_x.dat");
  };
  std::vector<std::string> blade;
  for (const auto& entry : fs::directory_iterator(public_file("windturbine_iea15"))) {
    blade.push_back(entry.path().string());
  }
  std::sort(blade.begin(), blade.end());
  struct Body {
    const char* name;
    std::vector<std::string> files;
    std::optional<double> noise;  // of measured or rounded sections, units of the file
    std::size_t patches;
    bool fair = false;  // looked at fair across, too: that takes seconds
  };
  const std::vector<Body> bodies = {
      {"series60", {hull("Series60Offset")}, {}, 1, true},
      {"trawler", {hull("TrawlerOffset")}, {}, 1},
      {"patrol",
       {hull("wpb_offset_bottom"), hull("wpb_offset_mid"), hull("wpb_offset_top")},
       {},
       3},
      {"rotor37", {public_file("turbomachinery_nasa/rotor37geometry.dat")}, 1e-4, 1, true},
      {"iea15", blade, 2e-4, 2},
  };
  for (const Body& body : bodies) {
    const FittedSkin made = checked_skin(body.files, body.noise, body.name);
    EXPECT_EQ(made.skin.patches.size(), body.patches) << body.name;
    if (made.skin.patches.empty()) continue;
    for (const SkinSectionReport& section : made.skin.sections) {
      EXPECT_LE(section.ripple, kMonotone) << body.name << ", " << section.name;
    }
    SurfaceModel model;
    model.patches = made.skin.patches;
    add(model, body.name);
    add(light_of(model, body.name), std::string(body.name) + "_light");
    for (const bool light : {false, true}) {
      if (!body.fair) continue;
      SurfaceModel fair = fair_of(body.files, body.noise, size_of(model), light, body.name);
      add(std::move(fair), std::string(body.name) + (light ? "_fair_light" : "_fair"));
    }
  }
  judge();
}

/// What a light skin is for: a file that a CAD system opens at once.
TEST_F(SkinsInFreecad, TheWindTurbineBladeIsLightWithinATenthOfAMillimetre) {
  constexpr double kLight = 1e-4;  // metres
  std::vector<std::string> blade;
  for (const auto& entry : fs::directory_iterator(public_file("windturbine_iea15"))) {
    blade.push_back(entry.path().string());
  }
  std::sort(blade.begin(), blade.end());
  const auto sections = read_sections(blade);
  ASSERT_TRUE(sections) << to_line(sections.error());
  SkinJob job;
  job.sections.noise = 2e-4;
  job.light = kLight;
  const auto made = fit_skin(*sections, job);
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_EQ(made->proved, 50u);
  ASSERT_TRUE(made->skin.light);
  EXPECT_LE(made->skin.light->moved, kLight);
  double deviation = 0.0;
  for (const SkinSectionReport& section : made->skin.sections) {
    deviation = std::max(deviation, section.deviation);
  }
  EXPECT_LE(deviation, kLight);
  std::size_t around = 0;
  SurfaceModel model;
  model.patches = made->skin.patches;
  for (const SurfacePatch& patch : model.patches) {
    around += patch.surface.count_u();
    EXPECT_LE(patch.surface.count_v(), 60u);
  }
  EXPECT_LE(around, 120u);
  add(model, "blade_light");
  EXPECT_LT(fs::file_size(folder_ / "blade_light.step"), 1'000'000u);
  std::printf("blade: %zu control points around in %zu patches, sections within %.3g, %zu bytes\n",
              around, model.patches.size(), deviation,
              static_cast<std::size_t>(fs::file_size(folder_ / "blade_light.step")));
  judge();
}

/// One side of an outline of pixels: from its highest to its lowest point, by distance from the
/// middle and height.
std::vector<Vec2> half_profile(const std::vector<Vec2>& outline) {
  double left = outline[0].x, right = outline[0].x;
  std::size_t top = 0, bottom = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    left = std::min(left, outline[i].x);
    right = std::max(right, outline[i].x);
    if (outline[i].y > outline[top].y) top = i;
    if (outline[i].y < outline[bottom].y) bottom = i;
  }
  const double axis = (left + right) / 2.0;
  std::vector<Vec2> way;
  for (std::size_t i = top; i != bottom; i = (i + 1) % outline.size()) way.push_back(outline[i]);
  const double side = way[way.size() / 2].x < axis ? -1.0 : 1.0;
  std::vector<Vec2> profile;
  for (const Vec2 p : way) {
    // flat ends run towards the axis: the wall between them is what turns
    const Vec2 here{side * (p.x - axis), p.y};
    const bool wall = here.x > 0.02 * (right - left);
    if (wall && (profile.empty() || !(profile.back() == here))) profile.push_back(here);
  }
  return profile;
}

TEST_F(SkinsInFreecad, BottlesTurnIntoValidSurfacesOfRevolution) {
  std::size_t bottles = 0, made_count = 0;
  for (const auto& entry : fs::directory_iterator(public_file("outlines_momocs/bot"))) {
    ++bottles;
    const auto outline = read_points(entry.path().string());
    ASSERT_TRUE(outline) << entry.path();
    PointSeries series;
    series.points = half_profile(outline->points);
    FitJob job;
    job.noise = 2.0;  // pixels: outlines were traced on a grid of whole ones
    job.closing = Closing::kOpen;
    const std::string file = (folder_ / (entry.path().stem().string() + ".csv")).string();
    std::ofstream text(file);
    for (const Vec2 p : series.points) text << p.x << "," << p.y << "\n";
    text.close();
    SurfaceJob surface;
    surface.kind = RevolveKind{{}, {0, 1, 0}};
    surface.inputs = {file};
    surface.curves.sections = job;
    const auto made = make_surface(surface);
    if (!made) {
      std::printf("%s: %s\n", entry.path().stem().c_str(), to_line(made.error()).c_str());
      continue;
    }
    ++made_count;
    EXPECT_EQ(made->deviation, 0.0);
    add(made->model, entry.path().stem().string());
  }
  EXPECT_EQ(bottles, 16u);
  EXPECT_EQ(made_count, bottles);
  judge();
}

}  // namespace
}  // namespace obvid
