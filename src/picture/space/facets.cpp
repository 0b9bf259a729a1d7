// SPDX-License-Identifier: Apache-2.0
#include "space/facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "space/light.h"
#include "space/paths.h"

namespace obvid::picture {
namespace {

using Quad = DepthBuffer::Quad;
using Seen = DepthBuffer::Seen;

constexpr Rgb kDark{43, 52, 64}, kLight{238, 241, 244};
/// Width (px) of the line around each piece in its own colour: closes the seams between neighbours.
constexpr double kSeam = 0.9;
/// Parts of cells that are mended, px; and how many there may be along a side.
constexpr double kPart = 1.0;
constexpr int kMostFacetParts = 64;
constexpr std::size_t kCellsUnasked = 256;  // before whoever waits is asked whether to go on

/// A corner of a piece on the sheet with its value in bands.
struct Corner {
  Vec2 at;
  double band = 0.0;
};
using Polygon = std::vector<Corner>;
using Corners = std::array<Corner, 4>;

/// What lies on one side of a border of bands; the value is linear along the sides.
Polygon cut(const Polygon& polygon, double border, bool above) {
  Polygon out;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const bool a_in = above ? a.band >= border : a.band <= border;
    const bool b_in = above ? b.band >= border : b.band <= border;
    if (a_in) out.push_back(a);
    if (a_in != b_in) {
      const double t = (border - a.band) / (b.band - a.band);
      out.push_back({a.at + t * (b.at - a.at), border});
    }
  }
  return out;
}

struct DrawnCell {
  const DrawnPatch& patch;
  std::array<std::size_t, 4> corners;
  const Quad& quad;
  std::size_t number = 0;

  /// Whether the side that the normal points to is seen (y points down on the sheet).
  [[nodiscard]] bool front() const {
    const Vec3 a = quad[2] - quad[0], b = quad[3] - quad[1];
    return a.x * b.y - a.y * b.x < 0.0;
  }
};

class Painter {
 public:
  Painter(const PictureCamera& camera, const Colours& colours)
      : camera_(camera), colours_(colours) {}

  /// Pieces of a cell, those of whole ones at the end and by colour.
  void add(const DrawnCell& cell, bool whole) {
    front_ = cell.front();
    coloured_ = valued(cell.patch);
    Corners corners{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      corners[k] = {{cell.quad[k].x, cell.quad[k].y}, band_at(cell, k)};
    }
    banded(corners, whole);
  }

  /// Parts of a cell that should be seen and were covered, as strips on top of what is there.
  void mend(const DrawnCell& cell, const DepthBuffer& depth) {
    front_ = cell.front();
    coloured_ = valued(cell.patch);
    const int parts = parts_of(cell.quad);
    for (int j = 0; j < parts; ++j) {
      for (int i = 0; i < parts; ++i) {
        const int from = i;
        while (i < parts && depth.wronged(cell.number, inside(cell, i + 0.5, j + 0.5, parts).at)) {
          ++i;
        }
        if (i == from) continue;
        banded({inside(cell, from, j, parts), inside(cell, i, j, parts),
                inside(cell, i, j + 1, parts), inside(cell, from, j + 1, parts)},
               true);
      }
    }
  }

  [[nodiscard]] std::string take() {
    flush();
    for (auto& [colour, path] : whole_) write(colour, path.take());
    return std::move(text_);
  }

 private:
  /// How often a cell is divided both ways so that its parts are as small as the raster.
  static int parts_of(const Quad& quad) {
    double longest = 0.0;
    for (std::size_t k = 0; k < quad.size(); ++k) {
      const Vec3 side = quad[(k + 1) % quad.size()] - quad[k];
      longest = std::max(longest, std::hypot(side.x, side.y));
    }
    return std::clamp(static_cast<int>(std::ceil(longest / kPart)), 1, kMostFacetParts);
  }

  /// Place and value inside a cell, i and j in 0 ... parts.
  [[nodiscard]] Corner inside(const DrawnCell& cell, double i, double j, int parts) const {
    const double u = i / parts, v = j / parts;
    const std::array<double, 4> w = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
    Corner corner;
    for (std::size_t k = 0; k < w.size(); ++k) {
      corner.at = corner.at + w[k] * Vec2{cell.quad[k].x, cell.quad[k].y};
      corner.band += w[k] * band_at(cell, k);
    }
    return corner;
  }

  /// Value of a corner in bands or shades.
  [[nodiscard]] double band_at(const DrawnCell& cell, std::size_t corner) const {
    const std::size_t vertex = cell.corners[corner];
    if (valued(cell.patch)) {
      const ValueScale& s = colours_.scale;
      const double part =
          s.constant() ? 0.5 : (cell.patch.values[vertex] - s.low) / (s.high - s.low);
      // beyond the ends everything is one band
      return kBands * std::clamp(part, -1.0, 2.0);
    }
    const Vec3 n = camera_.seen((front_ ? 1.0 : -1.0) * cell.patch.normals[vertex]);
    if (!striped()) return light_at(n);
    if (colours_.colouring == SurfaceColouring::kIsophotes) {
      // whole numbers of turns lie in the middle of light bands, as on pages
      const double angle = std::acos(std::clamp(n.z, -1.0, 1.0));
      return 4.0 * colours_.zebra_stripes * angle / std::numbers::pi + 0.5;
    }
    if (colours_.colouring == SurfaceColouring::kReflection) {
      return lamp_at(camera_.seen(cell.patch.points[vertex] - camera_.centre), n);
    }
    // reflection of the direction of view, two bands to a stripe
    const double angle = std::asin(std::clamp(2.0 * n.z * n.y, -1.0, 1.0));
    return 2.0 * colours_.zebra_stripes * angle / std::numbers::pi + 0.5;
  }

  /// Whether the patch has values of its own for the scale (points alone may have them).
  [[nodiscard]] bool valued(const DrawnPatch& patch) const {
    return has_scale(colours_.colouring) && !patch.values.empty();
  }
  [[nodiscard]] bool striped() const {
    return colours_.colouring == SurfaceColouring::kZebra ||
           colours_.colouring == SurfaceColouring::kIsophotes ||
           colours_.colouring == SurfaceColouring::kReflection;
  }

  /// Lamps that run away from the viewer along the ceiling, two bands to each: where the ray that
  /// is mirrored at a place meets it. No lamp beyond the outermost, and none below the horizon.
  [[nodiscard]] double lamp_at(Vec3 place, Vec3 n) const {
    const double up = 2.0 * n.z * n.y, right = 2.0 * n.z * n.x;
    const double most = 2.0 * colours_.zebra_stripes + 1.0;
    const double height = colours_.ceiling - place.y;
    if (!(up > 0.0)) return std::copysign(most, right);
    const double at = (place.x + height * right / up) / colours_.ceiling;
    return std::clamp(2.0 * colours_.zebra_stripes * at + 0.5, -most, most);
  }

  /// First and last band, both open.
  [[nodiscard]] std::pair<int, int> bands() const {
    if (coloured_) return {0, kBands - 1};
    if (!striped()) return {0, kShades - 1};
    const int most = 2 * colours_.zebra_stripes + 1;
    return {-most, most};
  }

  [[nodiscard]] Rgb band_colour(int band) const {
    if (striped()) return band % 2 == 0 ? kLight : kDark;
    if (coloured_) {
      return palette(colours_.scale.diverging, (band + 0.5) / kBands);
    }
    return shade_colour(band, front_,
                        colours_.colouring == SurfaceColouring::kIsolines ||
                            colours_.colouring == SurfaceColouring::kDeviation);
  }

  /// A quadrilateral cut along the borders of its bands.
  void banded(const Corners& corners, bool whole) {
    const auto [first, last] = bands();
    const auto band_of = [from = first, to = last](double value) {
      return std::clamp(static_cast<int>(std::floor(value)), from, to);
    };
    const auto [low, high] =
        std::minmax_element(corners.begin(), corners.end(),
                            [](const Corner& a, const Corner& b) { return a.band < b.band; });
    const int end = band_of(high->band);
    Polygon polygon(corners.begin(), corners.end());
    for (int band = band_of(low->band); band <= end; ++band) {
      Polygon rest = band < end ? cut(polygon, band + 1.0, true) : Polygon{};
      emit(band < end ? cut(polygon, band + 1.0, false) : polygon, band_colour(band), whole);
      polygon = std::move(rest);
    }
  }

  void emit(const Polygon& polygon, Rgb colour, bool whole) {
    if (polygon.size() < 3) return;
    if (!whole && colour != partly_colour_) {
      flush();
      partly_colour_ = colour;
    }
    TenthsPath& path = whole ? whole_[colour] : partly_;
    path.move(polygon.front().at);
    for (std::size_t k = 1; k < polygon.size(); ++k) path.line(polygon[k].at);
    path.close();
  }

  void flush() {
    if (!partly_.empty()) write(partly_colour_, partly_.take());
  }
  void write(Rgb colour, const std::string& data) {
    const std::string name = hex(colour);
    text_ += "<path fill=\"" + name + "\" stroke=\"" + name + "\" d=\"" + data + "\"/>\n";
  }

  const PictureCamera& camera_;
  const Colours& colours_;
  std::string text_;
  std::map<Rgb, TenthsPath> whole_;
  TenthsPath partly_;
  Rgb partly_colour_{};
  bool front_ = true;      ///< of the cell that is being drawn
  bool coloured_ = false;  ///< likewise: it has values of the scale
};

/// Visits the cells of all patches in their order.
template <class Visit>
void each_cell(const std::vector<DrawnPatch>& patches, Visit&& visit) {
  for (const DrawnPatch& patch : patches) {
    for (std::size_t j = 0; j + 1 < patch.vs.size(); ++j) {
      for (std::size_t i = 0; i + 1 < patch.us.size(); ++i) {
        visit(patch, std::array{patch.vertex(i, j), patch.vertex(i + 1, j),
                                patch.vertex(i + 1, j + 1), patch.vertex(i, j + 1)});
      }
    }
  }
}

double depth_of(const Quad& quad) { return quad[0].z + quad[1].z + quad[2].z + quad[3].z; }

}  // namespace

std::vector<Quad> projected(const std::vector<DrawnPatch>& patches, const PictureCamera& camera) {
  std::vector<Quad> quads;
  each_cell(patches, [&](const DrawnPatch& patch, const std::array<std::size_t, 4>& corners) {
    Quad quad;
    for (std::size_t k = 0; k < quad.size(); ++k)
      quad[k] = camera.project(patch.points[corners[k]]);
    quads.push_back(quad);
  });
  return quads;
}

std::string facet_paths(const std::vector<DrawnPatch>& patches, const std::vector<Quad>& quads,
                        DepthBuffer& depth, const PictureCamera& camera, const Colours& colours,
                        Watch* watch) {
  const std::vector<Seen> seen = depth.judge(quads);
  std::vector<DrawnCell> partly;
  Painter painter(camera, colours);
  std::size_t n = 0;
  each_cell(patches, [&](const DrawnPatch& patch, const std::array<std::size_t, 4>& corners) {
    if (n % kCellsUnasked == 0) (void)is_to_end(watch);
    const DrawnCell cell{patch, corners, quads[n], n};
    if (has_ended(watch)) return;
    if (seen[n] == Seen::kWhole) painter.add(cell, true);
    if (seen[n] == Seen::kPartly) partly.push_back(cell);
    ++n;
  });
  std::vector<std::size_t> order(partly.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return depth_of(partly[a].quad) < depth_of(partly[b].quad);
  });
  std::vector<std::size_t> numbers;
  for (const std::size_t k : order) {
    if (numbers.size() % kCellsUnasked == 0 && is_to_end(watch)) return {};
    painter.add(partly[k], false);
    numbers.push_back(partly[k].number);
  }
  depth.draw(quads, numbers);
  std::size_t mended = 0;
  for (const std::size_t k : order) {
    if (mended++ % kCellsUnasked == 0 && is_to_end(watch)) return {};
    painter.mend(partly[k], depth);
  }
  return "<g transform=\"" + std::string(kPathTransform) + "\" stroke-width=\"" +
         std::to_string(static_cast<int>(10.0 * kSeam)) + "\" stroke-linejoin=\"round\">\n" +
         painter.take() + "</g>\n";
}

}  // namespace obvid::picture
