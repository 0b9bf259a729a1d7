// SPDX-License-Identifier: Apache-2.0
#include "page/data.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "obvid/geom/internal/box.h"

namespace obvid::picture {
namespace {

/// Arrays of numbers as bytes, whatever the order of bytes of the machine.
class Bytes {
 public:
  void real(double value) {
    const auto single = static_cast<float>(value);
    std::uint32_t bits = 0;
    static_assert(sizeof bits == sizeof single);
    std::copy_n(reinterpret_cast<const char*>(&single), sizeof bits,
                reinterpret_cast<char*>(&bits));
    whole(bits);
  }
  template <class T>
  void whole(T value) {
    const auto bits = static_cast<std::make_unsigned_t<T>>(value);
    for (unsigned shift = 0; shift < 8 * sizeof bits; shift += 8) {
      text_ += static_cast<char>((static_cast<std::uint64_t>(bits) >> shift) & 0xFFU);
    }
  }
  void vector(Vec3 v) {
    real(v.x);
    real(v.y);
    real(v.z);
  }
  void pad() { text_.resize((text_.size() + 3) & ~std::size_t{3}, '\0'); }
  void reserve(std::size_t bytes) { text_.reserve(bytes); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Direction as a point of the octahedron unfolded to a square: 32 bits, 0.004 degrees.
void put_direction(Bytes& out, Vec3 n) {
  const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  double x = 0.0, y = 0.0;
  if (is_finite(n) && sum > 0.0) {
    x = n.x / sum;
    y = n.y / sum;
    if (n.z < 0.0) {
      const double folded = (1.0 - std::abs(y)) * (x < 0.0 ? -1.0 : 1.0);
      y = (1.0 - std::abs(x)) * (y < 0.0 ? -1.0 : 1.0);
      x = folded;
    }
  }
  constexpr double kUnit = std::numeric_limits<std::int16_t>::max();
  out.whole(static_cast<std::int16_t>(std::lround(kUnit * x)));
  out.whole(static_cast<std::int16_t>(std::lround(kUnit * y)));
}

double part_of_range(Range range, double at) {
  return std::clamp((at - range.from) / range.length(), 0.0, 1.0);
}

void put_indices(Bytes& out, const Mesh& mesh) {
  const bool wide = mesh.vertices.size() > std::size_t{1} << 16U;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      if (wide) {
        out.whole(v);
      } else {
        out.whole(static_cast<std::uint16_t>(v));
      }
    }
  }
  out.pad();
}

void put_raster(Bytes& out, const ValueRaster& raster) {
  for (const RasterSide* side : {&raster.u, &raster.v}) {
    for (const double at : side->breaks) out.real(at);
  }
  for (const PrincipalCurvatures k : raster.k) {
    out.real(k.k1);
    out.real(k.k2);
  }
  constexpr auto kNone = std::numeric_limits<std::int16_t>::min();
  for (const Vec3 n : raster.normals) {
    if (norm(n) > 0.0) {
      put_direction(out, n);
    } else {
      out.whole(kNone);
      out.whole(kNone);
    }
  }
  for (const double off : raster.offs) out.real(off);
}

void put_patch(Bytes& out, const NurbsSurface& surface, const Mesh& mesh, Vec3 centre,
               const ValueRaster& raster) {
  for (const MeshVertex& v : mesh.vertices) out.vector(v.point - centre);
  for (const MeshVertex& v : mesh.vertices) put_direction(out, v.normal);
  const Range us = domain_u(surface), vs = domain_v(surface);
  for (const MeshVertex& v : mesh.vertices) {
    out.real(part_of_range(us, v.u));
    out.real(part_of_range(vs, v.v));
  }
  put_raster(out, raster);
  put_indices(out, mesh);
}

void place(PageData& data, const std::vector<Mesh>& meshes, const std::vector<ScenePolyline>& lines,
           const std::vector<SceneDot>& dots) {
  Box3 box;
  for (const Mesh& mesh : meshes) {
    for (const MeshVertex& v : mesh.vertices) box.add(v.point);
  }
  data.size = box.high - box.low;
  data.centre = box.low + 0.5 * data.size;
  double radius = 0.0;
  for (const Mesh& mesh : meshes) {
    for (const MeshVertex& v : mesh.vertices)
      radius = std::max(radius, norm(v.point - data.centre));
  }
  for (const ScenePolyline& line : lines) {
    for (const Vec3 p : line.points) radius = std::max(radius, norm(p - data.centre));
  }
  for (const SceneDot& dot : dots) radius = std::max(radius, norm(dot.point - data.centre));
  data.radius = radius;
}

}  // namespace

Result<PageData> page_data(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                           const std::vector<ScenePolyline>& lines,
                           const std::optional<ShownDeviation>& deviation, const RunContext& run) {
  constexpr std::size_t kMostDots = 200'000;
  const auto dots = deviation ? shown_dots(deviation->dots, kMostDots) : std::vector<SceneDot>{};
  PageData data;
  place(data, meshes, lines, dots);
  const double size = norm(data.size);
  const auto rasters = value_rasters(model, meshes, deviation, run);
  OBVID_TRY(rasters);
  Bytes out;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    put_patch(out, model.patches[i].surface, meshes[i], data.centre, (*rasters)[i]);
    data.rasters.push_back({(*rasters)[i].u, (*rasters)[i].v});
  }
  for (const ScenePolyline& line : lines) {
    for (const Vec3 p : line.points) out.vector(p - data.centre);
  }
  if (deviation) {
    data.dots = dots.size();
    for (const SceneDot& dot : dots) out.vector(dot.point - data.centre);
    for (const SceneDot& dot : dots) out.real(dot.value);
    data.deviation =
        dots.empty() ? scale_of_offs(*rasters, size) : scale_of_dots(deviation->dots, size);
    data.deviation.least = deviation->told.from;
    data.deviation.most = deviation->told.to;
  }
  for (std::size_t q = 0; q < kPageQuantities.size(); ++q) {
    data.scales[q] = scale_of(*rasters, kPageQuantities[q], size);
  }
  data.bytes = out.take();
  return data;
}

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned byte = k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U;
      group = (group << 8U) | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= left ? kDigits[(group >> (18U - 6U * k)) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace obvid::picture
