// SPDX-License-Identifier: Apache-2.0
#include "measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "obvid/core/internal/parallel.h"

namespace obvid::mesh {
namespace {

/// Steps of Gauss and Newton towards the foot of a perpendicular: two or three, many where the
/// surface stands still.
constexpr int kMostMeasureSteps = 32;
/// A step shorter than this part of the distance no longer changes it (by the square of it).
constexpr double kSettled = 1e-3;
/// Most parts into which the edges of a triangle are divided for looking at it.
constexpr std::size_t kMostParts = 32;

/// Shortest part of a step that is tried when the whole one leads away.
constexpr double kShortest = 1.0 / 64.0;
/// Steps each way of a search around a triangle that seems too far off.
constexpr int kSearched = 16;
/// Square of the sine between du and dv below which they count as one direction.
constexpr double kParallelSquared = 1e-12;

/// That know of each other what is good enough; so many lots end at about the same time.
constexpr std::size_t kCellsTogether = 1024;

struct Moves {
  bool u = true, v = true;
};

using Triangle = std::array<const MeshVertex*, 3>;

struct Spot {
  Vec3 point;
  double u = 0.0, v = 0.0;
};

Spot mix(const Triangle& t, double a, double b, double c) {
  return {a * t[0]->point + b * t[1]->point + c * t[2]->point,
          a * t[0]->u + b * t[1]->u + c * t[2]->u, a * t[0]->v + b * t[1]->v + c * t[2]->v};
}

class Meter {
 public:
  explicit Meter(const PatchSampler& sampler) : sampler_(sampler) {}

  /// Distance of a point from the surface near (u, v), or `enough` when it is not greater.
  [[nodiscard]] double distance(Spot q, Moves moves, double enough) const {
    SurfacePoint s = at(q);
    double best = norm(q.point - s.point);
    for (int k = 0; k < kMostMeasureSteps && best > enough; ++k) {
      const Vec2 step = step_of(q.point - s.point, s, moves);
      bool nearer = false;
      double moved = 0.0;
      for (double part = 1.0; part >= kShortest && !nearer; part /= 2.0) {
        Spot next = q;
        next.u = std::clamp(q.u + part * step.x, sampler_.u().from(), sampler_.u().to());
        next.v = std::clamp(q.v + part * step.y, sampler_.v().from(), sampler_.v().to());
        moved = norm((next.u - q.u) * s.du) + norm((next.v - q.v) * s.dv);
        if (moved <= kSettled * best) break;
        const SurfacePoint there = at(next);
        const double far = norm(q.point - there.point);
        nearer = far < best;
        if (!nearer) continue;
        best = far;
        s = there;
        q = next;
      }
      if (!nearer) break;
    }
    return std::max(best, enough);
  }

  /// The same from many places around: for surfaces whose parameters run very unevenly.
  [[nodiscard]] double searched(const Spot& q, Moves moves, Range u, Range v, double enough) const {
    Spot best = q;
    double least = std::numeric_limits<double>::infinity();
    for (int j = 0; j <= (moves.v ? kSearched : 0); ++j) {
      for (int i = 0; i <= (moves.u ? kSearched : 0); ++i) {
        Spot next = q;
        if (moves.u) next.u = u.at(static_cast<double>(i) / kSearched);
        if (moves.v) next.v = v.at(static_cast<double>(j) / kSearched);
        const double far = norm(q.point - at(next).point);
        if (far >= least) continue;
        least = far;
        best = next;
      }
    }
    return distance(best, moves, enough);
  }

  /// Points of an edge keep to the border when both ends lie on one side.
  [[nodiscard]] Moves moves_of(const MeshVertex& a, const MeshVertex& b) const {
    const bool along_v = a.u == b.u && (a.u == sampler_.u().from() || a.u == sampler_.u().to());
    const bool along_u = a.v == b.v && (a.v == sampler_.v().from() || a.v == sampler_.v().to());
    return {!along_v, !along_u};
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
  [[nodiscard]] SurfacePoint at(const Spot& q) const {
    return sampler_.at(sampler_.u().locate(q.u), sampler_.v().locate(q.v));
  }

  /// Step of Gauss and Newton, by u and v.
  static Vec2 step_of(Vec3 gap, const SurfacePoint& s, Moves moves) {
    const double uu = moves.u ? dot(s.du, s.du) : 0.0, vv = moves.v ? dot(s.dv, s.dv) : 0.0;
    const double uv = moves.u && moves.v ? dot(s.du, s.dv) : 0.0;
    const double gu = moves.u ? dot(gap, s.du) : 0.0, gv = moves.v ? dot(gap, s.dv) : 0.0;
    const double det = uu * vv - uv * uv;
    if (det > kParallelSquared * uu * vv)
      return {(vv * gu - uv * gv) / det, (uu * gv - uv * gu) / det};
    return {uu > 0.0 ? gu / uu : 0.0, vv > 0.0 ? gv / vv : 0.0};  // one direction: each for itself
  }

  const PatchSampler& sampler_;
};

std::array<Range, 2> box_of(const Triangle& t) {
  const auto [u0, u1] = std::minmax({t[0]->u, t[1]->u, t[2]->u});
  const auto [v0, v1] = std::minmax({t[0]->v, t[1]->v, t[2]->v});
  return {Range{u0, u1}, Range{v0, v1}};
}

bool is_turned_over(const Triangle& t, double tolerance) {
  const Vec3 ab = t[1]->point - t[0]->point, ac = t[2]->point - t[0]->point;
  const Vec3 n = cross(ab, ac);
  const double longest2 = std::max({dot(ab, ab), dot(ac, ac), dot(ac - ab, ac - ab)});
  if (longest2 <= tolerance * tolerance) return false;
  return std::any_of(t.begin(), t.end(), [&](const MeshVertex* p) {
    return p->normal != Vec3{} && dot(n, p->normal) <= 0.0;
  });
}

class Measurer {
 public:
  Measurer(const PatchSampler& sampler, const Mesh& mesh, double tolerance, Look look)
      : meter_(sampler), mesh_(mesh), tolerance_(tolerance), look_(look) {}

  /// Largest distance of a triangle; what is not greater than `enough` counts as that.
  [[nodiscard]] double of_triangle(const Triangle& t, double enough) const {
    double worst = enough;
    const std::array<Range, 2> box = box_of(t);
    const auto note = [&](const Spot& q, Moves moves) {
      double d = meter_.distance(q, moves, enough);
      if (d > tolerance_) d = std::min(d, meter_.searched(q, moves, box[0], box[1], enough));
      worst = std::max(worst, d);
    };
    std::size_t n = 1;
    const std::size_t divided = look_ == Look::kQuarters ? 2 : 1;  // middles are looked at before
    for (std::size_t e = 0; e < 3; ++e) {
      const MeshVertex &a = *t[e], &b = *t[(e + 1) % 3];
      const std::size_t parts = divided * meter_.parts(a, b);
      n = std::max(n, parts);
      for (std::size_t i = 0; i < parts; ++i) {
        const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(parts);
        note(mix({&a, &b, &b}, 1.0 - part, part, 0.0), meter_.moves_of(a, b));
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; i + j < n; ++j) {
        const double b = (static_cast<double>(i) + 1.0 / 3.0) / static_cast<double>(n);
        const double c = (static_cast<double>(j) + 1.0 / 3.0) / static_cast<double>(n);
        note(mix(t, 1.0 - b - c, b, c), {});
      }
    }
    return worst;
  }

  [[nodiscard]] Triangle triangle(std::size_t k) const {
    const auto& ids = mesh_.triangles[k];
    return {&mesh_.vertices[ids[0]], &mesh_.vertices[ids[1]], &mesh_.vertices[ids[2]]};
  }

 private:
  Meter meter_;
  const Mesh& mesh_;
  double tolerance_;
  Look look_;
};

}  // namespace

// Some cells together, each lot by itself: what one has seen is no measure for another.
Result<Measured> measure(const PatchSampler& sampler, const Mesh& mesh,
                         const std::vector<CellTriangles>& triangles, std::vector<CellSeen>& seen,
                         double tolerance, Look look, const RunContext& run) {
  const Measurer measurer(sampler, mesh, tolerance, look);
  std::vector<std::size_t> first{0};  // triangle of each cell
  for (const CellTriangles& cell : triangles) first.push_back(first.back() + cell.count);
  seen.resize(triangles.size());
  struct Lot {
    double good = 0.0, worst_bad = 0.0;
    std::vector<std::size_t> bad;
  };
  std::vector<Lot> lots((triangles.size() + kCellsTogether - 1) / kCellsTogether);
  OBVID_TRY(in_parallel(lots.size(), run, [&](std::size_t number) {
    Lot& lot = lots[number];
    const std::size_t end = std::min(triangles.size(), (number + 1) * kCellsTogether);
    for (std::size_t cell = number * kCellsTogether; cell < end; ++cell) {
      if (seen[cell].outline == triangles[cell].outline) {
        lot.good = std::max(lot.good, seen[cell].deviation);
        continue;
      }
      double worst = 0.0;
      bool turned = false;
      for (std::size_t k = first[cell]; k < first[cell + 1]; ++k) {
        const Triangle t = measurer.triangle(k);
        worst = std::max(worst, measurer.of_triangle(t, lot.good));
        turned = turned || is_turned_over(t, tolerance);
      }
      if (worst > tolerance || turned) {
        lot.worst_bad = std::max(lot.worst_bad, worst);
        lot.bad.push_back(cell);
      } else {
        lot.good = std::max(lot.good, worst);
        seen[cell] = {triangles[cell].outline, worst};
      }
    }
  }));
  Measured out;
  out.bad.assign(triangles.size(), false);
  for (const Lot& lot : lots) {
    out.deviation = std::max({out.deviation, lot.good, lot.worst_bad});
    for (const std::size_t cell : lot.bad) out.bad[cell] = out.any_bad = true;
  }
  return out;
}

}  // namespace obvid::mesh
