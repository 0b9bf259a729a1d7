// SPDX-License-Identifier: Apache-2.0
#include "field_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/numeric/internal/root.h"

namespace obvid {
namespace {

/// Lines of the raster: knots, and equal parts between them.
std::vector<double> raster_of(const std::vector<double>& knots) {
  constexpr std::size_t kLeastPerSpan = 8, kLeast = 33, kMost = 256;
  const std::vector<double> spans = distinct(knots);
  const std::size_t n = spans.size() - 1;
  const std::size_t each = std::max<std::size_t>(
      1, std::min(std::max(kLeastPerSpan, (kLeast + n - 1) / n), kMost / std::min(n, kMost)));
  std::vector<double> out;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < each; ++k) {
      out.push_back(
          Range{spans[i], spans[i + 1]}.at(static_cast<double>(k) / static_cast<double>(each)));
    }
  }
  out.push_back(spans.back());
  return out;
}

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

class FieldLines {
 public:
  FieldLines(const NurbsSurface& surface, const CuttingField& field)
      : s_(surface),
        field_(field),
        us_(raster_of(surface.knots_u)),
        vs_(raster_of(surface.knots_v)) {}

  Result<std::vector<CutLine>> made(const RunContext& run) {
    for (const double v : vs_) {
      OBVID_TRY(may_go_on(run));
      for (const double u : us_) values_.push_back(value(u, v));
    }
    of_u_edge_.assign(values_.size(), kNone);
    of_v_edge_.assign(values_.size(), kNone);
    for (std::size_t j = 0; j + 1 < vs_.size(); ++j) {
      OBVID_TRY(may_go_on(run));
      for (std::size_t i = 0; i + 1 < us_.size(); ++i) cell(i, j);
    }
    return chained();
  }

 private:
  [[nodiscard]] double value(double u, double v) const {
    return field_.value(evaluate(s_, u, v).point);
  }
  [[nodiscard]] std::size_t node(std::size_t i, std::size_t j) const { return j * us_.size() + i; }
  [[nodiscard]] bool negative(std::size_t n) const { return values_[n] < 0.0; }

  /// The place on an edge of the raster from a node along u or v; none without a change of sign.
  std::size_t crossing(std::size_t i, std::size_t j, bool along_u) {
    const std::size_t a = node(i, j), b = along_u ? node(i + 1, j) : node(i, j + 1);
    if (negative(a) == negative(b)) return kNone;
    std::size_t& known = (along_u ? of_u_edge_ : of_v_edge_)[a];
    if (known != kNone) return known;
    known = places_.size();
    if (along_u) {
      const double u = root_of([&](double at) { return value(at, vs_[j]); }, us_[i], us_[i + 1],
                               values_[a], values_[b]);
      places_.push_back({u, vs_[j]});
    } else {
      const double v = root_of([&](double at) { return value(us_[i], at); }, vs_[j], vs_[j + 1],
                               values_[a], values_[b]);
      places_.push_back({us_[i], v});
    }
    mates_.push_back({kNone, kNone});
    return known;
  }

  void cell(std::size_t i, std::size_t j) {
    const std::array<std::size_t, 4> at = {crossing(i, j, true), crossing(i + 1, j, false),
                                           crossing(i, j + 1, true), crossing(i, j, false)};
    std::vector<std::size_t> there;
    for (const std::size_t one : at) {
      if (one != kNone) there.push_back(one);
    }
    if (there.size() == 2) return link(there[0], there[1]);
    if (there.size() != 4) return;
    // a saddle: the middle decides which corners are connected
    const double middle = value(0.5 * (us_[i] + us_[i + 1]), 0.5 * (vs_[j] + vs_[j + 1]));
    if ((middle < 0.0) == negative(node(i, j))) {
      link(at[0], at[1]);
      link(at[2], at[3]);
    } else {
      link(at[0], at[3]);
      link(at[1], at[2]);
    }
  }
  void link(std::size_t a, std::size_t b) {
    for (const auto& [one, other] : {std::pair{a, b}, std::pair{b, a}}) {
      (mates_[one][0] == kNone ? mates_[one][0] : mates_[one][1]) = other;
    }
  }

  std::vector<CutLine> chained() const {
    std::vector<CutLine> out;
    std::vector<bool> done(places_.size(), false);
    const auto follow = [&](std::size_t first) {
      CutLine line;
      std::size_t at = first, before = kNone;
      while (at != kNone && !done[at]) {
        done[at] = true;
        line.places.push_back(places_[at]);
        const std::size_t next = mates_[at][0] != before ? mates_[at][0] : mates_[at][1];
        before = at;
        at = next;
      }
      line.closed = at == first && line.places.size() > 2;
      out.push_back(std::move(line));
    };
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!done[i] && mates_[i][1] == kNone) follow(i);
    }
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!done[i]) follow(i);
    }
    return out;
  }

  const NurbsSurface& s_;
  const CuttingField& field_;
  std::vector<double> us_, vs_, values_;
  std::vector<std::size_t> of_u_edge_, of_v_edge_;
  std::vector<Vec2> places_;
  std::vector<std::array<std::size_t, 2>> mates_;
};

/// Newton's method to a place over a corner, from beside it; nothing where it does not get there.
std::optional<Vec2> over_corner(const NurbsSurface& s, const ContourField::Corner& corner,
                                Vec2 from, double small) {
  constexpr int kMostCornerSteps = 30;
  const Range u = domain_u(s), v = domain_v(s);
  Vec2 at = from;
  for (int k = 0; k < kMostCornerSteps; ++k) {
    const SurfaceJet jet = evaluate(s, at.x, at.y);
    const Vec3 off = corner.point - jet.point;
    const Vec2 right{dot(corner.x, off), dot(corner.y, off)};
    const Vec2 by_u{dot(corner.x, jet.du), dot(corner.y, jet.du)};
    const Vec2 by_v{dot(corner.x, jet.dv), dot(corner.y, jet.dv)};
    const double det = cross(by_u, by_v);
    if (det == 0.0) return std::nullopt;
    at = {std::clamp(at.x + cross(right, by_v) / det, u.from, u.to),
          std::clamp(at.y + cross(by_u, right) / det, v.from, v.to)};
  }
  const Vec3 off = corner.point - evaluate(s, at.x, at.y).point;
  if (std::hypot(dot(corner.x, off), dot(corner.y, off)) > small) return std::nullopt;
  return at;
}

/// Corners between neighbours of a line: where the place over them is nearer to both than these are
/// to each other, or nearly.
void add_corners(const NurbsSurface& s, const std::vector<ContourField::Corner>& corners,
                 CutLine& line) {
  constexpr double kAround = 1.5, kSmall = 1e-10;
  const double small = kSmall * size_of(s);
  const auto point = [&](Vec2 at) { return evaluate(s, at.x, at.y).point; };
  const auto in_plane = [](const ContourField::Corner& c, Vec3 p) {
    return Vec2{dot(c.x, p - c.point), dot(c.y, p - c.point)};
  };
  for (const ContourField::Corner& corner : corners) {
    std::vector<Vec2> places;
    const std::size_t n = line.places.size();
    for (std::size_t i = 0; i < n; ++i) {
      places.push_back(line.places[i]);
      if (i + 1 == n && !line.closed) break;
      const Vec2 next = line.places[(i + 1) % n];
      const Vec3 a = point(line.places[i]), b = point(next);
      const double chord = norm(b - a);
      if (norm(in_plane(corner, a)) + norm(in_plane(corner, b)) >
          kAround * norm(in_plane(corner, a) - in_plane(corner, b)) + small) {
        continue;
      }
      const auto at = over_corner(s, corner, 0.5 * (line.places[i] + next), small);
      if (!at || norm(point(*at) - a) + norm(point(*at) - b) > 2.0 * kAround * chord) continue;
      if (norm(point(*at) - a) <= small) {
        places.back() = *at;
      } else if (norm(point(*at) - b) > small) {
        places.push_back(*at);
      }
    }
    line.places = std::move(places);
  }
}

}  // namespace

Result<std::vector<CutLine>> field_lines(const NurbsSurface& surface, const CuttingField& field,
                                         const std::vector<ContourField::Corner>& corners,
                                         const RunContext& run) {
  auto lines = FieldLines(surface, field).made(run);
  OBVID_TRY(lines);
  for (CutLine& line : *lines) add_corners(surface, corners, line);
  return lines;
}

}  // namespace obvid
