// SPDX-License-Identifier: Apache-2.0
#include "space/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "obvid/surface/internal/trim.h"
#include "space/paths.h"

namespace obvid::picture {
namespace {

/// Distance at which a line is asked whether it can be seen, px.
constexpr double kProbe = 1.5;
/// Points nearer to the line than this are left out, px.
constexpr double kThin = 0.2;
/// So many probes that differ from both their neighbours are noise of the raster.
constexpr std::size_t kNoise = 2;
/// Text of extra lines beyond this is thinned more, bytes; and how often.
constexpr std::size_t kMostLineText = 600'000;
constexpr int kThinnings = 6;

struct Probe {
  Vec2 at;
  bool seen = false;
};

std::vector<Probe> probed(const std::vector<Vec3>& line, const DepthBuffer& depth) {
  std::vector<Probe> probes;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Vec3 b = line[k], a = k > 0 ? line[k - 1] : b;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / kProbe)));
    for (int i = 1; i <= parts; ++i) {
      const Vec3 p = a + (static_cast<double>(i) / parts) * (b - a);
      probes.push_back({{p.x, p.y}, depth.sees(p)});
    }
  }
  return probes;
}

/// Flips short stretches between two of the other kind.
void calm(std::vector<Probe>& probes) {
  std::size_t begin = 0;
  for (std::size_t i = 1; i < probes.size(); ++i) {
    if (probes[i].seen == probes[begin].seen) continue;
    if (begin > 0 && i - begin <= kNoise && probes[begin - 1].seen != probes[begin].seen) {
      for (std::size_t k = begin; k < i; ++k) probes[k].seen = !probes[k].seen;
    }
    begin = i;
  }
}

/// One path of the parts of lines that are seen, and one of those that are not.
struct TwoPaths {
  TenthsPath seen, hidden;

  /// Without what lies beside the sheet.
  void add(const std::vector<Vec3>& line, const DepthBuffer& depth, double thin) {
    std::vector<Vec3> part;
    for (std::size_t k = 0; k < line.size(); ++k) {
      if (k > 0 && depth.beside(line[k - 1], line[k])) {
        if (part.size() > 1) add_part(part, depth, thin);
        part.clear();
      }
      part.push_back(line[k]);
    }
    if (!part.empty() && !depth.beside(part.front(), part.back())) add_part(part, depth, thin);
  }

 private:
  void add_part(const std::vector<Vec3>& line, const DepthBuffer& depth, double thin) {
    std::vector<Probe> probes = probed(line, depth);
    calm(probes);
    for (std::size_t from = 0; from + 1 < probes.size();) {
      std::size_t to = from + 1;
      std::vector<Vec2> part{probes[from].at};
      // the step between a seen and a hidden probe belongs to the latter
      const bool is_seen = probes[from].seen && probes[to].seen;
      for (; to < probes.size() && (probes[to - 1].seen && probes[to].seen) == is_seen; ++to) {
        part.push_back(probes[to].at);
      }
      TenthsPath& path = is_seen ? seen : hidden;
      part = thinned(part, thin);
      path.move(part.front());
      for (std::size_t k = 1; k < part.size(); ++k) path.line(part[k]);
      from = to - 1;
    }
  }
};

std::string element(std::string_view css, const std::string& data) {
  if (data.empty()) return {};
  return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", css, data);
}

std::string group(const std::string& paths) {
  if (paths.empty()) return {};
  return fmt::format("<g class=\"lines\" transform=\"{}\">\n{}</g>\n", kPathTransform, paths);
}

/// The curve of constant u (or v) through the parameters of the other.
std::vector<Vec3> isoline(const NurbsSurface& surface, const PictureCamera& camera, bool of_u,
                          double at, const std::vector<double>& others) {
  std::vector<Vec3> line;
  for (const double t : others) {
    line.push_back(
        camera.project(of_u ? evaluate(surface, at, t).point : evaluate(surface, t, at).point));
  }
  return line;
}

/// Lines and borders of what is there of a trimmed patch.
class TrimmedLines {
 public:
  TrimmedLines(const Scene& scene, std::size_t patch)
      : scene_(scene), patch_(scene.model.patches[patch]), region_(patch_) {}

  void add_isolines(TwoPaths& paths, bool of_u, int cells) const {
    constexpr int kLinePlaces = 400;
    const NurbsSurface& s = patch_.surface;
    const Range range = of_u ? domain_u(s) : domain_v(s), along = of_u ? domain_v(s) : domain_u(s);
    for (int k = 1; k < cells; ++k) {
      const double at = range.at(static_cast<double>(k) / cells);
      std::vector<Vec3> line;
      for (int i = 0; i <= kLinePlaces; ++i) {
        const double t = along.at(static_cast<double>(i) / kLinePlaces);
        const double u = of_u ? at : t, v = of_u ? t : at;
        if (region_.contains(u, v)) {
          line.push_back(scene_.camera.project(evaluate(s, u, v).point));
        } else if (!line.empty()) {
          paths.add(line, scene_.depth, kThin);
          line.clear();
        }
      }
      if (!line.empty()) paths.add(line, scene_.depth, kThin);
    }
  }
  void add_borders(TwoPaths& paths) const {
    constexpr int kBorderPlaces = 16, kLeast = 64;
    for (const TrimLoop& loop : patch_.trims) {
      for (const NurbsCurve& curve : loop.curves) {
        const Range range = domain(curve);
        const int n = std::max(kLeast, kBorderPlaces * static_cast<int>(curve.knots.size()));
        std::vector<Vec3> line;
        for (int i = 0; i <= n; ++i) {
          const Vec2 p = evaluate(curve, range.at(static_cast<double>(i) / n)).point;
          line.push_back(scene_.camera.project(evaluate(patch_.surface, p.x, p.y).point));
        }
        paths.add(line, scene_.depth, kThin);
      }
    }
  }

 private:
  const Scene& scene_;
  const SurfacePatch& patch_;
  TrimRegion region_;
};

void add_isolines(TwoPaths& paths, const Scene& scene, const DrawnPatch& drawn, bool of_u,
                  int cells) {
  const NurbsSurface& surface = scene.model.patches[drawn.patch].surface;
  const Range range = of_u ? domain_u(surface) : domain_v(surface);
  for (int k = 1; k < cells; ++k) {
    const double at = range.at(static_cast<double>(k) / cells);
    paths.add(isoline(surface, scene.camera, of_u, at, of_u ? drawn.vs : drawn.us), scene.depth,
              kThin);
  }
}

void add_borders(TwoPaths& paths, const Scene& scene, const DrawnPatch& drawn,
                 const std::array<bool, 4>& real) {
  const NurbsSurface& surface = scene.model.patches[drawn.patch].surface;
  const Range u = domain_u(surface), v = domain_v(surface);
  const std::array<double, 4> at = {u.from, u.to, v.from, v.to};
  for (std::size_t k = 0; k < real.size(); ++k) {
    if (!real[k]) continue;
    const bool of_u = k < 2;
    paths.add(isoline(surface, scene.camera, of_u, at[k], of_u ? drawn.vs : drawn.us), scene.depth,
              kThin);
  }
}

/// Where the normal turns away from the viewer, cell by cell: two triangles each.
void add_outlines(TwoPaths& paths, const Scene& scene, const DrawnPatch& patch) {
  const auto turned = [&](std::size_t vertex) {
    return dot(patch.normals[vertex], scene.camera.back);
  };
  const auto crossing = [&](std::size_t a, std::size_t b) -> std::optional<Vec3> {
    const double fa = turned(a), fb = turned(b);
    if ((fa < 0.0) == (fb < 0.0)) return std::nullopt;
    const Vec3 p = patch.points[a] + (fa / (fa - fb)) * (patch.points[b] - patch.points[a]);
    return scene.camera.project(p);
  };
  for (std::size_t j = 0; j + 1 < patch.vs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < patch.us.size(); ++i) {
      const std::size_t a = patch.vertex(i, j), b = patch.vertex(i + 1, j),
                        c = patch.vertex(i + 1, j + 1), d = patch.vertex(i, j + 1);
      for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}}) {
        std::vector<Vec3> line;
        for (std::size_t k = 0; k < 3; ++k) {
          if (const auto p = crossing(t[k], t[(k + 1) % 3])) line.push_back(*p);
        }
        if (line.size() == 2) paths.add(line, scene.depth, kThin);
      }
    }
  }
}

std::string_view css_of(const std::string& role) {
  for (const std::string_view known : {"section", "toolpath", "rapid"}) {
    if (role == known) return known;
  }
  return "other";
}

std::string extra_paths(const Scene& scene, const std::vector<ScenePolyline>& lines, double thin) {
  std::string text;
  for (const std::string_view css : {"rapid", "other", "toolpath", "section"}) {
    TwoPaths paths;
    for (const ScenePolyline& line : lines) {
      if (css_of(line.role) != css) continue;
      std::vector<Vec3> on_sheet;
      for (const Vec3 p : line.points) on_sheet.push_back(scene.camera.project(p));
      paths.add(on_sheet, scene.depth, thin);
    }
    if (css == "section") text += element("section behind", paths.hidden.take());
    text += element(css, paths.seen.take());
  }
  return text;
}

}  // namespace

std::string surface_lines(const Scene& scene, const SurfacePictureOptions& options) {
  TwoPaths u, v, borders, outlines;
  const bool isolines = options.colouring == SurfaceColouring::kIsolines;
  const bool thin = is_curvature(options.colouring);
  const auto real = real_borders(scene.model);
  for (const DrawnPatch& drawn : scene.patches) {
    add_outlines(outlines, scene, drawn);
    if (!scene.model.patches[drawn.patch].trims.empty()) continue;
    if (isolines || thin) {
      add_isolines(u, scene, drawn, true, options.isolines_u);
      add_isolines(v, scene, drawn, false, options.isolines_v);
    }
    add_borders(borders, scene, drawn, real[drawn.patch]);
  }
  for (std::size_t k = 0; k < scene.model.patches.size(); ++k) {
    if (scene.model.patches[k].trims.empty()) continue;
    const TrimmedLines lines(scene, k);
    if (isolines || thin) {
      lines.add_isolines(u, true, options.isolines_u);
      lines.add_isolines(v, false, options.isolines_v);
    }
    lines.add_borders(borders);
  }
  return group(element(isolines ? "iso u" : "iso", u.seen.take()) +
               element(isolines ? "iso v" : "iso", v.seen.take()) +
               element("border", borders.seen.take()) + element("outline", outlines.seen.take()));
}

std::string extra_lines(const Scene& scene, const std::vector<ScenePolyline>& lines) {
  double thin = kThin;
  for (int trial = 0;; ++trial) {
    std::string text = extra_paths(scene, lines, thin);
    if (text.size() <= kMostLineText || trial == kThinnings) return group(text);
    thin *= 2.0;
  }
}

}  // namespace obvid::picture
