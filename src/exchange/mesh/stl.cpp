// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <limits>

#include "mesh/parts.h"
#include "obvid/exchange/internal/mesh/files.h"

namespace obvid {
namespace {

constexpr std::size_t kStlHeader = 80;        // bytes
constexpr std::size_t kBytesOfTriangle = 50;  // 12 numbers of 4 bytes, 2 bytes of attributes
constexpr std::size_t kName = 40;             // characters that are kept

}  // namespace

Result<std::string> stl_text(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                             Watch* watch) {
  auto counts = exchange::counts_of(model, meshes);
  OBVID_TRY(counts);
  if (counts->triangles > std::numeric_limits<std::uint32_t>::max()) {
    return fail(exchange::too_large("STL"));
  }
  // a header that begins with "solid" would be taken for the form in text
  std::string out =
      fmt::format("binary STL by obvid, {}, unit {}",
                  exchange::plain_name(model.name, "surface").substr(0, kName),
                  exchange::plain_name(model.units.text(), "units").substr(0, kName / 4));
  out.resize(kStlHeader, ' ');
  out.reserve(kStlHeader + sizeof(std::uint32_t) + kBytesOfTriangle * counts->triangles);
  exchange::put(out, std::uint32_t{0});
  std::uint32_t written = 0;
  Questions questions(watch, exchange::kItemsOfMesh);
  for (const Mesh& mesh : meshes) {
    for (const auto& t : mesh.triangles) {
      if (questions.end()) return fail(cancelled_error());
      const Vec3 a = mesh.vertices[t[0]].point, b = mesh.vertices[t[1]].point,
                 c = mesh.vertices[t[2]].point;
      const Vec3 sa = exchange::single(a), sb = exchange::single(b), sc = exchange::single(c);
      if (!is_finite(sa) || !is_finite(sb) || !is_finite(sc))
        return fail(exchange::too_large("STL"));
      if (sa == sb || sb == sc || sc == sa) continue;
      exchange::put_single(out, unit(cross(b - a, c - a)));
      exchange::put_single(out, a);
      exchange::put_single(out, b);
      exchange::put_single(out, c);
      exchange::put(out, std::uint16_t{0});
      ++written;
    }
  }
  std::string number;
  exchange::put(number, written);
  out.replace(kStlHeader, number.size(), number);
  return out;
}

}  // namespace obvid
