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

std::vector<PrincipalCurvatures> put_patch(Bytes& out, const NurbsSurface& surface,
                                           const Mesh& mesh, Vec3 centre,
                                           const std::vector<double>& offs) {
  for (const MeshVertex& v : mesh.vertices) out.vector(v.point - centre);
  for (const MeshVertex& v : mesh.vertices) put_direction(out, v.normal);
  const Range us = domain_u(surface), vs = domain_v(surface);
  for (const MeshVertex& v : mesh.vertices) {
    out.real(part_of_range(us, v.u));
    out.real(part_of_range(vs, v.v));
  }
  std::vector<PrincipalCurvatures> curvatures;
  curvatures.reserve(mesh.vertices.size());
  const double size = size_of(surface);
  for (const MeshVertex& v : mesh.vertices) {
    curvatures.push_back(principal_at(surface, size, v.u, v.v));
    out.real(curvatures.back().k1);
    out.real(curvatures.back().k2);
  }
  for (const double off : offs) out.real(off);
  put_indices(out, mesh);
  return curvatures;
}

/// Deviation at each vertex; empty where it is of points alone.
Result<std::vector<double>> offs_of(const Mesh& mesh,
                                    const std::optional<ShownDeviation>& deviation,
                                    const RunContext& run) {
  if (!deviation || !deviation->of_place) return std::vector<double>{};
  return offs_at(
      *deviation, mesh.vertices.size(), [&](std::size_t i) { return mesh.vertices[i].point; }, run);
}

/// Third of the area of the triangles around each vertex.
std::vector<double> areas(const Mesh& mesh) {
  std::vector<double> area(mesh.vertices.size(), 0.0);
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]].point;
    const double twice = norm(cross(mesh.vertices[t[1]].point - a, mesh.vertices[t[2]].point - a));
    for (const std::uint32_t v : t) area[v] += twice / 6.0;
  }
  return area;
}

struct Measured {
  PrincipalCurvatures k;
  double area = 0.0;
};

ValueScale scale_of(const std::vector<Measured>& measured, SurfaceColouring colouring,
                    double size) {
  std::vector<WeighedValue> values;
  values.reserve(measured.size());
  for (const Measured& m : measured) values.push_back({quantity(colouring, m.k), m.area});
  return value_scale(std::move(values), resolution_of(colouring, size));
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
  std::vector<WeighedValue> offs;
  PageData data;
  place(data, meshes, lines, dots);
  const double size = norm(data.size);
  Bytes out;
  std::vector<Measured> measured;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto own = offs_of(meshes[i], deviation, run);
    OBVID_TRY(own);
    const auto k = put_patch(out, model.patches[i].surface, meshes[i], data.centre, *own);
    const auto area = areas(meshes[i]);
    for (std::size_t v = 0; v < own->size(); ++v) offs.push_back({(*own)[v], area[v]});
    for (std::size_t v = 0; v < k.size(); ++v) measured.push_back({k[v], area[v]});
    const double part = static_cast<double>(i + 1) / static_cast<double>(meshes.size());
    OBVID_TRY(tell(run, "page", part));
  }
  for (const ScenePolyline& line : lines) {
    for (const Vec3 p : line.points) out.vector(p - data.centre);
  }
  if (deviation) {
    data.dots = dots.size();
    for (const SceneDot& dot : dots) out.vector(dot.point - data.centre);
    for (const SceneDot& dot : dots) out.real(dot.value);
    data.deviation = dots.empty() ? value_scale(std::move(offs),
                                                resolution_of(SurfaceColouring::kDeviation, size))
                                  : scale_of_dots(deviation->dots, size);
    data.deviation.least = deviation->told.from;
    data.deviation.most = deviation->told.to;
  }
  for (std::size_t q = 0; q < kPageQuantities.size(); ++q) {
    data.scales[q] = scale_of(measured, kPageQuantities[q], size);
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
