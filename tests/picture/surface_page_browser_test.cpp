// SPDX-License-Identifier: Apache-2.0
// Pages of surfaces in a browser: pixels of known shapes, mouse, keys, a lost graphics card.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "../common/programs.h"
#include "obvid/picture/internal/surface_page.h"
#include "page_judge.h"
#include "surface_samples.h"

namespace obvid {
namespace {

class SurfacePageInBrowser : public Judged {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_PROGRAM("chromium");
    Judged::SetUp();
  }

  std::string page(const SurfaceModel& model, std::size_t cells, const PageOptions& options = {}) {
    const auto made = surface_page(model, meshes_of(model, cells), options);
    EXPECT_TRUE(made);
    return write("page.html", made.value_or(""));
  }
  std::string shot(const std::string& page, const std::string& fragment,
                   const std::string& name) const {
    EXPECT_EQ(judge({"shot", page, fragment, file(name)}), "") << fragment;
    return file(name);
  }
  /// Attributes of <html> after a script.
  static std::string after(const std::string& page, const std::string& script,
                           const std::string& fragment = "", const std::string& flag = "") {
    std::vector<std::string> arguments = {"dom", page, fragment, script};
    if (!flag.empty()) arguments.push_back(flag);
    return judge(arguments);
  }
};

constexpr const char* kStage = "0,60,600,442";  // left of the panel, between title and legend

TEST_F(SurfacePageInBrowser, SphereIsADiscOfOneColour) {
  const std::string p = page(model_of({{"ball", sphere(25)}}, "Sphere"), 96);
  const std::string png = shot(p, "#mode=gaussian&view=front&projection=orthographic", "a.png");
  const Spot disc = spot(png, "green", "0,60,610,442");
  ASSERT_GT(disc.width(), 150.0);
  EXPECT_NEAR(disc.width(), disc.height(), 3.0);
  EXPECT_NEAR(disc.count / (disc.width() * disc.height()), std::numbers::pi / 4.0, 0.01);
}

TEST_F(SurfacePageInBrowser, TorusIsBlueInsideAndRedOutside) {
  const std::string p = page(model_of({{"ring", torus(40, 14)}}), 96);
  const std::string png = shot(p, "#mode=gaussian&view=top&projection=orthographic", "a.png");
  const Spot blue = spot(png, "blue", kStage), red = spot(png, "red", kStage);
  // from above the saddle part begins at the radius 40 of 54, the strongest colours well inside
  ASSERT_GT(red.width(), 100.0);
  ASSERT_GT(blue.width(), 50.0);
  EXPECT_LT(blue.width(), red.width() * 40.0 / 54.0);
  EXPECT_GT(blue.width(), red.width() * 26.0 / 54.0);
  EXPECT_NEAR(blue.left + blue.right, red.left + red.right, 6.0);
}

TEST_F(SurfacePageInBrowser, RipplesBetweenTheCornersOfTrianglesAreSeen) {
  PageOptions options;
  options.deviation = ShownDeviation{};
  options.deviation->title = "ripples";
  options.deviation->told = {-0.02, 0.02};
  options.deviation->of_place = [](Vec3 p) {
    return 0.02 * std::sin(2.0 * std::numbers::pi * 5.0 * p.x / 100.0);
  };
  const std::string p = page(model_of({{"plate", rippled_plate()}}), 1, options);
  for (const char* mode : {"mean", "deviation"}) {
    const std::string png =
        shot(p, std::string("#mode=") + mode + "&view=top&projection=orthographic", "a.png");
    const Spot blue = spot(png, "blue", kStage), red = spot(png, "red", kStage);
    ASSERT_GT(blue.width(), 200.0) << mode;
    // strips in turn over the whole plate, about as much of one as of the other
    EXPECT_NEAR(blue.width(), red.width(), 0.15 * blue.width()) << mode;
    EXPECT_NEAR(blue.count, red.count, 0.3 * blue.count) << mode;
    EXPECT_GT(blue.count, 0.15 * blue.width() * blue.height()) << mode;
  }
  // the values of a point that is read off are those of its pixel: a crest, z = 0.02 at x = 2.5
  const std::string out = after(p, R"(
    look(0, 90, true);
    const q = project([2.5, 50, 0].map((x, k) => x - model.centre[k]));
    readOff(q[0], q[1]);
    document.documentElement.dataset.point = byId("point").textContent.replace(/["<>]/g, "");
  )");
  EXPECT_NE(out.find("k2−0.0064 1/mm"), std::string::npos) << out;
  EXPECT_NE(out.find("deviation0.01414 mm"), std::string::npos) << out;
}

TEST_F(SurfacePageInBrowser, EachLookIsAnotherPicture) {
  const std::string p = page(model_of({{"saddle", saddle(20, 12)}}), 40);
  std::vector<std::string> pictures;
  for (const char* fragment : {"", "#mode=isolines", "#mode=shaded&wireframe=1", "#mode=zebra"}) {
    pictures.push_back(shot(p, fragment, std::to_string(pictures.size()) + ".png"));
  }
  EXPECT_GT(difference(pictures), 0.01);
  EXPECT_GT(spot(pictures[3], "dark", kStage).count, 2000.0) << "zebra has dark stripes";
  EXPECT_LT(spot(pictures[0], "dark", kStage).count, 600.0) << "shaded has none";
}

TEST_F(SurfacePageInBrowser, AnswersMouseKeysAndPanel) {
  const std::string p = page(model_of({{"ball", sphere(25)}, {"plate", rectangle(60, 60)}}), 48);
  const std::string script = R"(
    canvas.setPointerCapture = () => {};
    const html = document.documentElement.dataset;
    const press = (key, more) => document.body.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, ...more}));
    const mouse = (type, x, y, more) => canvas.dispatchEvent(new PointerEvent(type, {pointerId: 1, clientX: x, clientY: y, button: 0, buttons: 1, ...more}));
    const before = {...state, target: state.target.join()};
    mouse("pointerdown", 200, 200); mouse("pointermove", 250, 220); mouse("pointerup", 250, 220);
    html.turned = state.azimuth !== before.azimuth && state.elevation > before.elevation;
    mouse("pointerdown", 200, 200, {buttons: 2}); mouse("pointermove", 250, 220, {buttons: 2}); mouse("pointerup", 250, 220);
    html.moved = state.target.join() !== before.target;
    const span = state.span;
    canvas.dispatchEvent(new WheelEvent("wheel", {deltaY: -120, clientX: 300, clientY: 300}));
    html.zoomed = state.span < span;
    press("z"); html.key = state.mode === "zebra";
    html.said = byId("said").textContent;
    html.pressed = [...document.querySelectorAll("[aria-pressed=true]")].map(e => e.textContent).join();
    press("ArrowLeft"); press("-"); press("p"); html.flat = !state.perspective;
    press("w"); draw(); html.edges = model.patches[0].edges.count;
    document.querySelector("#patches input:last-of-type").click();
    html.off = !model.patches[0].shown;
    byId("none").click(); draw(); byId("all").click();
    look(0, 0, true);
    const q = project([-5, -25, -5].map((x, k) => x - model.centre[k]));
    mouse("pointerdown", q[0], q[1]); mouse("pointerup", q[0], q[1]);
    html.point = byId("point").textContent.replace(/["<>]/g, "");
    html.error = gl.getError();
  )";
  const std::string out = after(p, script);
  for (const char* wanted :
       {"data-state=\"ready\"", "data-turned=\"true\"", "data-moved=\"true\"",
        "data-zoomed=\"true\"", "data-key=\"true\"", "data-flat=\"true\"", "data-off=\"true\"",
        "data-said=\"Zebra\"", "data-pressed=\"Zebra\"", "data-error=\"0\""}) {
    EXPECT_NE(out.find(wanted), std::string::npos) << wanted << " in " << out;
  }
  // a raster of 48 x 48 cells: 2 * 48 * 49 sides and as many diagonals as cells
  EXPECT_NE(out.find("data-edges=\"" + std::to_string(2 * (2 * 48 * 49 + 48 * 48)) + "\""),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("ball"), std::string::npos) << out;
  EXPECT_NE(out.find("smallest radius25 mm"), std::string::npos) << out;
  EXPECT_NE(out.find("k1−0.04 1/mm"), std::string::npos) << out;
}

TEST_F(SurfacePageInBrowser, HostileNamesAndRolesAreOnlyShown) {
  const std::string name = "</script><img src=x onerror=document.title=1>";
  PageOptions options;
  options.lines = {{{{0, 0, 0}, {1, 1, 1}}, "constructor"}, {{{0, 0, 2}}, name}};
  const std::string p =
      page(model_of({{name, rectangle(1, 1)}, {"__proto__", sphere(1)}}, name), 4, options);
  const std::string out = after(p,
                                "document.documentElement.dataset.images = document.images.length;"
                                "document.documentElement.dataset.rows = "
                                "document.querySelectorAll(\"#patches label\").length;");
  EXPECT_NE(out.find("data-state=\"ready\""), std::string::npos) << out;
  EXPECT_NE(out.find("data-images=\"0\""), std::string::npos) << out;
  EXPECT_NE(out.find("data-rows=\"2\""), std::string::npos) << out;
}

TEST_F(SurfacePageInBrowser, StrangeAddressesFallBack) {
  const std::string p = page(model_of({{"plate", rectangle(3, 2)}}), 4);
  const std::string out = after(p,
                                "document.documentElement.dataset.seen = [state.mode, state.u, "
                                "state.stripes, state.span > 0].join();",
                                "#mode=constructor&view=__proto__&u=1e9&stripes=-3&v=x");
  EXPECT_NE(out.find("data-seen=\"shaded,60,2,true\""), std::string::npos) << out;
}

TEST_F(SurfacePageInBrowser, ComesBackWhenTheGraphicsCardWasLost) {
  const std::string p = page(model_of({{"plate", rectangle(3, 2)}}), 4);
  const std::string out = after(p, R"(
    const lost = gl.getExtension("WEBGL_lose_context");
    canvas.addEventListener("webglcontextrestored", () => setTimeout(() => {
      draw();
      document.documentElement.dataset.again = gl.getError() + "," + gl.isContextLost();
    }, 50));
    lost.loseContext();
    setTimeout(() => { draw(); lost.restoreContext(); }, 50);
  )");
  EXPECT_NE(out.find("data-again=\"0,false\""), std::string::npos) << out;
}

TEST_F(SurfacePageInBrowser, SaysSoWithoutWebGl) {
  const std::string p = page(model_of({{"plate", rectangle(3, 2)}}), 4);
  const std::string out = after(
      p,
      "document.documentElement.dataset.told = byId(\"failed\").textContent.includes(\"WebGL 2\");",
      "", "--disable-3d-apis");
  EXPECT_NE(out.find("data-state=\"failed\""), std::string::npos) << out;
  EXPECT_NE(out.find("data-told=\"true\""), std::string::npos) << out;
}

}  // namespace
}  // namespace obvid
