// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_builder.h"

#include <fast_float/fast_float.h>

#include <limits>
#include <utility>

namespace obvid::exchange {

std::size_t MeshBuilder::Hash::operator()(const std::array<std::uint64_t, 3>& bits) const {
  std::uint64_t hash = 0;
  for (const std::uint64_t one : bits) {  // the finalizer of splitmix64
    hash += one + 0x9e3779b97f4a7c15;
    hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9;
    hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111eb;
    hash ^= hash >> 31U;
  }
  return static_cast<std::size_t>(hash);
}

std::uint32_t MeshBuilder::point(Vec3 p) {
  p = p + Vec3{0.0, 0.0, 0.0};  // -0 becomes 0
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const auto [at, is_new] = places_.try_emplace({bits(p.x), bits(p.y), bits(p.z)},
                                                static_cast<std::uint32_t>(mesh_.points.size()));
  if (is_new) mesh_.points.push_back(p);
  return at->second;
}

void MeshBuilder::polygon(const std::vector<std::uint32_t>& corners) {
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const std::uint32_t a = corners[0], b = corners[k - 1], c = corners[k];
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
  }
}

Result<TriangleMesh> MeshBuilder::take() {
  if (needs_triangles_ && mesh_.triangles.empty()) {
    return fail({ErrorCode::kTooFewPoints, "the mesh has no triangles", name_, ""});
  }
  return std::move(mesh_);
}

Error MeshBuilder::error(ErrorCode code, std::string what, const std::string& place) const {
  return {code, std::move(what), name_ + (place.empty() ? "" : ": " + place), ""};
}

bool MeshWords::next() {
  while (at_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end == text_.size() ? end : end + 1;
    ++line_;
    words_.clear();
    constexpr std::string_view kBlanks = " \t\r\f\v";
    for (std::size_t i = line.find_first_not_of(kBlanks); i < line.size();
         i = line.find_first_not_of(kBlanks, i)) {
      const std::size_t stop = std::min(line.find_first_of(kBlanks, i), line.size());
      words_.push_back(line.substr(i, stop - i));
      i = stop;
    }
    if (!words_.empty()) return true;
  }
  words_.clear();
  return false;
}

Result<Vec3> vector_of(const MeshWords& line, std::size_t first, const MeshBuilder& builder) {
  Vec3 out;
  std::size_t at = first;
  for (double* const to : {&out.x, &out.y, &out.z}) {
    if (at >= line.words().size()) {
      return fail(builder.error(ErrorCode::kBadNumber, "a point has three numbers", line.place()));
    }
    std::string_view word = line.words()[at++];
    if (word.starts_with('+')) word.remove_prefix(1);
    const char* const end = word.data() + word.size();
    const auto read = fast_float::from_chars(word.data(), end, *to);
    if (read.ec != std::errc() || read.ptr != end) {
      return fail(builder.error(ErrorCode::kBadNumber,
                                "'" + std::string(word.substr(0, 40)) + "' is no number",
                                line.place()));
    }
  }
  if (!is_finite(out)) {
    return fail(builder.error(ErrorCode::kNotFinite, "a coordinate is not finite", line.place()));
  }
  return out;
}

}  // namespace obvid::exchange
