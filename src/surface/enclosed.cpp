// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/internal/enclosed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/curve/internal/basis.h"

namespace obvid {
namespace {

/// Places along one direction, ends included: enough to see the shape of a span that is alone, few
/// where there are many.
constexpr std::size_t kLeastChords = 32, kMostChords = 256;

std::vector<double> places(const std::vector<double>& knots, Range domain) {
  std::vector<double> at;
  for (const double knot : distinct(knots)) {
    if (knot >= domain.from && knot <= domain.to) at.push_back(knot);
  }
  const std::size_t spans = at.size() - 1;
  std::vector<double> out;
  if (spans > kMostChords) {
    for (std::size_t i = 0; i <= kMostChords; ++i) out.push_back(at[i * spans / kMostChords]);
    return out;
  }
  const std::size_t each = (kLeastChords + spans - 1) / spans;
  for (std::size_t i = 0; i < spans; ++i) {
    for (std::size_t k = 0; k < each; ++k) {
      out.push_back(
          std::lerp(at[i], at[i + 1], static_cast<double>(k) / static_cast<double>(each)));
    }
  }
  out.push_back(at.back());
  return out;
}

/// Of the tetrahedron from the apex to a triangle.
void add(SignedVolume& sum, Vec3 apex, Vec3 a, Vec3 b, Vec3 c) {
  const double one = dot(a - apex, cross(b - apex, c - apex)) / 6.0;
  sum.value += one;
  // the three differences are rounded as their points are
  const double far = norm(apex) + std::max({norm(a - apex), norm(b - apex), norm(c - apex)});
  const double x = norm(a - apex), y = norm(b - apex), z = norm(c - apex);
  sum.size += far * (x * y + y * z + z * x) / 6.0;
}

/// Points along the border v = start or v = end of all patches, one after the other.
std::vector<Vec3> rim(const std::vector<SurfacePatch>& patches, bool end) {
  std::vector<Vec3> out;
  for (const SurfacePatch& patch : patches) {
    const NurbsSurface& s = patch.surface;
    const Range v = domain_v(s);
    const double at = end ? v.to : v.from;
    for (const SurfacePoint& p :
         evaluate_raster(s, places(s.knots_u, domain_u(s)), std::vector<double>{at})) {
      out.push_back(p.point);
    }
  }
  return out;
}

/// Of the fan over a rim from its middle.
SignedVolume fan(const std::vector<Vec3>& rim, Vec3 apex, bool forwards) {
  Vec3 middle;
  for (const Vec3& p : rim) middle = middle + (1.0 / static_cast<double>(rim.size())) * p;
  SignedVolume sum;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vec3 a = rim[i], b = rim[(i + 1) % rim.size()];
    if (forwards)
      add(sum, apex, middle, a, b);
    else
      add(sum, apex, middle, b, a);
  }
  return sum;
}

bool goes_on(const NurbsSurface& from, const NurbsSurface& to, double size) {
  constexpr double kSame = 1e-9;  // of the size: as borders that patches of a skin share
  const std::vector<double> at = places(from.knots_v, domain_v(from));
  const Range own = domain_v(from), other = domain_v(to);
  return std::all_of(at.begin(), at.end(), [&](double v) {
    const double w = std::lerp(other.from, other.to, (v - own.from) / own.length());
    return norm(evaluate(from, domain_u(from).to, v).point -
                evaluate(to, domain_u(to).from, w).point) <= kSame * size;
  });
}

bool closes_along_u(const std::vector<SurfacePatch>& patches) {
  std::vector<const NurbsSurface*> all;
  for (const SurfacePatch& patch : patches) all.push_back(&patch.surface);
  const double size = size_of(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!goes_on(*all[i], *all[(i + 1) % all.size()], size)) return false;
  }
  return !all.empty();
}

SignedVolume around_u(const std::vector<SurfacePatch>& patches) {
  const std::vector<Vec3> first = rim(patches, false), last = rim(patches, true);
  const Vec3 apex = first.front();
  SignedVolume sum;
  for (const SurfacePatch& patch : patches) sum += volume_from(patch.surface, apex);
  sum += fan(first, apex, false);
  sum += fan(last, apex, true);
  return sum;
}

}  // namespace

int SignedVolume::sign() const {
  // evaluated points are a few roundings off, and the product of three differences is as much again
  constexpr double kRoundings = 64.0;
  if (std::abs(value) <= kRoundings * std::numeric_limits<double>::epsilon() * size) return 0;
  return value > 0.0 ? 1 : -1;
}

SignedVolume& SignedVolume::operator+=(const SignedVolume& other) {
  value += other.value;
  size += other.size;
  return *this;
}

SignedVolume volume_from(const NurbsSurface& surface, Vec3 apex) {
  const std::vector<double> us = places(surface.knots_u, domain_u(surface)),
                            vs = places(surface.knots_v, domain_v(surface));
  const auto raster = evaluate_raster(surface, us, vs);
  SignedVolume sum;
  for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      const std::size_t at = j * us.size() + i;
      const Vec3 a = raster[at].point, b = raster[at + 1].point,
                 c = raster[at + us.size() + 1].point, d = raster[at + us.size()].point;
      add(sum, apex, a, b, c);
      add(sum, apex, a, c, d);
    }
  }
  return sum;
}

std::optional<SignedVolume> enclosed_volume(const std::vector<SurfacePatch>& patches) {
  if (closes_along_u(patches)) return around_u(patches);
  if (patches.size() != 1) return std::nullopt;
  const std::vector<SurfacePatch> across{{"", transposed(patches.front().surface)}};
  if (!closes_along_u(across)) return std::nullopt;
  SignedVolume volume = around_u(across);
  volume.value = -volume.value;
  return volume;
}

bool turn_outward(std::vector<SurfacePatch>& patches) {
  const bool trimmed = std::any_of(patches.begin(), patches.end(),
                                   [](const SurfacePatch& patch) { return !patch.trims.empty(); });
  if (trimmed) return false;
  const auto volume = enclosed_volume(patches);
  if (!volume || volume->sign() >= 0) return false;
  for (SurfacePatch& patch : patches) patch.surface = reversed_u(patch.surface);
  return true;
}

}  // namespace obvid
