// SPDX-License-Identifier: Apache-2.0
#include "surface_svg_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "surface_svg_light.h"
#include "surface_svg_paths.h"

namespace obvid::exchange {
namespace {

using Quad = DepthBuffer::Quad;
using Seen = DepthBuffer::Seen;

constexpr Rgb kDark{43, 52, 64}, kLight{238, 241, 244};
/// Width (px) of the line around each piece in its own colour: closes the seams between neighbours.
constexpr double kSeam = 0.9;

/// A corner of a piece on the sheet with its value in bands.
struct Corner {
  Vec2 at;
  double band = 0.0;
};
using Polygon = std::vector<Corner>;

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

struct Cell {
  const DrawnPatch& patch;
  std::array<std::size_t, 4> corners;
  const Quad& quad;

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

  /// Pieces of a cell, whole ones at the end and by colour.
  void add(const Cell& cell, bool whole) {
    if (is_curvature(colours_.colouring)) {
      banded(cell, whole, curvature_bands(cell), 0, kBands - 1);
    } else if (colours_.colouring == SurfaceColouring::kZebra) {
      const int most = 2 * colours_.zebra_stripes + 1;
      banded(cell, whole, zebra_bands(cell), -most, most);
    } else {
      front_ = cell.front();
      banded(cell, whole, light_bands(cell), 0, kShades - 1);
    }
  }

  [[nodiscard]] std::string take() {
    flush();
    for (auto& [colour, path] : whole_) write(colour, path.take());
    return std::move(text_);
  }

 private:
  [[nodiscard]] std::array<double, 4> light_bands(const Cell& cell) const {
    std::array<double, 4> bands{};
    const double side = front_ ? 1.0 : -1.0;
    for (std::size_t k = 0; k < bands.size(); ++k) {
      bands[k] = light_at(camera_.seen(side * cell.patch.normals[cell.corners[k]]));
    }
    return bands;
  }

  [[nodiscard]] std::array<double, 4> curvature_bands(const Cell& cell) const {
    std::array<double, 4> bands{};
    const ValueScale& s = colours_.scale;
    for (std::size_t k = 0; k < bands.size(); ++k) {
      const double part =
          s.constant() ? 0.5 : (cell.patch.values[cell.corners[k]] - s.low) / (s.high - s.low);
      // beyond the ends everything is one band
      bands[k] = kBands * std::clamp(part, -1.0, 2.0);
    }
    return bands;
  }

  /// Reflection of the direction of view, two bands to a stripe.
  [[nodiscard]] std::array<double, 4> zebra_bands(const Cell& cell) const {
    std::array<double, 4> bands{};
    const double side = cell.front() ? 1.0 : -1.0;
    for (std::size_t k = 0; k < bands.size(); ++k) {
      const Vec3 n = camera_.seen(side * cell.patch.normals[cell.corners[k]]);
      const double angle = std::asin(std::clamp(2.0 * n.z * n.y, -1.0, 1.0));
      bands[k] = 2.0 * colours_.zebra_stripes * angle / std::numbers::pi + 0.5;
    }
    return bands;
  }

  [[nodiscard]] Rgb band_colour(int band) const {
    if (colours_.colouring == SurfaceColouring::kZebra) return band % 2 == 0 ? kLight : kDark;
    if (is_curvature(colours_.colouring)) {
      return palette(colours_.scale.diverging, (band + 0.5) / kBands);
    }
    return shade_colour(band, front_, colours_.colouring == SurfaceColouring::kIsolines);
  }

  /// The cell cut along the borders of its bands; the outermost bands are open.
  void banded(const Cell& cell, bool whole, const std::array<double, 4>& bands, int first,
              int last) {
    Polygon polygon;
    for (std::size_t k = 0; k < bands.size(); ++k) {
      polygon.push_back({{cell.quad[k].x, cell.quad[k].y}, bands[k]});
    }
    const auto [low, high] = std::minmax_element(bands.begin(), bands.end());
    const auto band_of = [&](double value) {
      return std::clamp(static_cast<int>(std::floor(value)), first, last);
    };
    const int end = band_of(*high);
    for (int band = band_of(*low); band <= end; ++band) {
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
  bool front_ = true;  ///< of the cell that is being drawn
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
                        const std::vector<Seen>& seen, const PictureCamera& camera,
                        const Colours& colours) {
  std::vector<Cell> partly;
  Painter painter(camera, colours);
  std::size_t n = 0;
  each_cell(patches, [&](const DrawnPatch& patch, const std::array<std::size_t, 4>& corners) {
    const Cell cell{patch, corners, quads[n]};
    if (seen[n] == Seen::kWhole) painter.add(cell, true);
    if (seen[n] == Seen::kPartly) partly.push_back(cell);
    ++n;
  });
  std::vector<std::size_t> order(partly.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return depth_of(partly[a].quad) < depth_of(partly[b].quad);
  });
  for (const std::size_t k : order) painter.add(partly[k], false);
  return "<g transform=\"" + std::string(kPathTransform) + "\" stroke-width=\"" +
         std::to_string(static_cast<int>(10.0 * kSeam)) + "\" stroke-linejoin=\"round\">\n" +
         painter.take() + "</g>\n";
}

}  // namespace obvid::exchange
