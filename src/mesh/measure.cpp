// SPDX-License-Identifier: Apache-2.0
#include "measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace obvid::mesh {
namespace {

/// Steps of Gauss and Newton towards the foot of a perpendicular: two or three, many where the
/// surface stands still.
constexpr int kSteps = 32;
/// A step shorter than this part of the distance no longer changes it (by the square of it).
constexpr double kSettled = 1e-3;
/// Most parts into which the edges of a triangle are divided for looking at it.
constexpr std::size_t kMostParts = 32;

struct Spot {
  Vec3 point;
  double u = 0.0, v = 0.0;
};

Spot mix(const std::array<const MeshVertex*, 3>& t, double a, double b, double c) {
  return {a * t[0]->point + b * t[1]->point + c * t[2]->point,
          a * t[0]->u + b * t[1]->u + c * t[2]->u, a * t[0]->v + b * t[1]->v + c * t[2]->v};
}

class Meter {
 public:
  explicit Meter(const PatchSampler& sampler) : sampler_(sampler) {}

  /// Distance of a point from the surface near (u, v), or `enough` when it is not greater.
  [[nodiscard]] double distance(Spot q, bool move_u, bool move_v, double enough) const {
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kSteps; ++k) {
      const SurfacePoint s = sampler_.at(sampler_.u().locate(q.u), sampler_.v().locate(q.v));
      const Vec3 gap = q.point - s.point;
      best = std::min(best, norm(gap));
      if (best <= enough) return enough;
      const double uu = move_u ? dot(s.du, s.du) : 0.0, vv = move_v ? dot(s.dv, s.dv) : 0.0;
      const double uv = move_u && move_v ? dot(s.du, s.dv) : 0.0;
      const double gu = move_u ? dot(gap, s.du) : 0.0, gv = move_v ? dot(gap, s.dv) : 0.0;
      double su = uu > 0.0 ? gu / uu : 0.0, sv = vv > 0.0 ? gv / vv : 0.0;
      const double det = uu * vv - uv * uv;
      if (det > 1e-12 * uu * vv) {  // else the directions are one: each for itself
        su = (vv * gu - uv * gv) / det;
        sv = (uu * gv - uv * gu) / det;
      }
      const double u = std::clamp(q.u + su, sampler_.u().from(), sampler_.u().to());
      const double v = std::clamp(q.v + sv, sampler_.v().from(), sampler_.v().to());
      const double moved = std::sqrt(uu) * std::fabs(u - q.u) + std::sqrt(vv) * std::fabs(v - q.v);
      if (moved <= kSettled * best) break;
      q.u = u;
      q.v = v;
    }
    return best;
  }

  /// Of the edge's point from the border when both ends lie on one side, else from the surface.
  [[nodiscard]] double edge(const MeshVertex& a, const MeshVertex& b, double part,
                            double enough) const {
    const Spot q = mix({&a, &b, &b}, 1.0 - part, part, 0.0);
    const bool along_v = a.u == b.u && (a.u == sampler_.u().from() || a.u == sampler_.u().to());
    const bool along_u = a.v == b.v && (a.v == sampler_.v().from() || a.v == sampler_.v().to());
    return distance(q, !along_v, !along_u, enough);
  }

  [[nodiscard]] std::size_t parts(const MeshVertex& a, const MeshVertex& b) const {
    const auto spans = [](const PatchAxis& axis, double from, double to) {
      const std::size_t i = axis.locate(from).span, j = axis.locate(to).span;
      return i < j ? j - i : i - j;
    };
    return std::clamp<std::size_t>(
        std::max(spans(sampler_.u(), a.u, b.u), spans(sampler_.v(), a.v, b.v)), 1, kMostParts);
  }

 private:
  const PatchSampler& sampler_;
};

bool is_turned_over(const std::array<const MeshVertex*, 3>& t, double tolerance) {
  const Vec3 ab = t[1]->point - t[0]->point, ac = t[2]->point - t[0]->point;
  const Vec3 n = cross(ab, ac);
  const double longest2 = std::max({dot(ab, ab), dot(ac, ac), dot(ac - ab, ac - ab)});
  if (longest2 <= tolerance * tolerance) return false;
  return std::any_of(t.begin(), t.end(), [&](const MeshVertex* p) {
    return p->normal != Vec3{} && dot(n, p->normal) <= 0.0;
  });
}

}  // namespace

Measured measure(const PatchSampler& sampler, const Mesh& mesh,
                 const std::vector<std::uint32_t>& cell_of, std::size_t cells, double tolerance) {
  const Meter meter(sampler);
  Measured out;
  out.bad.assign(cells, false);
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& ids = mesh.triangles[k];
    const std::array<const MeshVertex*, 3> t{&mesh.vertices[ids[0]], &mesh.vertices[ids[1]],
                                             &mesh.vertices[ids[2]]};
    double worst = 0.0;
    const auto note = [&](double d) {
      worst = std::max(worst, d > out.deviation || d > tolerance ? d : 0.0);
    };
    const double enough = std::min(out.deviation, tolerance);
    std::size_t n = 1;
    for (std::size_t e = 0; e < 3; ++e) {
      const MeshVertex &a = *t[e], &b = *t[(e + 1) % 3];

      const std::size_t parts = meter.parts(a, b);
      n = std::max(n, parts);
      for (std::size_t i = 0; i < parts; ++i) {
        note(meter.edge(a, b, (static_cast<double>(i) + 0.5) / static_cast<double>(parts), enough));
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; i + j < n; ++j) {
        const double b = (static_cast<double>(i) + 1.0 / 3.0) / static_cast<double>(n);
        const double c = (static_cast<double>(j) + 1.0 / 3.0) / static_cast<double>(n);
        note(meter.distance(mix(t, 1.0 - b - c, b, c), true, true, enough));
      }
    }
    out.deviation = std::max(out.deviation, worst);
    if (worst > tolerance || is_turned_over(t, tolerance)) {
      out.bad[cell_of[k]] = true;
      out.any_bad = true;
    }
  }
  return out;
}

}  // namespace obvid::mesh
