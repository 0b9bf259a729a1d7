// SPDX-License-Identifier: Apache-2.0
#include "trimmed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "obvid/curve/internal/basis.h"
#include "obvid/geom/internal/chord.h"
#include "obvid/geom/internal/directions.h"
#include "obvid/surface/internal/trim.h"
#include "too_many_triangles.h"

namespace obvid::mesh {
namespace {

constexpr int kMostRounds = 8;
constexpr int kMostHalvings = 20;
constexpr double kSame = 1e-12;  // of the domain: places of a row that are one

class TrimmedMesher {
 public:
  TrimmedMesher(const SurfacePatch& patch, const TessellationOptions& options)
      : s_(patch.surface),
        region_(patch),
        options_(options),
        same_(kSame * domain_u(s_).length()) {}

  Result<Mesh> made(const RunContext& run) {
    find_lines();
    for (int round = 0;; ++round) {
      OBVID_TRY(may_go_on(run));
      build();
      if (mesh_.triangles.size() > options_.most_triangles) {
        return fail(too_many_triangles(options_.most_triangles));
      }
      measure();
      if (mesh_.deviation <= options_.chord_tolerance) return std::move(mesh_);
      if (round >= kMostRounds) {
        return error(ErrorCode::kToleranceNotReached,
                     fmt::format("triangles are {:.3g} off the surface however small they are",
                                 mesh_.deviation))
            .hint("the surface folds or has a cusp there; allow a larger chord tolerance")
            .value(mesh_.deviation);
      }
      finer_ *= 2.0;
      find_lines();
    }
  }

 private:
  using Id = std::uint32_t;

  /// Lines of one direction: knots and equal parts of the spans, by bends and turns of the normal
  /// at places of the span across the other one.
  std::vector<double> lines_along(bool along_u) const {
    constexpr int kPlaces = 5;
    const std::vector<double>& knots = along_u ? s_.knots_u : s_.knots_v;
    const std::vector<double> across = distinct(along_u ? s_.knots_v : s_.knots_u);
    std::vector<double> out{knots.front()};
    for (std::size_t i = 1; i < knots.size(); ++i) {
      const Range span{knots[i - 1], knots[i]};
      if (!(span.length() > 0.0)) continue;
      double most = 1.0;
      for (std::size_t k = 1; k < across.size(); ++k) {
        for (int m = 0; m < kPlaces; ++m) {
          const double other = Range{across[k - 1], across[k]}.at((m + 0.5) / kPlaces);
          most = std::max(most, parts_of(span, other, along_u));
        }
      }
      const double parts = std::ceil(std::min(finer_ * most, 1e4));
      for (double m = 1.0; m <= parts; ++m) out.push_back(span.at(m / parts));
    }
    return out;
  }
  /// How many parts a span wants on one line.
  double parts_of(const Range& span, double other, bool along_u) const {
    constexpr int kPlaces = 5;
    double bend = 0.0, turn = 0.0;
    Vec3 before;
    for (int m = 0; m < kPlaces; ++m) {
      const double at = span.at((m + 0.5) / kPlaces);
      const SurfaceJet jet = along_u ? evaluate(s_, at, other) : evaluate(s_, other, at);
      bend = std::max(bend, norm(along_u ? jet.duu : jet.dvv));
      const Vec3 normal = curvature(jet).normal;
      if (m > 0 && norm(before) > 0.0 && norm(normal) > 0.0) turn += angle_between(before, normal);
      before = normal;
    }
    constexpr double kChords = 0.25;  // of the tolerance: two directions and a twist add up
    const double length = span.length();
    const double by_bend =
        std::sqrt(bend * length * length / (8.0 * kChords * options_.chord_tolerance));
    return std::max(by_bend, turn * kPlaces / (kPlaces - 1) / options_.angle);
  }

  void find_lines() {
    us_ = lines_along(true);
    vs_ = lines_along(false);
  }

  [[nodiscard]] Vec3 point(double u, double v) const { return evaluate(s_, u, v).point; }

  /// Levels of a band: lines of v, knots of the trims, and as many more as the chords along its two
  /// trims need.
  std::vector<double> levels_of(const TrimBand& band) const {
    std::vector<double> levels{band.v.from, band.v.to};
    for (const std::vector<double>* some : {&vs_, &region_.breaks_v()}) {
      for (const double v : *some) {
        if (v > band.v.from && v < band.v.to) levels.push_back(v);
      }
    }
    std::sort(levels.begin(), levels.end());
    levels = distinct(std::move(levels));
    std::vector<double> out{levels.front()};
    for (std::size_t i = 1; i < levels.size(); ++i) halve(band, {levels[i - 1], levels[i]}, 0, out);
    return out;
  }
  void halve(const TrimBand& band, const Range& v, int halvings, std::vector<double>& out) const {
    const double middle = v.at(0.5);
    const Range low = region_.across(band, v.from), high = region_.across(band, v.to),
                between = region_.across(band, middle);
    const auto off = [&](double a, double b, double c) {
      return distance_from_chord(point(c, middle), point(a, v.from), point(b, v.to));
    };
    const double most =
        std::max(off(low.from, high.from, between.from), off(low.to, high.to, between.to));
    if (most <= 0.5 * options_.chord_tolerance / finer_ || halvings >= kMostHalvings) {
      out.push_back(v.to);
      return;
    }
    halve(band, {v.from, middle}, halvings + 1, out);
    halve(band, {middle, v.to}, halvings + 1, out);
  }

  void add_inner(const Range& u, std::vector<double>& row) const {
    for (auto at = std::upper_bound(us_.begin(), us_.end(), u.from + same_);
         at != us_.end() && *at < u.to - same_; ++at) {
      row.push_back(*at);
    }
  }

  void build() {
    mesh_ = {};
    shared_.clear();
    // rows at ends of bands have the points of both sides
    std::map<double, std::vector<double>> at_ends;
    for (const TrimBand& band : region_.bands()) {
      for (const double v : {band.v.from, band.v.to}) {
        const Range u = region_.across(band, v);
        std::vector<double>& row = at_ends[v];
        row.push_back(u.from);
        row.push_back(u.to);
        add_inner(u, row);
      }
    }
    for (auto& [v, row] : at_ends) {
      std::sort(row.begin(), row.end());
      row.erase(
          std::unique(row.begin(), row.end(), [&](double a, double b) { return b - a <= same_; }),
          row.end());
    }
    for (const TrimBand& band : region_.bands()) {
      std::vector<Id> before;
      for (const double v : levels_of(band)) {
        const Range u = region_.across(band, v);
        std::vector<Id> row;
        if (v == band.v.from || v == band.v.to) {
          const std::vector<double>& all = at_ends[v];
          for (const double at : all) {
            if (at >= u.from - same_ && at <= u.to + same_) row.push_back(shared(at, v));
          }
        } else {
          std::vector<double> own{u.from};
          add_inner(u, own);
          if (u.to - own.back() > same_) own.push_back(u.to);
          for (const double at : own) row.push_back(vertex(at, v));
        }
        if (!before.empty()) strip(before, row);
        before = std::move(row);
      }
    }
  }

  Id vertex(double u, double v) {
    MeshVertex out;
    const SurfaceJet jet = evaluate(s_, u, v);
    out.point = jet.point;
    out.normal = normal_at(jet, u, v);
    out.u = u;
    out.v = v;
    mesh_.vertices.push_back(out);
    return static_cast<Id>(mesh_.vertices.size() - 1);
  }
  Id shared(double u, double v) {
    const auto [at, fresh] = shared_.try_emplace({u, v}, 0U);
    if (fresh) at->second = vertex(u, v);
    return at->second;
  }
  /// At poles the limit from inside.
  [[nodiscard]] Vec3 normal_at(const SurfaceJet& jet, double u, double v) const {
    const Vec3 here = curvature(jet).normal;
    if (norm(here) > 0.0) return here;
    constexpr double kInside = 1e-6;
    const Range all_u = domain_u(s_), all_v = domain_v(s_);
    const double beside_u = u + kInside * (all_u.at(0.5) - u);
    const double beside_v = v + kInside * (all_v.at(0.5) - v);
    return curvature(evaluate(s_, beside_u, beside_v)).normal;
  }

  /// Triangles between two rows, the lower one first: always on where u is less far.
  void strip(const std::vector<Id>& low, const std::vector<Id>& high) {
    std::size_t a = 0, b = 0;
    const auto u_of = [&](Id id) { return mesh_.vertices[id].u; };
    // by their parts, because the ends of the rows do not stand above each other
    const auto part = [&](const std::vector<Id>& row, std::size_t k) {
      const double from = u_of(row.front()), to = u_of(row.back());
      return to > from ? (u_of(row[k]) - from) / (to - from) : 1.0;
    };
    while (a + 1 < low.size() || b + 1 < high.size()) {
      const bool along_low =
          b + 1 >= high.size() || (a + 1 < low.size() && part(low, a + 1) <= part(high, b + 1));
      if (along_low) {
        triangle(low[a], low[a + 1], high[b]);
        ++a;
      } else {
        triangle(low[a], high[b + 1], high[b]);
        ++b;
      }
    }
  }
  void triangle(Id a, Id b, Id c) {
    const Vec3 p = mesh_.vertices[a].point, q = mesh_.vertices[b].point,
               r = mesh_.vertices[c].point;
    if (p == q || q == r || r == p) return;
    mesh_.triangles.push_back({a, b, c});
  }

  void measure() {
    for (const auto& t : mesh_.triangles) {
      const MeshVertex &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]],
                       &c = mesh_.vertices[t[2]];
      const Vec3 normal = cross(b.point - a.point, c.point - a.point);
      const double area = norm(normal);
      if (!(area > 0.0)) continue;
      const auto off = [&](double u, double v) {
        return std::abs(dot(normal, point(u, v) - a.point)) / area;
      };
      // at all places of a grid over it, its corners aside
      constexpr int kParts = 6;  // holds middles of edges, their thirds, and the centroid
      for (int i = 0; i <= kParts; ++i) {
        for (int j = 0; i + j <= kParts; ++j) {
          const double wb = static_cast<double>(i) / kParts, wc = static_cast<double>(j) / kParts;
          const double wa = 1.0 - wb - wc;
          mesh_.deviation = std::max(
              mesh_.deviation, off(wa * a.u + wb * b.u + wc * c.u, wa * a.v + wb * b.v + wc * c.v));
        }
      }
    }
  }

  const NurbsSurface& s_;
  TrimRegion region_;
  const TessellationOptions& options_;
  double same_;
  double finer_ = 1.0;
  std::vector<double> us_, vs_;
  std::map<std::pair<double, double>, Id> shared_;
  Mesh mesh_;
};

}  // namespace

Result<Mesh> tessellate_trimmed(const SurfacePatch& patch, const TessellationOptions& options,
                                const RunContext& run) {
  OBVID_TRY(check(patch));
  return TrimmedMesher(patch, options).made(run);
}

}  // namespace obvid::mesh
